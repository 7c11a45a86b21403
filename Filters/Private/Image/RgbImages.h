// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <memory>
#include <string>
#include <vector>

namespace filters
{

/// Caches the last decoded image.
class RgbImageReader
{
public:
  /// Calls readRgbImage(), or returns the same image for the same text or file content.
  std::shared_ptr<const schlieren::RgbImage> read(
    const std::string& property, const std::string& text);

private:
  std::vector<unsigned char> File;
  std::string Text;
  std::shared_ptr<const schlieren::RgbImage> Image;
};

/// Decodes a PNG image: `text` is a file name, or the content as "data:image/png;base64,..." (RFC
/// 2397). Accepts grey and colour with 1 to 16 bits, and blends transparency with white. Throws
/// std::runtime_error with a message for the user, which names `property` as the source of `text`.
std::shared_ptr<const schlieren::RgbImage> readRgbImage(
  const std::string& property, const std::string& text);

} // namespace filters
