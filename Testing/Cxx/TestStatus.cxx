// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a picture's line of words says.
#include "Fixtures.h"
#include "PictureStatus.h"

#include "Schlieren.h"

TEST(Status, SaysWhatIsKnownOfAPicture)
{
  schlieren::Image image;
  schlieren::Scene scene;
  image.threads = 2;
  image.samples = 4;
  image.pathModel = schlieren::PathModel::Straight;
  image.displacementBound = 0.004;
  image.frame.pixelSize = 0.2;
  EXPECT_EQ(statusInWords(image, scene, 8.52e7),
    "4 samples per pixel, 85 million rays/s on CPU (2 threads), straight rays, within 0.02 pixels "
    "of "
    "refracted");
  image.pathModel = schlieren::PathModel::Refracted;
  image.momentumDrift = 3.1e-7;
  image.threads = 1;
  scene.samplesPerPixel = image.samples = 1;
  EXPECT_EQ(statusInWords(image, scene, 1.23e6),
    "1 sample per pixel, 1.2 million rays/s on CPU (1 thread), refracted rays, |p| = n within "
    "3.1e-07");
  scene.samplesPerPixel = 64; // an unfinished one
  EXPECT_EQ(statusInWords(image, scene, 1.23e6).find("1 of 64 samples per pixel, 1.2 million"), 0u);
  scene.samplesPerPixel = 1;
  image.device = schlieren::Device::Cuda;
  EXPECT_EQ(statusInWords(image, scene, 0),
    "1 sample per pixel, CUDA, refracted rays, |p| = n within 3.1e-07");
  image.pathModel = schlieren::PathModel::Straight;
  image.displacementBound = HUGE_VAL;
  EXPECT_EQ(statusInWords(image, scene, 4321),
    "1 sample per pixel, 4321 rays/s on CUDA, straight rays, of unknown error");
}

TEST(Status, TellsTheSpeedOfTheLastTracingWhereNothingIsTraced)
{
  auto image = cube(32);
  addPointArray(image, "N", GaussianColumn());
  auto filter = bench(image);
  EXPECT_STREQ(filter->GetStatus(), "");
  filter->Update();
  const std::string status = filter->GetStatus();
  EXPECT_NE(status.find(" rays/s on "), std::string::npos) << status;
  filter->SetKnifeEdgeAngle(30);
  filter->Update();
  EXPECT_EQ(filter->GetStatus(), status);

  filter->SetImageSize(-1, 0); // a mistake has no picture to speak of
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_EQ(complaints->Errors.size(), 1u);
  EXPECT_STREQ(filter->GetStatus(), "");
}
