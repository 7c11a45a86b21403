// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Image/RgbImages.h"

#include "vtkBase64Utilities.h"
#include "vtk_png.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace filters
{

namespace
{

const std::string scheme = "data:";
const std::string encoding = ";base64,";

/// Maximum number of pixels; larger images are treated as damaged.
constexpr std::uint64_t maxPixels = std::uint64_t{ 1 } << 28;

/// Maximum size of a file.
constexpr std::uintmax_t maxBytes = std::uintmax_t{ 64 } << 20;

using Bytes = std::vector<unsigned char>;

/// Returns nothing if the text is not base64.
Bytes decodedBase64(std::string text)
{
  text.erase(
    std::remove_if(text.begin(), text.end(), [](unsigned char c) { return std::isspace(c); }),
    text.end());
  if (text.empty() || text.size() % 4 != 0)
  {
    return {};
  }
  const std::size_t padding = text.size() - 1 - text.find_last_not_of('=');
  Bytes bytes(text.size() / 4 * 3);
  const std::size_t decoded = vtkBase64Utilities::DecodeSafely(
    reinterpret_cast<const unsigned char*>(text.data()), text.size(), bytes.data(), bytes.size());
  bytes.resize(padding <= 2 && decoded == bytes.size() - padding ? decoded : 0);
  return bytes;
}

Bytes bytesFromText(const std::string& property, const std::string& text)
{
  const std::size_t end = text.find(encoding);
  Bytes bytes =
    end == std::string::npos ? Bytes() : decodedBase64(text.substr(end + encoding.size()));
  if (bytes.empty())
  {
    throw std::runtime_error(property + " begins with '" + text.substr(0, 30) +
      "', but what follows is not a file in base64. Give all of data:image/png;base64,... or the "
      "name of a file.");
  }
  return bytes;
}

Bytes bytesFromFile(const std::string& property, const std::string& name)
{
  // Devices and pipes may have no end.
  std::error_code failed;
  const bool isFile = std::filesystem::is_regular_file(name, failed);
  const std::uintmax_t size = isFile ? std::filesystem::file_size(name, failed) : 0;
  const bool isRead = isFile && !failed && 0 < size && size <= maxBytes;
  Bytes bytes(isRead ? static_cast<std::size_t>(size) : 0);
  if (isRead)
  {
    std::ifstream file(name, std::ios::binary);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
  }
  if (bytes.empty())
  {
    throw std::runtime_error(property + " names the file '" + name +
      (size > maxBytes ? "', which is larger than 64 MB. Give a smaller PNG file, or"
                       : "', which cannot be read. Give the name of a PNG file that the process "
                         "which computes can read, or") +
      " its content as data:image/png;base64,...");
  }
  return bytes;
}

/// Frees libpng's memory.
struct PngImage : png_image
{
  PngImage()
    : png_image{}
  {
    this->version = PNG_IMAGE_VERSION;
  }
  ~PngImage() { png_image_free(this); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

/// `name`: the file's name, empty for an image within the property.
std::shared_ptr<const schlieren::RgbImage> decoded(
  const std::string& property, const std::string& name, const Bytes& file)
{
  const auto refuse = [&](const std::string& reason)
  {
    throw std::runtime_error(property +
      (name.empty() ? " holds a file" : " names the file '" + name + "'") +
      " that is no complete PNG image (" + reason + "). Save the image as PNG, and use all of it.");
  };
  // Uses libpng's own reader, because VTK's crashes on damaged files.
  PngImage png;
  if (!png_image_begin_read_from_memory(&png, file.data(), file.size()))
  {
    refuse(png.message);
  }
  if (std::uint64_t{ png.width } * png.height > maxPixels)
  {
    refuse("its size would be " + std::to_string(png.width) + " x " + std::to_string(png.height));
  }
  png.format = PNG_FORMAT_RGB;
  png.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  auto image = std::make_shared<schlieren::RgbImage>();
  image->width = static_cast<int>(png.width);
  image->height = static_cast<int>(png.height);
  image->rgb.resize(PNG_IMAGE_SIZE(png));
  const png_color white{ 255, 255, 255 };
  const auto bottomRowFirst = -static_cast<png_int_32>(PNG_IMAGE_ROW_STRIDE(png));
  if (!png_image_finish_read(&png, &white, image->rgb.data(), bottomRowFirst, nullptr))
  {
    refuse(png.message);
  }
  return image;
}

} // namespace

std::shared_ptr<const schlieren::RgbImage> RgbImageReader::read(
  const std::string& property, const std::string& text)
{
  const bool isContent = text.compare(0, scheme.size(), scheme) == 0;
  if (isContent && this->Image && this->Text == text)
  {
    return this->Image;
  }
  Bytes file = isContent ? bytesFromText(property, text) : bytesFromFile(property, text);
  if (!this->Image || file != this->File)
  {
    this->Image = decoded(property, isContent ? "" : text, file);
    this->File = std::move(file);
  }
  this->Text = text;
  return this->Image;
}

std::shared_ptr<const schlieren::RgbImage> readRgbImage(
  const std::string& property, const std::string& text)
{
  return RgbImageReader().read(property, text);
}

} // namespace filters
