// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the filter's properties mean to the tracer.
#include "Fixtures.h"
#include "Image/RealOptics.h"
#include "Image/RgbImages.h"
#include "Image/SceneFromSettings.h"

#include "vtkMath.h"
#include "vtkPiecewiseFunction.h"

#include <cmath>
#include <limits>

using namespace filters;

namespace
{

using Filter = vtkSchlierenFilter;

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

/// A bench for a box of 4 x 4 x 2 data units, seen along its depth of 2, in 80 x 40 pixels.
class Scene : public testing::Test
{
protected:
  Scene()
  {
    this->grid.dimensions = { 41, 41, 21 };
    this->grid.origin = { -2, -2, -1 };
    this->grid.spacing = { 0.1, 0.1, 0.1 };
    this->filter->SetImageSize(80, 40);
    this->filter->SetParallelScale(3);
  }

  schlieren::Scene scene()
  {
    schlieren::Scene made = sceneFrom(this->filter->GetSettings(), this->grid, this->images);
    made.gradedFilter = gradedFilterFrom(this->filter->GetGradedFilter());
    return made;
  }

  std::string error()
  {
    try
    {
      this->scene();
    }
    catch (const std::runtime_error& problem)
    {
      return problem.what();
    }
    return "none";
  }

  vtkNew<Filter> filter;
  schlieren::Grid grid;
  RgbImageReader images;
};

} // namespace

// k = f / a, whatever KScale says.
TEST_F(Scene, SensitivityFollowsFromOptics)
{
  this->filter->SetKMode(Filter::K_BENCH);
  this->filter->SetMirrorFocalLength(1.5);
  this->filter->SetSourceWidth(0.5);
  this->filter->SetCutoffOffset(7);
  EXPECT_DOUBLE_EQ(this->scene().kScale.value_or(0), 3000);
  EXPECT_DOUBLE_EQ(this->scene().cutoffOffset, 7);
  this->filter->SetKMode(Filter::K_VALUE);
  EXPECT_DOUBLE_EQ(this->scene().kScale.value_or(0), 1000);
  EXPECT_DOUBLE_EQ(this->scene().cutoffOffset, 7);
  for (const int mode : { Filter::K_AUTOMATIC, Filter::K_AUTOMATIC_KEPT })
  {
    this->filter->SetKMode(mode);
    EXPECT_FALSE(this->scene().kScale.has_value());
    EXPECT_DOUBLE_EQ(this->scene().cutoffOffset, 7);
  }
}

TEST_F(Scene, SensitivityIsStatedInWords)
{
  this->filter->SetMirrorFocalLength(2);
  EXPECT_EQ(sensitivityInWords(this->filter->GetSettings(), 4000),
    "k = 4000: full scale is a deflection of 0.125 mrad; optics: 2 m focal length, source 0.5 mm "
    "wide");
  this->filter->SetCutoff(Filter::BRIGHT_FIELD);
  EXPECT_EQ(sensitivityInWords(this->filter->GetSettings(), 4000).substr(0, 49),
    "k = 4000: full scale is a deflection of 0.25 mrad");
  this->filter->SetCutoff(Filter::KNIFE_EDGE);
  this->filter->SetKMode(Filter::K_BENCH);
  this->filter->SetCutoffOffset(-0.1);
  EXPECT_NE(sensitivityInWords(this->filter->GetSettings(), 4000).find("the edge -0.1 mm in"),
    std::string::npos);
  EXPECT_EQ(sensitivityInWords(this->filter->GetSettings(), 0), "");
  this->filter->SetCutoff(Filter::SHADOWGRAPH);
  EXPECT_EQ(sensitivityInWords(this->filter->GetSettings(), 4000), "");
}

// The image of a colour filter covers k eps from -1 to 1: light that f eps = w / 2 moves, from its middle, reaches the edge.
TEST_F(Scene, AFilterIsAsWideAsSourceWidth)
{
  this->filter->SetCutoff(Filter::COLOR_FILTER);
  this->filter->SetKMode(Filter::K_BENCH);
  this->filter->SetMirrorFocalLength(0.75);
  this->filter->SetSourceWidth(3);
  EXPECT_DOUBLE_EQ(this->scene().kScale.value_or(0), 500);
  EXPECT_EQ(sensitivityInWords(this->filter->GetSettings(), 500),
    "k = 500: full scale is a deflection of 2 mrad; optics: 0.75 m focal length, filter 3 mm wide");
  this->filter->SetSourceShape(Filter::DISC);
  EXPECT_NE(this->error().find("SourceWidth is the width of the colour filter"), std::string::npos);
}

