// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What an image's legend says is what its pixels show.
#include "Fixtures.h"

#include "vtkPiecewiseFunction.h"
#include "vtkStringArray.h"

#include "Schlieren.h"

#include <cmath>
#include <string>
#include <vector>

namespace
{

constexpr int pixels = 96;

/// A weak ball of denser gas, whose light stays where it is.
vtkSmartPointer<vtkSchlierenFilter> ball()
{
  auto image = cube(49);
  addPointArray(
    image, "N", [](const Vec& x) { return 2e-5 * std::exp(-6 * dot(x, x)) + 1e-6 * x[0]; });
  auto filter = bench(image, pixels);
  filter->SetParallelScale(0.9);
  return filter;
}

vtkDataArray* legendArray(vtkAlgorithm* filter, const char* name)
{
  return filter->GetOutputDataObject(0)->GetFieldData()->GetArray(name);
}

std::string legendText(vtkAlgorithm* filter, const char* name, int index = 0)
{
  auto* texts = vtkStringArray::SafeDownCast(
    filter->GetOutputDataObject(0)->GetFieldData()->GetAbstractArray(name));
  return texts && texts->GetNumberOfValues() > index ? texts->GetValue(index) : "";
}

/// The byte that the legend has for a value (of two along u and v), between its neighbours.
double legendAt(vtkAlgorithm* filter, double u, double v, int channel)
{
  vtkDataArray* range = legendArray(filter, "LegendRange");
  vtkDataArray* size = legendArray(filter, "LegendSize");
  vtkDataArray* colors = legendArray(filter, "LegendColors");
  const double low = range->GetComponent(0, 0), high = range->GetComponent(1, 0);
  const int width = static_cast<int>(size->GetComponent(0, 0));
  const int height = static_cast<int>(size->GetComponent(1, 0));
  const auto placeOf = [&](double value, int count)
  { return std::clamp((value - low) / (high - low) * count - 0.5, 0., count - 1.); };
  const double x = placeOf(u, width), y = height > 1 ? placeOf(v, height) : 0;
  double sum = 0;
  for (int corner = 0; corner < 4; ++corner)
  {
    const int column = std::min(static_cast<int>(x) + corner % 2, width - 1);
    const int row = std::min(static_cast<int>(y) + corner / 2, height - 1);
    const double toRight = x - std::floor(x), toTop = y - std::floor(y);
    const double weight = (corner % 2 ? toRight : 1 - toRight) * (corner / 2 ? toTop : 1 - toTop);
    sum += weight * colors->GetComponent(vtkIdType{ row } * width + column, channel);
  }
  return sum;
}

/// The largest difference, in bytes, between an image's pixels and its legend at the values that a function returns
/// for a pixel: u, and v where the legend has two directions.
double worstDifference(
  vtkSchlierenFilter* filter, const std::function<Vec(vtkIdType)>& valuesAt, double fullLight = 1)
{
  filter->Update();
  vtkDataArray* color = arrayOf(filter, "Color");
  vtkDataArray* light = arrayOf(filter, "Intensity");
  double worst = 0;
  for (vtkIdType pixel = 0; pixel < light->GetNumberOfTuples(); ++pixel)
  {
    const Vec values = valuesAt(pixel);
    for (int channel = 0; channel < 3; ++channel)
    {
      const double shown =
        color ? color->GetComponent(pixel, channel) : 255 * light->GetTuple1(pixel) / fullLight;
      worst = std::max(worst, std::abs(shown - legendAt(filter, values[0], values[1], channel)));
    }
  }
  return worst;
}

double deflectionAlong(vtkSchlierenFilter* filter, vtkIdType pixel, double degrees)
{
  const double* eps = arrayOf(filter, "Deflection")->GetTuple3(pixel);
  const double angle = degrees * pi / 180;
  return eps[0] * std::cos(angle) + eps[1] * std::sin(angle);
}

// Of the mean over a pixel by the light in its middle, of the legend's steps, and of bytes.
constexpr double tolerance = 4;

} // namespace

