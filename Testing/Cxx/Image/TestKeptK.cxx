// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Which images have a k, and surroundings, of their own, and which keep those of an earlier image.
#include "Series.h"

#include <map>

namespace
{

using Filter = vtkSchlierenFilter;

class KeptK : public testing::Test
{
protected:
  KeptK()
    : filter(bench(nullptr, 24))
  {
    this->filter->SetInputConnection(this->series->GetOutputPort());
    for (const double time : { 0., 1., 2. })
    {
      auto fresh = bench(nullptr, 24);
      fresh->SetInputConnection(this->series->GetOutputPort());
      fresh->UpdateTimeStep(time);
      this->own[time] = fieldValue(fresh, "KScale");
    }
    EXPECT_NEAR(this->own[1], this->own[0] / 2, 1e-3 * this->own[0]);
  }

  /// Of an image at this time.
  double kAt(double time)
  {
    this->filter->UpdateTimeStep(time);
    const double k = fieldValue(this->filter, "KScale");
    EXPECT_EQ(this->filter->GetKScaleUsed(), k);
    return k;
  }

  bool saysLocked() const
  {
    const bool says =
      std::string(this->filter->GetStatus()).find("k locked at ") != std::string::npos;
    EXPECT_EQ(says, std::string(this->filter->GetSensitivity()).find("k locked at ") == 0);
    EXPECT_EQ(says, this->filter->GetLockedK() == this->filter->GetKScaleUsed());
    return says;
  }

  const vtkSmartPointer<Changing> series = ::series();
  vtkSmartPointer<Filter> filter;
  std::map<double, double> own; ///< the automatic k of an image at this time
};

} // namespace

TEST_F(KeptK, IsNoneAtFirst)
{
  vtkNew<Filter> fresh;
  EXPECT_EQ(fresh->GetKMode(), Filter::K_AUTOMATIC_KEPT);
  EXPECT_EQ(fresh->GetLockedK(), 0);
}

TEST_F(KeptK, AutomaticIsThatOfTheFirstImage)
{
  EXPECT_DOUBLE_EQ(this->kAt(1), this->own[1]);
  EXPECT_FALSE(this->saysLocked());
  EXPECT_EQ(this->filter->GetLockedK(), 0);
  for (const double time : { 2., 0. })
  {
    EXPECT_EQ(this->kAt(time), this->own[1]);
    EXPECT_TRUE(this->saysLocked());
  }
  // What leaves the rays as they are leaves k.
  this->filter->SetKnifeEdgeAngle(45);
  this->filter->SetSmoothingRadius(2);
  EXPECT_EQ(this->kAt(0), this->own[1]);
  // So does a camera that moves with the time, before or after the first image of that time.
  this->filter->SetParallelScale(0.1);
  EXPECT_EQ(this->kAt(0), this->own[1]);
  this->filter->SetParallelScale(0.2);
  EXPECT_EQ(this->kAt(2), this->own[1]);
  EXPECT_TRUE(this->saysLocked());
  // At the time that k is of, another view has its own, which is kept from there on.
  const double ofView = this->kAt(1);
  EXPECT_NE(ofView, this->own[1]);
  EXPECT_FALSE(this->saysLocked());
  EXPECT_EQ(this->kAt(2), ofView);
  // So has another quality.
  this->filter->SetParallelScale(0);
  this->filter->SetStepSize(0.5);
  EXPECT_NEAR(this->kAt(1), this->own[1], 1e-2 * this->own[1]);
  EXPECT_FALSE(this->saysLocked());
}

TEST_F(KeptK, AutomaticKeptIsThatOfAnotherCameraAndQualityToo)
{
  this->filter->SetKMode(Filter::K_AUTOMATIC_KEPT);
  EXPECT_DOUBLE_EQ(this->kAt(1), this->own[1]);
  this->filter->SetParallelScale(0.1);
  EXPECT_EQ(this->kAt(1), this->own[1]);
  EXPECT_TRUE(this->saysLocked());
  this->filter->SetQuality(Filter::REFERENCE); // double precision, which makes another medium
  this->filter->SetSamplesPerPixel(1);
  EXPECT_EQ(this->kAt(1), this->own[1]);
  EXPECT_EQ(this->kAt(2), this->own[1]);
}

