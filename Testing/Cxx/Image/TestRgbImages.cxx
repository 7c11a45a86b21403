// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Fixtures.h"
#include "Image/RgbImages.h"

#include "vtkBase64Utilities.h"
#include "vtkPNGWriter.h"
#include "vtkUnsignedShortArray.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

using namespace filters;

namespace
{

using Bytes = std::vector<unsigned char>;
using Image = std::shared_ptr<const schlieren::RgbImage>;

/// An image with these values, pixel by pixel, bottom row first.
template <class Array, class Value>
vtkSmartPointer<vtkImageData> image(int width, int components, const std::vector<Value>& values)
{
  auto result = vtkSmartPointer<vtkImageData>::New();
  const auto pixels = static_cast<vtkIdType>(values.size()) / components;
  result->SetDimensions(width, static_cast<int>(pixels) / width, 1);
  vtkNew<Array> array;
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(pixels);
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  result->GetPointData()->SetScalars(array);
  return result;
}

vtkSmartPointer<vtkImageData> bytes(int width, int components, const Bytes& values)
{
  return image<vtkUnsignedCharArray>(width, components, values);
}

Bytes png(vtkImageData* image)
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* file = writer->GetResult();
  return { file->GetPointer(0), file->GetPointer(0) + file->GetNumberOfValues() };
}

std::string text(const Bytes& file)
{
  Bytes encoded(file.size() * 2 + 4);
  encoded.resize(vtkBase64Utilities::Encode(file.data(), file.size(), encoded.data()));
  return "data:image/png;base64," + std::string(encoded.begin(), encoded.end());
}

Bytes read(vtkImageData* image) { return readRgbImage("ColorFilterImage", text(png(image)))->rgb; }

std::string errorOf(const std::string& given)
{
  try
  {
    readRgbImage("ColorFilterImage", given);
  }
  catch (const std::runtime_error& error)
  {
    return error.what();
  }
  return "";
}

const Bytes six{ 255, 0, 0, 0, 255, 0, 0, 0, 255, 1, 2, 3, 40, 50, 60, 255, 255, 255 };

} // namespace

TEST(RgbImages, KeepEveryByteBottomRowFirst)
{
  const Image image = readRgbImage("ColorFilterImage", text(png(bytes(3, 3, six))));
  EXPECT_EQ(image->width, 3);
  EXPECT_EQ(image->height, 2);
  EXPECT_EQ(image->rgb, six);
}

TEST(RgbImages, GreyIsTheSameInAllChannels)
{
  EXPECT_EQ(read(bytes(2, 1, { 7, 200 })), (Bytes{ 7, 7, 7, 200, 200, 200 }));
}

TEST(RgbImages, TransparentPlacesShowWhite)
{
  EXPECT_EQ(
    read(bytes(2, 4, { 10, 20, 30, 255, 10, 20, 30, 0 })), (Bytes{ 10, 20, 30, 255, 255, 255 }));
  EXPECT_EQ(read(bytes(2, 2, { 10, 255, 10, 0 })), (Bytes{ 10, 10, 10, 255, 255, 255 }));
}