TEST(Legend, ShowsTheLightOfAnEdgeOverTheDeflectionAlongIt)
{
  auto filter = ball();
  for (const double angle : { 0., 90., 210. })
  {
    filter->SetKnifeEdgeAngle(angle);
    filter->SetCutoffOffset(0.2);
    EXPECT_LT(worstDifference(filter,
                [&](vtkIdType pixel) {
                  return Vec{ deflectionAlong(filter, pixel, angle), 0, 0 };
                }),
      tolerance);
    EXPECT_EQ(legendArray(filter, "LegendAngle")->GetComponent(0, 0), angle);
    const double k = fieldValue(filter, "KScale");
    EXPECT_NEAR(legendArray(filter, "LegendRange")->GetComponent(0, 0) * k, -0.3, 1e-12);
    EXPECT_NEAR(legendArray(filter, "LegendRange")->GetComponent(1, 0) * k, 0.7, 1e-12);
  }
  EXPECT_EQ(legendText(filter, "LegendTitle"), "Knife Edge");
  EXPECT_EQ(legendText(filter, "LegendLabel"), "deflection along -150 degrees");
  EXPECT_EQ(legendText(filter, "LegendLabel", 1), "rad");
  vtkNew<vtkPiecewiseFunction> curve;
  curve->AddPoint(0, 0);
  curve->AddPoint(0.5, 1);
  curve->AddPoint(1, 0.3);
  filter->SetCutoff(vtkSchlierenFilter::GRADED_FILTER);
  filter->SetGradedFilter(curve);
  filter->SetKnifeEdgeAngle(0);
  EXPECT_LT(worstDifference(filter,
              [&](vtkIdType pixel) {
                return Vec{ deflectionAlong(filter, pixel, 0), 0, 0 };
              }),
    2 * tolerance);
  EXPECT_EQ(legendText(filter, "LegendLabel"), "deflection to the right");
}

TEST(Legend, ShowsTheLightOfStopsOverTheSizeOfTheDeflection)
{
  auto filter = ball();
  for (const int cutoff : { vtkSchlierenFilter::BRIGHT_FIELD, vtkSchlierenFilter::DARK_FIELD,
         vtkSchlierenFilter::NUMERICAL_SCHLIEREN })
  {
    filter->SetCutoff(cutoff);
    // Their light has a point where nothing is bent.
    EXPECT_LT(worstDifference(filter,
                [&](vtkIdType pixel)
                {
                  const double* eps = arrayOf(filter, "Deflection")->GetTuple3(pixel);
                  return Vec{ std::hypot(eps[0], eps[1]), 0, 0 };
                }),
      3 * tolerance);
    EXPECT_EQ(legendText(filter, "LegendLabel"), "deflection");
    EXPECT_EQ(legendArray(filter, "LegendAngle"), nullptr);
  }
}

TEST(Legend, ShowsColoursOverBothDirections)
{
  auto filter = ball();
  filter->SetCutoff(vtkSchlierenFilter::COLOR_FILTER);
  // Bytes in sRGB are steep, and the wheel has a point in its middle.
  EXPECT_LT(worstDifference(filter,
              [&](vtkIdType pixel)
              {
                const double* eps = arrayOf(filter, "Deflection")->GetTuple3(pixel);
                return Vec{ eps[0], eps[1], 0 };
              }),
    4 * tolerance);
  EXPECT_GT(legendArray(filter, "LegendSize")->GetComponent(1, 0), 1);
}

TEST(Legend, ShowsFringesOverThePathAndNoneOfTheCarrier)
{
  auto filter = ball();
  filter->SetCutoff(vtkSchlierenFilter::INTERFEROGRAM);
  filter->SetWavelength(3e5); // of a slow change, nanometres
  const auto path = [&](double scale)
  {
    return [&, scale](vtkIdType pixel) {
      return Vec{ scale * arrayOf(filter, "OpticalPathDifference")->GetTuple1(pixel), 0, 0 };
    };
  };
  EXPECT_LT(worstDifference(filter, path(1 / 3e-4)), tolerance);
  EXPECT_EQ(legendText(filter, "LegendLabel"), "optical path in wavelengths of 3e+05 nm");
  EXPECT_EQ(legendArray(filter, "LegendRange")->GetComponent(1, 0), 1);
  std::vector<double> before;
  for (vtkIdType i = 0; i < legendArray(filter, "LegendColors")->GetNumberOfTuples(); ++i)
  {
    before.push_back(legendArray(filter, "LegendColors")->GetComponent(i, 0));
  }
  filter->SetFringeSpacing(-10);
  filter->Update();
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    ASSERT_EQ(
      legendArray(filter, "LegendColors")->GetComponent(static_cast<vtkIdType>(i), 0), before[i]);
  }
}