TEST_F(KeptK, AnotherMediumCutoffOrDataHasItsOwn)
{
  this->filter->SetKMode(Filter::K_AUTOMATIC_KEPT);
  EXPECT_DOUBLE_EQ(this->kAt(0), this->own[0]);
  EXPECT_EQ(this->kAt(1), this->own[0]);
  this->filter->SetCutoff(Filter::BRIGHT_FIELD); // whose full scale is twice as far
  EXPECT_NEAR(this->kAt(1), 2 * this->own[1], 1e-6 * this->own[1]);
  EXPECT_FALSE(this->saysLocked());
  this->filter->SetCutoff(Filter::KNIFE_EDGE);    // back to the same image
  EXPECT_EQ(this->filter->GetAutomaticUsed(), 0); // not that of the other one
  EXPECT_EQ(this->filter->GetLockedK(), this->own[0]);
  EXPECT_EQ(this->kAt(1), this->own[0]);
  this->filter->SetOutside(vtkRefractiveIndex::OUTSIDE_PASSES);
  EXPECT_DOUBLE_EQ(this->kAt(1), this->own[1]);
  EXPECT_EQ(this->kAt(2), this->own[1]);
  this->series->Modified(); // other data at the same time
  EXPECT_DOUBLE_EQ(this->kAt(2), this->own[2]);
}

// So that undoing what was in between leads back to the same image.
TEST_F(KeptK, StaysWhileAnImageHasNone)
{
  this->kAt(0);
  EXPECT_EQ(this->kAt(2), this->own[0]);
  this->filter->SetKMode(Filter::K_VALUE);
  EXPECT_EQ(this->kAt(2), 1000);
  EXPECT_EQ(std::string(this->filter->GetStatus()).find("locked"), std::string::npos);
  this->filter->SetKMode(Filter::K_AUTOMATIC);
  EXPECT_EQ(this->kAt(2), this->own[0]);
  EXPECT_TRUE(this->saysLocked());
  this->filter->SetCutoff(Filter::SHADOWGRAPH); // which has a distance instead
  EXPECT_EQ(this->kAt(2), 0);
  EXPECT_EQ(this->filter->GetLockedK(), 0);
  const double distance = this->filter->GetAutomaticUsed();
  EXPECT_GT(distance, 0);
  this->filter->SetCutoff(Filter::KNIFE_EDGE);
  EXPECT_EQ(this->kAt(2), this->own[0]);
  this->filter->SetCutoff(Filter::SHADOWGRAPH);
  this->kAt(1);
  EXPECT_EQ(this->filter->GetLockedK(), distance);
}

TEST_F(KeptK, CanBeGiven)
{
  this->filter->SetLockedK(123);
  for (const double time : { 2., 1. })
  {
    EXPECT_EQ(this->kAt(time), 123);
    EXPECT_TRUE(this->saysLocked());
  }
  // As one that was found at another time, whatever the camera.
  this->filter->SetLockedK(0);
  this->filter->SetLockedK(123);
  this->kAt(1);
  this->filter->SetImageSize(20, 20);
  EXPECT_EQ(this->kAt(1), 123);
  const vtkMTimeType before = this->filter->GetMTime();
  this->filter->SetLockedK(123); // what it is already
  EXPECT_EQ(this->filter->GetMTime(), before);
  this->filter->SetLockedK(0);
  EXPECT_NE(this->kAt(1), 123);
}

// A preview has fewer rays: it neither keeps its k nor the one of another view.
TEST_F(KeptK, IsThatOfAWholeImage)
{
  this->filter->SetPreviewReduction(4);
  EXPECT_NE(this->kAt(0), this->own[0]);
  this->filter->SetPreviewReduction(1);
  EXPECT_DOUBLE_EQ(this->kAt(0), this->own[0]);
  this->filter->SetParallelScale(0.1);
  this->filter->SetPreviewReduction(4);
  this->kAt(0);
  this->filter->SetPreviewReduction(1);
  this->filter->SetParallelScale(0);
  EXPECT_DOUBLE_EQ(this->kAt(1), this->own[1]);
}

