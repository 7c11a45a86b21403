// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <memory>
#include <string>
#include <vector>

namespace filters
{

/// An image that is decoded once, as long as it is requested again and again.
class RgbImageReader
{
public:
  /// See readRgbImage. The same text, or a file with the same content, gives the same image.
  std::shared_ptr<const schlieren::RgbImage> read(
    const std::string& property, const std::string& text);

private:
  std::vector<unsigned char> File;
  std::string Text;
  std::shared_ptr<const schlieren::RgbImage> Image;
};

/// The image that `text` stands for: the name of a PNG file, or the content of one as
/// "data:image/png;base64,..." (RFC 2397). Of any kind: grey or coloured, 1 to 16 bits; transparent places
/// are shown on white. Throws std::runtime_error with a message for the user; `property` is where `text`
/// was given.
std::shared_ptr<const schlieren::RgbImage> readRgbImage(
  const std::string& property, const std::string& text);

} // namespace filters