TEST(Legend, ShowsLightOfAShadowgraphAndNothingOfAPattern)
{
  auto filter = ball();
  filter->SetCutoff(vtkSchlierenFilter::SHADOWGRAPH);
  EXPECT_LT(worstDifference(
              filter,
              [&](vtkIdType pixel) {
                return Vec{ arrayOf(filter, "Intensity")->GetTuple1(pixel), 0, 0 };
              },
              2),
    1);
  EXPECT_EQ(legendText(filter, "LegendLabel"), "light (undisturbed: 1)");
  filter->SetLengthScale(1e-2); // the cube's depth is 2
  filter->Update();
  const std::string note = legendText(filter, "LegendNotes");
  EXPECT_NE(note.find("m behind the data (automatic)"), std::string::npos) << note;
  EXPECT_NEAR(
    std::atof(note.substr(note.find(' ')).c_str()), 0.01 * fieldValue(filter, "ScreenDistance"), 1)
    << note;
  filter->SetLightModel(vtkSchlierenFilter::LIGHT_WAVES);
  filter->Update();
  EXPECT_EQ(legendText(filter, "LegendNotes"), "screen 20 mm behind the data (one depth)");
  filter->SetLightModel(vtkSchlierenFilter::LIGHT_RAYS);
  filter->SetScreenDistance(0.5);
  filter->Update();
  EXPECT_EQ(legendText(filter, "LegendNotes"), "screen 5 mm behind the data");
  filter->SetCutoff(vtkSchlierenFilter::BACKGROUND_ORIENTED);
  filter->Update();
  EXPECT_EQ(legendText(filter, "LegendTitle"), "Background Oriented");
  EXPECT_EQ(legendArray(filter, "LegendSize")->GetComponent(0, 0), 0);
  double largest = 0;
  for (vtkIdType pixel = 0; pixel < pixels * pixels; ++pixel)
  {
    const double* moved = arrayOf(filter, "BackgroundDisplacement")->GetTuple3(pixel);
    largest = std::max(largest, std::hypot(moved[0], moved[1]));
  }
  const auto pixel = [&filter]
  { return vtkImageData::SafeDownCast(filter->GetOutputDataObject(0))->GetSpacing()[0]; };
  char words[64];
  std::snprintf(words, sizeof words, "pattern displaced by up to %.3g pixels", largest / pixel());
  EXPECT_EQ(legendText(filter, "LegendNotes"), words);
  EXPECT_NEAR(fieldValue(filter, "PatternPixel") / pixel(), 1, 1e-12);

  // With a perspective a pixel is larger on the pattern, by the distances from the camera.
  filter->SetViewAngle(40);
  filter->SetBackgroundDistance(7);
  filter->Update();
  largest = 0;
  for (vtkIdType number = 0; number < pixels * pixels; ++number)
  {
    const double* moved = arrayOf(filter, "BackgroundDisplacement")->GetTuple3(number);
    largest = std::max(largest, std::hypot(moved[0], moved[1]));
  }
  const double away = 0.5 * pixels * pixel() / std::tan(20 * pi / 180), halfDepth = 1;
  const double behind = pixel() * (away + halfDepth + 7) / away;
  EXPECT_NEAR(fieldValue(filter, "PatternPixel") / behind, 1, 1e-9);
  std::snprintf(words, sizeof words, "pattern displaced by up to %.3g pixels", largest / behind);
  EXPECT_EQ(legendText(filter, "LegendNotes"), words);
}

TEST(Legend, SaysWhereKComesFrom)
{
  auto filter = ball();
  filter->Update();
  EXPECT_NE(legendText(filter, "LegendNotes").find("(automatic)"), std::string::npos);
  filter->SetKMode(vtkSchlierenFilter::K_VALUE);
  filter->SetKScale(1500);
  filter->Update();
  EXPECT_EQ(legendText(filter, "LegendNotes"), "k = 1500 (fixed)");
  filter->SetKMode(vtkSchlierenFilter::K_AUTOMATIC_KEPT);
  filter->SetLockedK(1200);
  filter->Update();
  EXPECT_EQ(legendText(filter, "LegendNotes"), "k = 1200 (kept)");
}

// As of a density that is constant up to rounding.
TEST(Legend, SaysWhatIsTooWeakForABench)
{
  auto filter = ball();
  filter->SetKMode(vtkSchlierenFilter::K_VALUE);
  for (const double k : { 1e5, 4.9e5, 5.1e5, 2.5e8 }) // full scale is 1 / 2k
  {
    filter->SetKScale(k);
    filter->Update();
    auto* notes = vtkStringArray::SafeDownCast(
      filter->GetOutputDataObject(0)->GetFieldData()->GetAbstractArray("LegendNotes"));
    ASSERT_NE(notes, nullptr);
    const bool isWeak = k > 5e5;
    EXPECT_EQ(notes->LookupValue("weaker than a bench can see (about 1 \xC2\xB5rad)") >= 0, isWeak);
    const std::string words = filter->GetSensitivity();
    EXPECT_EQ(words.find("weaker than a bench can see") != std::string::npos, isWeak) << words;
    EXPECT_EQ(words.find("optics") != std::string::npos, !isWeak) << words;
  }
}

TEST(Legend, NeedsASensitivity)
{
  schlieren::Scene scene;
  EXPECT_EQ(schlieren::legendOf(scene, 0).quantity, schlieren::Legend::Quantity::None);
  EXPECT_TRUE(schlieren::legendOf(scene, 0).light.empty());
  EXPECT_EQ(schlieren::legendOf(scene, 1e3).quantity, schlieren::Legend::Quantity::Deflection);
}