// An interferogram has no k: a fringe is a wavelength.
TEST_F(Scene, SensitivityOfAnInterferogramIsItsWavelength)
{
  this->filter->SetCutoff(Filter::INTERFEROGRAM);
  this->filter->SetWavelength(500);
  EXPECT_EQ(
    sensitivityInWords(this->filter->GetSettings(), 0).find("a fringe is 500 nm of optical path"),
    0u);
}

TEST_F(Scene, OpticsThatCannotBeAreRefused)
{
  this->filter->SetKMode(Filter::K_BENCH);
  for (const double wrong : { 0., -1., notANumber, HUGE_VAL })
  {
    this->filter->SetMirrorFocalLength(wrong);
    EXPECT_NE(this->error().find("MirrorFocalLength is "), std::string::npos) << wrong;
    this->filter->SetMirrorFocalLength(1);
    this->filter->SetSourceWidth(wrong);
    EXPECT_NE(this->error().find("SourceWidth is "), std::string::npos) << wrong;
    this->filter->SetSourceWidth(1);
  }
  this->filter->SetMirrorFocalLength(1500);
  EXPECT_NE(this->error().find("MirrorFocalLength is 1500 m, but no mirror"), std::string::npos);
  this->filter->SetMirrorFocalLength(1);
  // Where they do not count, they may be anything.
  this->filter->SetMirrorFocalLength(0);
  this->filter->SetCutoff(Filter::INTERFEROGRAM);
  EXPECT_EQ(this->error(), "none");
}

TEST_F(Scene, GradedFilterIsReadOffFromItsFunction)
{
  this->filter->SetCutoff(Filter::GRADED_FILTER);
  EXPECT_EQ(this->scene().gradedFilter, (std::vector<double>{ 0, 1 }));
  vtkNew<vtkPiecewiseFunction> function;
  this->filter->SetGradedFilter(function);
  EXPECT_EQ(this->scene().gradedFilter, (std::vector<double>{ 0, 1 }));
  const vtkMTimeType before = this->filter->GetMTime();
  function->AddPoint(-1, 0); // beyond the filter's edge
  function->AddPoint(0.5, 0.75);
  function->AddPoint(1, 0.25);
  EXPECT_GT(this->filter->GetMTime(), before);
  const std::vector<double> values = this->scene().gradedFilter;
  ASSERT_EQ(values.size(), 1025u);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const double x = static_cast<double>(i) / 1024;
    EXPECT_NEAR(values[i], x < 0.5 ? 0.5 * (x + 1) : 0.75 - (x - 0.5), 1e-12) << x;
  }
}

TEST_F(Scene, LightIsAsLargeAsItIsSeenFromTheData)
{
  this->filter->SetMirrorFocalLength(2);
  this->filter->SetSourceWidth(4);
  this->filter->SetSourceLength(6);
  this->filter->SetSourceShape(Filter::SLIT);
  schlieren::LightSource source = this->scene().source;
  EXPECT_EQ(source.shape, schlieren::SourceShape::Slit);
  EXPECT_FALSE(source.distance.has_value());
  EXPECT_DOUBLE_EQ(source.width, 2e-3);
  EXPECT_DOUBLE_EQ(source.length, 3e-3);
  this->filter->SetSourceShape(Filter::DISC);
  source = this->scene().source;
  EXPECT_EQ(source.shape, schlieren::SourceShape::Disc);
  EXPECT_DOUBLE_EQ(source.width, 2e-3);
  this->filter->SetMirrorFocalLength(0);
  EXPECT_NE(this->error().find("MirrorFocalLength is 0 m"), std::string::npos);
  this->filter->SetMirrorFocalLength(1);
  this->filter->SetSourceWidth(-1);
  EXPECT_NE(this->error().find("SourceWidth is -1 mm"), std::string::npos);
  this->filter->SetSourceWidth(0);
  EXPECT_EQ(this->error(), "none");
}

TEST_F(Scene, LensHasTheApertureOfItsFNumber)
{
  EXPECT_EQ(this->scene().lens.aperture, 0);
  this->filter->SetLengthScale(0.01);
  this->filter->SetFNumber(4);
  schlieren::Lens lens = this->scene().lens;
  EXPECT_DOUBLE_EQ(lens.aperture, 1.25); // 12.5 mm
  EXPECT_DOUBLE_EQ(lens.apertureRatio, 0.25);
  EXPECT_FALSE(lens.focusDistance.has_value());
  this->filter->SetFocusDistance(30);
  EXPECT_EQ(this->scene().lens.focusDistance, 30);

  // Half of a sensor 24 mm high, of twice as many columns as rows, where a thin lens has the image of what is 30 cm away.
  this->filter->SetSensorWidth(48);
  const double behind = 1 / (1 / 0.05 - 1 / 0.3);
  EXPECT_NEAR(
    this->scene().view.viewAngle, 2 * vtkMath::DegreesFromRadians(std::atan(0.012 / behind)), 1e-9);
  this->filter->SetFocusDistance(5); // what is that near has no image
  EXPECT_NE(this->error().find("FocusDistance is 5 data units"), std::string::npos);
  this->filter->SetFocusDistance(0);
  const schlieren::View view = this->scene().view;
  const double away = 0.01 * schlieren::frameOf(this->grid, view).pupil; // metres
  EXPECT_NEAR(
    std::tan(vtkMath::RadiansFromDegrees(view.viewAngle) / 2), 0.012 * (1 / 0.05 - 1 / away), 1e-9);
}