// Light adds up, not its sRGB values: the curve of IEC 61966-2-1 and back.
TEST(RgbImages, HalfTransparentPlacesMixTheirLightWithWhite)
{
  const double alpha = 51 / 255.;
  const Bytes mixed = read(bytes(1, 4, { 100, 50, 200, 51 }));
  for (const std::size_t channel : { 0, 1, 2 })
  {
    const double value = std::array{ 100, 50, 200 }[channel] / 255.;
    const double light = 1 - alpha + alpha * std::pow((value + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(mixed[channel], 255 * (1.055 * std::pow(light, 1 / 2.4) - 0.055), 1.1) << channel;
  }
}

TEST(RgbImages, SixteenBitsAreRoundedToEight)
{
  const auto png = image<vtkUnsignedShortArray>(
    2, 3, std::vector<unsigned short>{ 0, 65535, 257 * 100, 128, 129, 257 * 3 + 128 });
  EXPECT_EQ(read(png), (Bytes{ 0, 255, 100, 0, 1, 3 }));
}

TEST(RgbImages, AFileIsReadByItsName)
{
  const std::string name = SCHLIEREN_TEST_OUTPUT "/six.png";
  const Bytes file = png(bytes(3, 3, six));
  std::ofstream(name, std::ios::binary)
    .write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
  EXPECT_EQ(readRgbImage("ColorFilterImage", name)->rgb, six);
}

TEST(RgbImages, LineBreaksInTheTextDoNotMatter)
{
  std::string broken = text(png(bytes(3, 3, six)));
  broken.insert(broken.size() / 2, "\n  ");
  EXPECT_EQ(readRgbImage("ColorFilterImage", broken + "\n")->rgb, six);
}

TEST(RgbImages, WhatCannotBeReadIsSaid)
{
  const std::string whole = text(png(bytes(3, 3, six)));
  EXPECT_NE(errorOf("/nowhere/at all.png").find("'/nowhere/at all.png'"), std::string::npos);
  EXPECT_NE(errorOf(SCHLIEREN_TEST_OUTPUT).find("cannot be read"), std::string::npos); // a folder
  EXPECT_NE(errorOf("/dev/zero").find("cannot be read"), std::string::npos);           // has no end
  const std::string large = SCHLIEREN_TEST_OUTPUT "/large.png";
  std::ofstream(large).put('\0');
  std::filesystem::resize_file(large, (std::uintmax_t{ 64 } << 20) + 1);
  EXPECT_NE(errorOf(large).find("larger than 64 MB"), std::string::npos);
  std::filesystem::remove(large);
  EXPECT_NE(errorOf(SCHLIEREN_TEST_DATA "/README.md").find("no complete PNG"), std::string::npos);
  for (const std::string& given : { std::string("data:"), std::string("data:image/png;base64,"),
         std::string("data:image/png,iVBORw0KGgo="), "data:image/png;base64,*" + whole.substr(23),
         whole.substr(0, whole.size() - 1), whole + "====" })
  {
    EXPECT_NE(errorOf(given).find("base64"), std::string::npos) << given;
  }
  EXPECT_NE(errorOf("data:text/plain;base64,aGVsbG8h").find("no complete PNG"), std::string::npos);
}

// However a file is damaged, it ends in an image of its size or in an error.
TEST(RgbImages, DamagedFilesDoNoHarm)
{
  Bytes values(16 * 16 * 3);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = static_cast<unsigned char>(i * 37);
  }
  const Bytes file = png(bytes(16, 3, values));
  for (std::size_t length = 0; length + 12 < file.size(); length += 5) // 12: an empty last chunk
  {
    EXPECT_NE(
      errorOf(text({ file.begin(), file.begin() + static_cast<std::ptrdiff_t>(length) })), "")
      << length;
  }
  for (std::size_t i = 0; i < file.size(); i += 3)
  {
    Bytes damaged = file;
    damaged[i] = static_cast<unsigned char>(~damaged[i]);
    try
    {
      const Image image = readRgbImage("ColorFilterImage", text(damaged));
      EXPECT_EQ(image->rgb.size(), values.size()) << i;
    }
    catch (const std::runtime_error&)
    {
    }
  }
}

TEST(RgbImages, AreDecodedOnceForTheSameText)
{
  const std::string given = text(png(bytes(3, 3, six)));
  RgbImageReader reader;
  const auto first = reader.read("ColorFilterImage", given);
  EXPECT_EQ(reader.read("ColorFilterImage", given), first);
  const Bytes others(six.rbegin(), six.rend());
  EXPECT_EQ(
    reader.read("ColorFilterImage", text(png(bytes(3, 3, others))))->rgb.size(), six.size());
  EXPECT_THROW(reader.read("ColorFilterImage", "data:image/png;base64,none"), std::runtime_error);
  EXPECT_EQ(reader.read("ColorFilterImage", given)->rgb, six);

  // A file by what it holds now.
  const std::string name = SCHLIEREN_TEST_OUTPUT "/changing.png";
  const auto write = [&name](const Bytes& file)
  {
    std::ofstream(name, std::ios::binary)
      .write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
  };
  write(png(bytes(3, 3, six)));
  const auto ofFile = reader.read("ColorFilterImage", name);
  EXPECT_EQ(reader.read("ColorFilterImage", name), ofFile);
  write(png(bytes(3, 3, Bytes(six.size(), 200))));
  EXPECT_EQ(reader.read("ColorFilterImage", name)->rgb, Bytes(six.size(), 200));
}
