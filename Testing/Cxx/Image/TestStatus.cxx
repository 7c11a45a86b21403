// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What an image's line of words says.
#include "Fixtures.h"
#include "Image/ImageStatus.h"

#include "Schlieren.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace filters;

TEST(Status, SaysWhatIsKnownOfAImage)
{
  schlieren::Image image;
  schlieren::Scene scene;
  image.threads = 2;
  image.samples = image.samplesPerPixel = 4;
  image.pathModel = schlieren::PathModel::Straight;
  EXPECT_EQ(statusInWords(image, scene, 8.52e7),
    "4 samples per pixel, 85 million rays/s on CPU (2 threads), straight rays, bending left "
    "out");
  image.pathModel = schlieren::PathModel::Refracted;
  image.momentumDrift = 3.1e-7;
  image.threads = 1;
  image.samplesPerPixel = image.samples = 1;
  EXPECT_EQ(statusInWords(image, scene, 1.23e6),
    "1 sample per pixel, 1.2 million rays/s on CPU (1 thread), refracted rays");
  image.samplesPerPixel = 64; // an unfinished one
  EXPECT_EQ(statusInWords(image, scene, 1.23e6).find("1 of 64 samples per pixel, 1.2 million"), 0u);
  image.width = 1000;
  image.height = 500;
  const auto more = [&](double raysPerSecond)
  {
    const std::string words = statusInWords(image, scene, raysPerSecond);
    return words.substr(0, words.rfind(", ", words.find("rays/s")));
  };
  EXPECT_EQ(more(1e6), "1 of 64 samples per pixel, about 32 s more"); // 63 samples of 0.5 s
  EXPECT_EQ(more(1.5e5), "1 of 64 samples per pixel, about 4 min more");
  EXPECT_EQ(more(2000), "1 of 64 samples per pixel, about 4 h more");
  EXPECT_EQ(more(1e7), "1 of 64 samples per pixel");
  image.samplesPerPixel = 1;
  image.device = schlieren::Device::Cuda;
  EXPECT_EQ(statusInWords(image, scene, 0), "1 sample per pixel, CUDA, refracted rays");
  image.pathModel = schlieren::PathModel::Straight;
  EXPECT_EQ(
    statusInWords(image, scene, 4321).find("1 sample per pixel, 4321 rays/s on CUDA, "), 0u);
}

TEST(Status, SaysWhatIsBlockedWhereNoCellIs)
{
  schlieren::Image image;
  image.blockedFraction = schlieren::PixelArray<float>(1000);
  std::fill_n(image.blockedFraction.data(), 1000, 0.f);
  EXPECT_EQ(outsideInWords(image, true), "");
  std::fill_n(image.blockedFraction.data(), 120, 1.f);
  EXPECT_EQ(outsideInWords(image, true), "12 % of the image is blocked where no cell is (Outside)");
  EXPECT_EQ(outsideInWords(image, false),
    "12 % of the image is blocked by solids and where no cell is (Outside)");
}

// What a target error has led to, in the technique's unit.
TEST(Status, SaysWhatATargetErrorHasLedTo)
{
  schlieren::Image image;
  schlieren::Scene scene;
  image.accuracy = { 0.004, 0.0031, 0.02, schlieren::ErrorSource::RaysPerPixel };
  const auto ends = [&](const std::string& words)
  {
    const std::string status = statusInWords(image, scene, 0);
    return status.size() > words.size() &&
      status.compare(status.size() - words.size(), words.size(), words) == 0;
  };
  EXPECT_TRUE(ends(", error 0.0031 of full scale (target 0.004), limited by rays per pixel"));
  scene.cutoff = schlieren::Cutoff::Interferogram;
  image.accuracy.reached = 0.3;
  image.accuracy.limit = schlieren::ErrorSource::Rounding;
  EXPECT_TRUE(ends(", target error not kept: 0.3 fringes (target 0.004), limited by rounding"));
  image.accuracy.limit = schlieren::ErrorSource::None;
  EXPECT_TRUE(ends(", target error not kept: 0.3 fringes (target 0.004)"));
}

TEST(Status, ShowsTheSpeedOfTheLastTracingWhereNothingIsTraced)
{
  auto image = columnImage(32);
  auto filter = bench(image);
  EXPECT_STREQ(filter->GetStatus(), "");
  filter->Update();
  const std::string status = filter->GetStatus();
  EXPECT_NE(status.find(" rays/s on "), std::string::npos) << status;
  filter->SetKnifeEdgeAngle(30);
  filter->Update();
  EXPECT_EQ(filter->GetStatus(), status);

  filter->SetImageSize(-1, 40);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_EQ(complaints->Errors.size(), 1u);
  EXPECT_STREQ(filter->GetStatus(),
    "No image: The image size -1 x 40 is not possible. Set both sides of ImageSize to 1 ... 32768 "
    "pixels.");
}