// The stronger the flow, the nearer is the screen; in a series it stays.
TEST_F(KeptK, AutomaticScreenIsKeptLikeIt)
{
  this->filter->SetCutoff(Filter::SHADOWGRAPH);
  const auto distanceAt = [this](double time)
  {
    this->filter->UpdateTimeStep(time);
    return fieldValue(this->filter, "ScreenDistance");
  };
  const double first = distanceAt(0);
  EXPECT_EQ(distanceAt(2), first);
  this->filter->SetSmoothingRadius(2);
  EXPECT_EQ(distanceAt(1), first);
  this->filter->FitK();
  const double second = distanceAt(1);
  EXPECT_NEAR(second, first / 2, 0.05 * first);
  this->filter->SetScreenDistance(3); // what is kept waits
  EXPECT_EQ(distanceAt(2), 3);
  this->filter->SetScreenDistance(-1);
  EXPECT_EQ(distanceAt(2), second);
  this->filter->SetKMode(Filter::K_AUTOMATIC_KEPT);
  this->filter->SetViewDirection(0.6, 0, -0.8);
  EXPECT_EQ(distanceAt(1), second);
  this->filter->SetKMode(Filter::K_AUTOMATIC);
  EXPECT_NE(distanceAt(1), second);
}

namespace
{

/// A gas that becomes denser everywhere.
class KeptAmbient : public testing::Test
{
protected:
  KeptAmbient()
    : filter(bench(nullptr, 24))
  {
    this->source->make = [](double time)
    {
      auto image = cube(24);
      addPointArray(image, "N",
        [time, column = GaussianColumn()](const Vec& x)
        { return (1 + time) * (1e-4 + column(x)); });
      return image;
    };
    this->source->steps = { 0, 1, 2 };
    this->filter->SetInputConnection(this->source->GetOutputPort());
    this->filter->SetAmbientRefractivity(-1);
    this->filter->SetCutoff(Filter::INTERFEROGRAM);
  }

  double ambientAt(double time)
  {
    this->filter->UpdateTimeStep(time);
    return fieldValue(this->filter, "AmbientRefractivity");
  }

  vtkNew<Changing> source;
  vtkSmartPointer<Filter> filter;
};

} // namespace

TEST_F(KeptAmbient, AnotherMediumOrDataHaveTheirOwn)
{
  this->ambientAt(0);
  EXPECT_NEAR(this->ambientAt(2), 1e-4, 1e-8);
  this->filter->SetStepSize(1);
  EXPECT_NEAR(this->ambientAt(2), 1e-4, 1e-8);
  this->filter->SetOutside(vtkRefractiveIndex::OUTSIDE_PASSES);
  EXPECT_NEAR(this->ambientAt(2), 3e-4, 1e-8);
  EXPECT_NEAR(this->ambientAt(0), 3e-4, 1e-8);
  this->source->Modified();
  EXPECT_NEAR(this->ambientAt(0), 1e-4, 1e-8);
  // One that is given is used as it is, and what is kept waits.
  this->filter->SetAmbientRefractivity(5e-4);
  EXPECT_EQ(this->ambientAt(1), 5e-4);
  this->filter->SetAmbientRefractivity(-1);
  EXPECT_NEAR(this->ambientAt(1), 1e-4, 1e-8);
}

// The medium need not be made again where the surroundings are what was found for it.
TEST_F(KeptAmbient, LightAloneMakesNoMedium)
{
  this->ambientAt(1);
  for (const int cutoff : { Filter::KNIFE_EDGE, Filter::BRIGHT_FIELD })
  {
    const vtkTypeInt64 builds = this->filter->GetMediumBuilds();
    this->filter->SetCutoff(cutoff);
    this->ambientAt(1);
    EXPECT_EQ(this->filter->GetMediumBuilds(), builds);
  }
}
