// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RgbPictures.h"

#include "vtkBase64Utilities.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkImageReader2.h"
#include "vtkImageReader2Factory.h"
#include "vtkJPEGReader.h"
#include "vtkPNGReader.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <vector>

namespace
{

const std::string scheme = "data:";
const std::string encoding = ";base64,";

/// Keeps what a reader complains about from the user, who is told otherwise.
class ErrorsOfReader : public vtkCommand
{
public:
  vtkTypeMacro(ErrorsOfReader, vtkCommand);
  static ErrorsOfReader* New() { return new ErrorsOfReader; }
  void Execute(vtkObject*, unsigned long, void*) override { this->HaveCome = true; }

  bool HaveCome = false;
};

/// The picture, or null where the reader has failed.
vtkSmartPointer<vtkImageData> read(vtkImageReader2* reader)
{
  vtkNew<ErrorsOfReader> errors;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  const bool hasPixels = image->GetNumberOfPoints() > 0 && image->GetPointData()->GetScalars();
  return errors->HaveCome || !hasPixels ? nullptr : image;
}

bool startsWith(const std::vector<unsigned char>& bytes, const std::vector<unsigned char>& start)
{
  return bytes.size() > start.size() && std::equal(start.begin(), start.end(), bytes.begin());
}

/// Empty where it is not base64.
std::vector<unsigned char> decodedBase64(std::string text)
{
  text.erase(
    std::remove_if(text.begin(), text.end(), [](unsigned char c) { return std::isspace(c); }),
    text.end());
  if (text.empty() || text.size() % 4 != 0)
  {
    return {};
  }
  const std::size_t padding = text.size() - 1 - text.find_last_not_of('=');
  std::vector<unsigned char> bytes(text.size() / 4 * 3);
  const std::size_t decoded = vtkBase64Utilities::DecodeSafely(
    reinterpret_cast<const unsigned char*>(text.data()), text.size(), bytes.data(), bytes.size());
  bytes.resize(padding <= 2 && decoded == bytes.size() - padding ? decoded : 0);
  return bytes;
}

vtkSmartPointer<vtkImageData> imageFromText(const std::string& property, const std::string& text)
{
  const std::size_t end = text.find(encoding);
  const std::vector<unsigned char> bytes = end == std::string::npos
    ? std::vector<unsigned char>()
    : decodedBase64(text.substr(end + encoding.size()));
  if (bytes.empty())
  {
    throw std::runtime_error(property + " begins with '" + text.substr(0, 30) +
      "', but what follows is not a picture in base64. Give all of data:image/png;base64,... or "
      "the "
      "name of a file.");
  }
  vtkSmartPointer<vtkImageReader2> reader;
  if (startsWith(bytes, { 0x89, 'P', 'N', 'G' }))
  {
    reader = vtkSmartPointer<vtkPNGReader>::New();
  }
  else if (startsWith(bytes, { 0xFF, 0xD8, 0xFF }))
  {
    reader = vtkSmartPointer<vtkJPEGReader>::New();
  }
  vtkSmartPointer<vtkImageData> image;
  if (reader)
  {
    reader->SetMemoryBuffer(bytes.data());
    reader->SetMemoryBufferLength(static_cast<vtkIdType>(bytes.size()));
    image = read(reader);
  }
  if (!image)
  {
    throw std::runtime_error(property +
      " holds base64 text that is no whole PNG or JPEG file. Encode the whole file, or give its "
      "name.");
  }
  return image;
}

vtkSmartPointer<vtkImageData> imageFromFile(const std::string& property, const std::string& name)
{
  if (!vtksys::SystemTools::FileExists(name, true))
  {
    throw std::runtime_error(property + " names the file '" + name +
      "', which there is not. Give the name of a picture that the process which computes can read, "
      "or "
      "its content as data:image/png;base64,...");
  }
  auto reader = vtkSmartPointer<vtkImageReader2>::Take(
    vtkImageReader2Factory::CreateImageReader2(name.c_str()));
  vtkSmartPointer<vtkImageData> image;
  if (reader)
  {
    reader->SetFileName(name.c_str());
    image = read(reader);
  }
  if (!image)
  {
    throw std::runtime_error(property + " names the file '" + name +
      "', which is no picture that can be read. Save it as PNG or JPEG.");
  }
  return image;
}

} // namespace

//------------------------------------------------------------------------------
std::shared_ptr<const schlieren::RgbPicture> readRgbPicture(
  const std::string& property, const std::string& text)
{
  const bool isContent = text.compare(0, scheme.size(), scheme) == 0;
  const vtkSmartPointer<vtkImageData> image =
    isContent ? imageFromText(property, text) : imageFromFile(property, text);
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  const int components = scalars->GetNumberOfComponents();
  const int type = scalars->GetDataType();
  if ((type != VTK_UNSIGNED_CHAR && type != VTK_UNSIGNED_SHORT) || components > 4)
  {
    throw std::runtime_error(property +
      " is a picture of other values than 8 or 16 bits of grey or colour. Save it as an ordinary "
      "PNG.");
  }
  auto picture = std::make_shared<schlieren::RgbPicture>();
  picture->width = image->GetDimensions()[0];
  picture->height = image->GetDimensions()[1];
  const auto pixels = static_cast<vtkIdType>(picture->width) * picture->height;
  picture->rgb.reserve(static_cast<std::size_t>(pixels) * 3);
  const double white = type == VTK_UNSIGNED_CHAR ? 255 : 65535;
  const bool isGrey = components < 3;
  const bool hasAlpha = components % 2 == 0;
  std::array<double, 4> values{};
  for (vtkIdType pixel = 0; pixel < pixels; ++pixel)
  {
    scalars->GetTuple(pixel, values.data());
    const double alpha = hasAlpha ? values[static_cast<std::size_t>(components) - 1] / white : 1;
    for (const std::size_t channel : { 0, 1, 2 })
    {
      const double light = values[isGrey ? 0 : channel] / white;
      picture->rgb.push_back(static_cast<unsigned char>((1 + alpha * (light - 1)) * 255 + 0.5));
    }
  }
  return picture;
}
