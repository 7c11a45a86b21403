// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <memory>
#include <string>

/// The picture that `text` stands for: the name of a file that VTK can read, or the content of a PNG or JPEG
/// file as "data:image/png;base64,..." (RFC 2397). 8 or 16 bits, grey or coloured; transparent places are
/// shown on white. Throws std::runtime_error with a message for the user; `property` is where `text` was
/// given.
std::shared_ptr<const schlieren::RgbPicture> readRgbPicture(
  const std::string& property, const std::string& text);