TEST_F(Scene, CamerasThatCannotBeAreRefused)
{
  for (const double wrong : { -1., notANumber, HUGE_VAL })
  {
    this->filter->SetFNumber(wrong);
    EXPECT_NE(this->error().find("FNumber is "), std::string::npos) << wrong;
    this->filter->SetFNumber(4);
    this->filter->SetLensFocalLength(wrong);
    EXPECT_NE(this->error().find("LensFocalLength is "), std::string::npos) << wrong;
    this->filter->SetLensFocalLength(50);
    this->filter->SetSensorWidth(wrong);
    EXPECT_NE(this->error().find("SensorWidth is "), std::string::npos) << wrong;
    this->filter->SetSensorWidth(0);
  }
  // Lengths in another unit.
  this->filter->SetLensFocalLength(0.05);
  EXPECT_NE(
    this->error().find("LensFocalLength is 0.05 mm, but no camera is so small. Set it to 50 "),
    std::string::npos);
  this->filter->SetLensFocalLength(50);
  this->filter->SetSensorWidth(0.036);
  EXPECT_NE(this->error().find("Set it to 36 "), std::string::npos);
  this->filter->SetSensorWidth(0);
  EXPECT_EQ(this->error(), "none");
}

TEST_F(Scene, LightDivergesFromASourceAtADistance)
{
  EXPECT_FALSE(this->scene().source.distance.has_value());
  this->filter->SetSourceDistance(7);
  EXPECT_DOUBLE_EQ(this->scene().source.distance.value_or(0), 7);
}

TEST_F(Scene, FringesHaveASpacingOrANumber)
{
  this->filter->SetCutoff(Filter::INTERFEROGRAM);
  this->filter->SetWavelength(500);
  EXPECT_DOUBLE_EQ(this->scene().wavelength, 500e-9);
  EXPECT_FALSE(this->scene().fringes.finite);
  this->filter->SetFringeSpacing(-10);
  this->filter->SetFringeAngle(30);
  EXPECT_TRUE(this->scene().fringes.finite);
  EXPECT_DOUBLE_EQ(this->scene().fringes.angle, 30);
  EXPECT_DOUBLE_EQ(this->scene().fringes.spacing, 0.6); // the image is 6 high
  this->filter->SetFringeSpacing(0.125);
  EXPECT_DOUBLE_EQ(this->scene().fringes.spacing, 0.125);
}

TEST_F(Scene, BackgroundIsAPattern)
{
  this->filter->SetCutoff(Filter::BACKGROUND_ORIENTED);
  EXPECT_EQ(this->scene().background.kind, schlieren::PatternKind::Dots);
  EXPECT_FALSE(this->scene().background.distance.has_value());
  this->filter->SetBackgroundPattern(Filter::STRIPES);
  this->filter->SetBackgroundDistance(0);
  this->filter->SetBackgroundPeriod(0.2);
  this->filter->SetFringeAngle(45);
  const schlieren::BackgroundPattern pattern = this->scene().background;
  EXPECT_EQ(pattern.kind, schlieren::PatternKind::Stripes);
  EXPECT_EQ(pattern.distance.value_or(-1), 0);
  EXPECT_EQ(pattern.period, 0.2);
  EXPECT_EQ(pattern.angle, 45);
  this->filter->SetBackgroundPattern(Filter::PICTURE);
  EXPECT_NE(this->error().find("BackgroundImage is empty"), std::string::npos);
  this->filter->SetBackgroundImage("/nowhere.png");
  EXPECT_NE(this->error().find("BackgroundImage names the file '/nowhere.png'"), std::string::npos);
}

// A pixel of red 255, green 16 and blue 32, as a PNG file.
TEST_F(Scene, ColorFilterIsAWheelOrAImage)
{
  this->filter->SetCutoff(Filter::COLOR_FILTER);
  EXPECT_EQ(this->scene().colorFilter, nullptr);
  this->filter->SetColorFilterImage(
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4"
    "L6AAAANBATCX20YHAAAAAElFTkSuQmCC");
  ASSERT_NE(this->scene().colorFilter, nullptr);
  EXPECT_EQ(this->scene().colorFilter->rgb, (std::vector<unsigned char>{ 255, 16, 32 }));
}
