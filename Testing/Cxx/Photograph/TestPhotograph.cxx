// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a comparison finds in photographs is what they were made with.
#include "Photographs.h"

#include "vtkCompareWithPhotograph.h"
#include "vtkMath.h"

#include <cmath>
#include <ctime>
#include <regex>

namespace
{

using namespace photographs;

constexpr double offset = -0.12, edgeAngle = 92.5, kFactor = 2;

/// The simulated image, and the light of the experiment: another image, finer, with another edge.
struct Jet
{
  vtkSmartPointer<vtkSchlierenFilter> bench;
  double k = 0;           // of the experiment
  double undisturbed = 0; // likewise
  Plane light;
  Grid grid;

  explicit Jet(double factor = kFactor, double cutoffOffset = offset, double size = 1)
    : bench(jetBench(size))
  {
    this->bench->Update();
    auto finer = jetBench(1.5 * size);
    finer->SetKMode(vtkSchlierenFilter::K_VALUE);
    this->k = factor * fieldValue(this->bench, "KScale");
    finer->SetKScale(this->k);
    finer->SetCutoffOffset(cutoffOffset);
    finer->SetKnifeEdgeAngle(edgeAngle);
    finer->SetSamplesPerPixel(4);
    finer->Update();
    this->undisturbed = 0.5 - cutoffOffset;
    this->light = planeOf(finer, "Intensity");
    this->grid = Grid(finer->GetOutput());
  }
};

const Jet& jet()
{
  static const Jet one;
  return one;
}

/// Turned by 3 degrees, scaled by 1.07 and shifted.
Place truePlace(int width = columns, int height = rows)
{
  Place place;
  place.anchor = { 0.5 * (width - 1), 0.5 * (height - 1) };
  const auto middle = Grid(jet().bench->GetOutput()).middle();
  place.position = { middle[0] + 3.75 * pixel, middle[1] - 2.25 * pixel };
  place.scale = pixel / 1.07 * columns / width;
  place.rotation = vtkMath::RadiansFromDegrees(3.);
  return place;
}

void giveMirror(vtkCompareWithPhotograph* comparison, const Film& film = {})
{
  comparison->SetMirrorCenter(0.5 * (film.width - 1) + mirrorX, 0.5 * (film.height - 1) + mirrorY);
  comparison->SetMirrorRadius((film.mirror - 0.01) * film.width);
}

void givePlace(vtkCompareWithPhotograph* comparison, const Place& place)
{
  comparison->SetPlacement(vtkCompareWithPhotograph::PLACE_BY_HAND);
  comparison->SetPhotographPosition(place.position.data());
  comparison->SetPhotographScale(place.scale);
  comparison->SetPhotographRotation(vtkMath::DegreesFromRadians(place.rotation));
}

vtkSmartPointer<vtkCompareWithPhotograph> compared(vtkSchlierenFilter* bench, const Taken& taken,
  const Place& place, bool hasOther = true, const Film& film = {})
{
  auto comparison = vtkSmartPointer<vtkCompareWithPhotograph>::New();
  comparison->SetInputConnection(0, bench->GetOutputPort());
  comparison->SetInputData(1, taken.withFlow);
  if (hasOther)
  {
    comparison->SetInputData(2, taken.withoutFlow);
  }
  giveMirror(comparison, film);
  givePlace(comparison, place);
  comparison->SetGamma(1 / film.gamma);
  return comparison;
}

/// The light of a jet that is longer by a part of its length.
Plane stretched(const Plane& light, double by)
{
  const filters::Lookup at(light);
  Plane result(light.columns, light.rows);
  for (int row = 0; row < light.rows; ++row)
  {
    for (int column = 0; column < light.columns; ++column)
    {
      result(column, row) = at(column / (1 + by), row, 0);
    }
  }
  return result;
}

/// By how much the shift across features exceeds that of a jet that is longer, pixels.
struct ShiftErrors
{
  double median; // of all features, without sign
  double disc;   // the mean at the Mach disc
  std::size_t points;
};

ShiftErrors errorsOfShift(vtkAlgorithm* comparison, double by)
{
  const Plane slope =
    filters::gradientOf(filters::blurred(planeOf(comparison, "Simulated"), 1)).first;
  const Plane right = planeOf(comparison, "FeatureShift"),
              up = planeOf(comparison, "FeatureShift", 1);
  std::vector<double> errors;
  double disc = 0, weights = 0;
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      const double x = right(column, row) / pixel, y = up(column, row) / pixel;
      const double length = std::hypot(x, y);
      if (std::isfinite(length))
      {
        const double error = length - by * column * x / std::max(length, 1e-9);
        errors.push_back(std::abs(error));
        if (row >= 62 && row < 88 && column >= 89 && column < 95)
        {
          const double weight = slope(column, row) * slope(column, row);
          disc += weight * error;
          weights += weight;
        }
      }
    }
  }
  std::nth_element(
    errors.begin(), errors.begin() + static_cast<long>(errors.size() / 2), errors.end());
  return { errors.empty() ? HUGE_VAL : errors[errors.size() / 2], disc / weights, errors.size() };
}

/// Of an interferometer; the phase is that at the image's middle, fringes.
struct ReferenceBeam
{
  double spacing; // m, 0 of infinite fringes
  double angle;   // degrees
  double phase;
  double contrast;
};

/// An interferogram of the jet with infinite fringes, and photographs of that behind another reference beam. `strength`: of the
/// flow.
struct Interferograms
{
  vtkSmartPointer<vtkSchlierenFilter> bench, finer;
  Taken taken;

  explicit Interferograms(const ReferenceBeam& beam, double strength = 1)
    : bench(make(1, strength))
    , finer(make(1.5, strength))
  {
    const Grid grid(finer->GetOutput());
    const auto middle = Grid(this->bench->GetOutput()).middle();
    const double wavelength = fieldValue(this->bench, "Wavelength");
    EXPECT_NEAR(wavelength, 1e-9 * finer->GetWavelength(), 1e-15);
    const double angle = vtkMath::RadiansFromDegrees(beam.angle);
    const std::vector<double> paths = valuesOf(finer, "OpticalPathDifference");
    Plane light[2];
    for (const bool hasFlow : { false, true })
    {
      light[hasFlow ? 1 : 0] = Plane(grid.columns, grid.rows);
      for (std::size_t i = 0; i < paths.size(); ++i)
      {
        const int column = static_cast<int>(i) % grid.columns;
        const auto at = grid.at(column, static_cast<int>(i) / grid.columns);
        const double across =
          (at[0] - middle[0]) * std::cos(angle) + (at[1] - middle[1]) * std::sin(angle);
        const double turns = (hasFlow ? paths[i] / wavelength : 0) + beam.phase +
          (beam.spacing > 0 ? across / beam.spacing : 0);
        light[hasFlow ? 1 : 0].values[i] =
          static_cast<float>(0.5 * (1 + beam.contrast * std::cos(2 * vtkMath::Pi() * turns)));
      }
    }
    this->taken = { take(light[1], grid, truePlace(), 0.5).withFlow,
      take(light[0], grid, truePlace(), 0.5).withFlow };
  }

  static vtkSmartPointer<vtkSchlierenFilter> make(double factor, double strength)
  {
    auto filter = jetBench(factor);
    filter->SetCutoff(vtkSchlierenFilter::INTERFEROGRAM);
    filter->SetLengthScale(strength);
    filter->Update();
    return filter;
  }
};

std::string report(vtkCompareWithPhotograph* comparison) { return comparison->GetReport(); }

bool has(const std::string& text, const std::string& words)
{
  return text.find(words) != std::string::npos;
}

vtkDataArray* fieldArray(vtkAlgorithm* filter, const char* name)
{
  return filter->GetOutputDataObject(0)->GetFieldData()->GetArray(name);
}

void expectFringes(vtkCompareWithPhotograph* comparison, const ReferenceBeam& truth)
{
  comparison->Update();
  ASSERT_NE(fieldArray(comparison, "PhotographFringeContrast"), nullptr);
  EXPECT_NEAR(fieldValue(comparison, "PhotographFringeContrast"), truth.contrast, 0.05);
  EXPECT_NEAR(
    std::remainder(fieldValue(comparison, "PhotographFringePhase") - truth.phase, 1), 0, 0.05);
  if (truth.spacing > 0)
  {
    EXPECT_NEAR(fieldValue(comparison, "PhotographFringeSpacing") / truth.spacing, 1, 0.01);
    EXPECT_NEAR(
      std::remainder(fieldValue(comparison, "PhotographFringeAngle") - truth.angle, 360), 0, 0.5);
  }
  else
  {
    EXPECT_EQ(fieldValue(comparison, "PhotographFringeSpacing"), 0);
    EXPECT_EQ(fieldArray(comparison, "PhotographFringeAngle"), nullptr);
  }
  EXPECT_FALSE(has(report(comparison), "sign")) << report(comparison);
  EXPECT_EQ(fieldArray(comparison, "PhotographContrast"), nullptr);
  EXPECT_GT(fieldValue(comparison, "PhotographCorrelation"), 0.95);
  EXPECT_LT(fieldValue(comparison, "FeatureShiftMedian") / pixel, 0.1);
}

/// A round body, whose top and bottom noses say how the photograph is turned, before a column of gas, and the light of
/// an experiment with it on a finer grid.
struct Body
{
  vtkSmartPointer<vtkSchlierenFilter> bench = make(2);
  vtkSmartPointer<vtkSchlierenFilter> finer = make(4);
  Film film;
  Place truth;

  Body()
  {
    const auto middle = Grid(this->bench->GetOutput()).middle();
    const double point = this->bench->GetOutput()->GetSpacing()[0];
    this->film.width = 2 * columns;
    this->film.height = 2 * rows;
    this->truth = { { 0.5 * (film.width - 1), 0.5 * (film.height - 1) },
      { middle[0] + 7.5 * point, middle[1] - 4.5 * point }, point / 1.07,
      vtkMath::RadiansFromDegrees(3.), 1 };
  }

  static vtkSmartPointer<vtkSchlierenFilter> make(int factor)
  {
    auto gas = cube(96);
    addPointArray(gas, "N",
      [](const Vec& x)
      {
        const bool isBody = std::hypot(x[0] - 0.2, 0.5 * x[1]) < 0.3;
        return isBody ? std::nan("") : 2e-5 * std::exp(-4 * dot(x, x));
      });
    auto filter = ::bench(gas);
    filter->SetImageSize(columns * factor, rows * factor);
    filter->SetParallelScale(0.75);
    filter->SetAmbientRefractivity(0);
    filter->SetSamplesPerPixel(factor == 2 ? 8 : 4);
    filter->SetKMode(vtkSchlierenFilter::K_VALUE);
    filter->SetKScale(8000);
    filter->Update();
    return filter;
  }
};

/// The greatest distance of two places of a photograph's corners, points of the image.
double distanceOf(const Place& one, const Place& other, double point, const Film& film = {})
{
  double largest = 0;
  for (const double x : { 0., film.width - 1. })
  {
    for (const double y : { 0., film.height - 1. })
    {
      const auto a = one.inImage({ x, y }), b = other.inImage({ x, y });
      largest = std::max(largest, std::hypot(a[0] - b[0], a[1] - b[1]) / point);
    }
  }
  return largest;
}

Place foundPlace(vtkAlgorithm* comparison, const Film& film = {})
{
  vtkDataArray* middle = fieldArray(comparison, "PhotographPlace");
  return { { 0.5 * (film.width - 1), 0.5 * (film.height - 1) },
    { middle->GetComponent(0, 0), middle->GetComponent(1, 0) },
    fieldValue(comparison, "PhotographScale"),
    vtkMath::RadiansFromDegrees(fieldValue(comparison, "PhotographRotation")), 1 };
}

} // namespace

TEST(Photograph, KnifeEdgeIsFoundWhereLightIsClipped)
{
  const Jet large(kFactor, offset, 2);
  Film film;
  film.width = 2 * columns;
  film.height = 2 * rows;
  film.dust = 40;
  film.blur = 0.8;
  film.readNoise = 8;
  const Place place = truePlace(film.width, film.height);
  const Taken taken = take(large.light, large.grid, place, large.undisturbed, film);
  for (const bool hasOther : { true, false })
  {
    auto comparison = compared(large.bench, taken, place, hasOther, film);
    comparison->Update();
    EXPECT_GT(fieldValue(comparison, "PhotographFullFraction"), 0.01);
    EXPECT_NEAR(
      fieldValue(comparison, "PhotographContrast") * large.undisturbed / large.k, 1, 0.02);
    EXPECT_NEAR(fieldValue(comparison, "PhotographK") / large.k, 1, 0.02);
    EXPECT_NEAR(fieldValue(comparison, "PhotographOffset"), offset, 0.02);
    EXPECT_NEAR(fieldValue(comparison, "PhotographAngle"), edgeAngle, hasOther ? 0.3 : 1);
    EXPECT_NEAR(fieldValue(comparison, "PhotographAngleUncertainty"), 0, 1);
    EXPECT_NEAR(fieldValue(comparison, "PhotographBlackLevel"), 0.03, 0.003);
    EXPECT_LT(fieldValue(comparison, "PhotographResidual"), hasOther ? 0.006 : 0.015);
    EXPECT_TRUE(has(report(comparison), "k is ")) << report(comparison);
  }
}

TEST(Photograph, KAndOffsetCannotBeSeparatedWithoutClippedLight)
{
  const Jet weak(0.35, 0);
  const Taken taken = take(weak.light, weak.grid, truePlace(), weak.undisturbed);
  auto comparison = compared(weak.bench, taken, truePlace());
  comparison->Update();
  EXPECT_NEAR(fieldValue(comparison, "PhotographContrast") * weak.undisturbed / weak.k, 1, 0.02);
  EXPECT_TRUE(has(report(comparison), "k and offset cannot be separated")) << report(comparison);
  EXPECT_EQ(fieldArray(comparison, "PhotographK"), nullptr);
  EXPECT_EQ(fieldArray(comparison, "PhotographOffset"), nullptr);
}

TEST(Photograph, FeaturesOfTheSameFlowDoNotMove)
{
  const Taken taken = take(jet().light, jet().grid, truePlace(), jet().undisturbed);
  auto comparison = compared(jet().bench, taken, truePlace());
  comparison->Update();
  const ShiftErrors errors = errorsOfShift(comparison, 0);
  EXPECT_GT(errors.points, 2500u);
  EXPECT_LT(errors.median, 0.05);
  EXPECT_LT(std::abs(errors.disc), 0.05);
  EXPECT_NEAR(fieldValue(comparison, "FeatureShiftMedian") / pixel, errors.median, 1e-3);
}

TEST(Photograph, FeaturesOfALongerJetAreFoundWhereTheyAre)
{
  const Taken taken =
    take(stretched(jet().light, 0.02), jet().grid, truePlace(), jet().undisturbed);
  auto comparison = compared(jet().bench, taken, truePlace());
  comparison->Update();
  const ShiftErrors errors = errorsOfShift(comparison, 0.02);
  EXPECT_GT(errors.points, 2500u);
  EXPECT_LT(errors.median, 0.3);
  EXPECT_LT(std::abs(errors.disc), 0.3); // of 1.8 pixels
  EXPECT_NEAR(fieldValue(comparison, "PhotographK") / jet().k, 1, 0.02);
  EXPECT_FALSE(has(report(comparison), "Warning"));
  const Plane right = planeOf(comparison, "FeatureShift"),
              up = planeOf(comparison, "FeatureShift", 1);
  std::string words; // where it is to the right
  for (std::size_t i = 0; i < right.size() && words.empty(); ++i)
  {
    if (right.values[i] > pixel && right.values[i] < 3 * pixel &&
      std::abs(up.values[i]) < 0.1 * pixel)
    {
      comparison->SetProbedPlace((static_cast<double>(i % columns) + 0.5) / columns,
        (static_cast<double>(i / columns) + 0.5) / rows);
      words = comparison->GetProbedPlace();
    }
  }
  EXPECT_TRUE(std::regex_search(words,
    std::regex("^The photograph's feature lies [1-4][0-9]{2} .*m to the right; photograph 0")))
    << words;

  // Placed by the flow, most of that is hidden, and a warning says so.
  comparison->SetFitPlace(vtkCompareWithPhotograph::FIT_FLOW);
  comparison->Update();
  EXPECT_TRUE(has(report(comparison), "Warning: it was placed by its flow")) << report(comparison);
  EXPECT_LT(std::abs(errorsOfShift(comparison, 0).disc), 1.5);
  EXPECT_GT(distanceOf(foundPlace(comparison), truePlace(), pixel), 2);
}

TEST(Photograph, SilhouettePlacesThePhotograph)
{
  const Body body;
  const double point = body.bench->GetOutput()->GetSpacing()[0];
  const Taken taken = take(
    planeOf(body.finer, "Intensity"), Grid(body.finer->GetOutput()), body.truth, 0.5, body.film);
  Place start = body.truth;
  start.rotation = 0;
  start.position = Grid(body.bench->GetOutput()).middle();
  auto comparison = compared(body.bench, taken, start, true, body.film);
  comparison->SetFitPlace(vtkCompareWithPhotograph::FIT_BODY);
  comparison->Update();
  EXPECT_GT(distanceOf(start, body.truth, point, body.film), 8);
  EXPECT_LT(distanceOf(foundPlace(comparison, body.film), body.truth, point, body.film), 0.3);
}

TEST(Photograph, PointsPlaceThePhotograph)
{
  const Taken taken = take(jet().light, jet().grid, truePlace(), jet().undisturbed);
  auto comparison = compared(jet().bench, taken, truePlace());
  comparison->SetFitCutoff(false);
  comparison->SetFindFeatureShift(false);
  comparison->Update();
  const std::vector<double> byHand = valuesOf(comparison, "Photograph");
  const auto expectSame = [&](const char* how)
  {
    comparison->Update();
    const std::vector<double> now = valuesOf(comparison, "Photograph");
    ASSERT_EQ(now.size(), byHand.size());
    double worst = 0;
    for (std::size_t i = 0; i < now.size(); ++i)
    {
      if (std::isfinite(now[i]) && std::isfinite(byHand[i]))
      {
        worst = std::max(worst, std::abs(now[i] - byHand[i]));
      }
    }
    EXPECT_LT(worst, 1e-4) << how;
  };
  comparison->SetPlacement(vtkCompareWithPhotograph::PLACE_ONE_POINT);
  comparison->SetPhotographPoint1(45, 20);
  comparison->SetFlowPoint1(truePlace().inImage({ 45, 20 }).data());
  expectSame("one point");
  comparison->SetPlacement(vtkCompareWithPhotograph::PLACE_TWO_POINTS);
  comparison->SetPhotographPoint2(150, 110);
  comparison->SetFlowPoint2(truePlace().inImage({ 150, 110 }).data());
  comparison->SetPhotographScale(1);
  comparison->SetPhotographRotation(90);
  expectSame("two points");
}

TEST(Photograph, AspectOfPixelsIsUndone)
{
  Place narrow = truePlace();
  narrow.aspect = 1.03;
  const Taken taken = take(jet().light, jet().grid, narrow, jet().undisturbed);
  auto comparison = compared(jet().bench, taken, truePlace());
  comparison->SetPixelAspect(1.03);
  comparison->Update();
  EXPECT_LT(errorsOfShift(comparison, 0).median, 0.05);
  comparison->SetPixelAspect(1);
  comparison->Update();
  EXPECT_GT(errorsOfShift(comparison, 0).median, 0.1);
}

TEST(Photograph, BrightAndDarkFieldsAreFound)
{
  for (const int cutoff : { vtkSchlierenFilter::BRIGHT_FIELD, vtkSchlierenFilter::DARK_FIELD })
  {
    auto bench = jetBench();
    bench->SetCutoff(cutoff);
    bench->Update();
    const double k = 0.6 * fieldValue(bench, "KScale");
    auto finer = jetBench(1.5);
    finer->SetCutoff(cutoff);
    finer->SetKMode(vtkSchlierenFilter::K_VALUE);
    finer->SetKScale(k);
    finer->SetSamplesPerPixel(4);
    finer->Update();
    const Taken taken = take(planeOf(finer, "Intensity"), Grid(finer->GetOutput()), truePlace(),
      cutoff == vtkSchlierenFilter::BRIGHT_FIELD ? 1 : 0);
    auto comparison = compared(bench, taken, truePlace());
    comparison->Update();
    EXPECT_NEAR(fieldValue(comparison, "PhotographK") / k, 1,
      cutoff == vtkSchlierenFilter::BRIGHT_FIELD ? 0.03 : 0.1);
  }
}

TEST(Photograph, GradedFilterIsFound)
{
  auto bench = jetBench();
  bench->SetCutoff(vtkSchlierenFilter::GRADED_FILTER);
  bench->Update();
  const double k = 0.7 * fieldValue(bench, "KScale");
  auto finer = jetBench(1.5);
  finer->SetCutoff(vtkSchlierenFilter::GRADED_FILTER);
  finer->SetKMode(vtkSchlierenFilter::K_VALUE);
  finer->SetKScale(k);
  finer->SetKnifeEdgeAngle(edgeAngle);
  finer->SetSamplesPerPixel(4);
  finer->Update();
  const Taken taken = take(planeOf(finer, "Intensity"), Grid(finer->GetOutput()), truePlace(),
    fieldValue(finer, "UndisturbedLevel"));
  auto comparison = compared(bench, taken, truePlace());
  comparison->Update();
  EXPECT_NEAR(fieldValue(comparison, "PhotographAngle"), edgeAngle, 0.5);
  EXPECT_NEAR(fieldValue(comparison, "PhotographK") / k, 1, 0.03);
}

TEST(Photograph, InfiniteFringesAreFound)
{
  const ReferenceBeam truth{ 0, 0, 0.3, 0.7 };
  const Interferograms of(truth);
  expectFringes(compared(of.bench, of.taken, truePlace()), truth);
}

TEST(Photograph, FiniteFringesAreFoundOnEitherSide)
{
  const ReferenceBeam truth{ 2 * halfHeight / 10, 215, 0.8, 0.6 };
  const Interferograms of(truth);
  expectFringes(compared(of.bench, of.taken, truePlace(), false), truth);

  // Those of the filter itself.
  of.finer->SetFringeSpacing(-10);
  of.finer->SetFringeAngle(35);
  of.finer->Update();
  const Taken taken =
    take(planeOf(of.finer, "Intensity"), Grid(of.finer->GetOutput()), truePlace(), 1);
  expectFringes(compared(of.bench, taken, truePlace(), false), { truth.spacing, 35, 0, 1 });
}

TEST(Photograph, FringesOfTheImageAreNotThoseOfThePhotograph)
{
  const ReferenceBeam truth{ halfHeight / 6, 120, 0.4, 0.6 };
  Interferograms of(truth);
  of.bench->SetFringeSpacing(-5);
  of.bench->SetFringeAngle(90);
  auto comparison = compared(of.bench, of.taken, truePlace());
  expectFringes(comparison, truth);
  comparison->SetFitCutoff(false);
  comparison->Update();
  EXPECT_EQ(fieldArray(comparison, "PhotographFringeContrast"), nullptr);
  EXPECT_LT(fieldValue(comparison, "PhotographCorrelation"), 0.6);
}

TEST(Photograph, SideOfTheReferenceBeamIsNotSeenWithoutFlow)
{
  const ReferenceBeam truth{ halfHeight / 6, 120, 0.4, 0.6 };
  Interferograms of(truth, 1e-4);
  auto comparison = compared(of.bench, of.taken, truePlace());
  comparison->Update();
  EXPECT_TRUE(has(report(comparison), "sign")) << report(comparison);
  EXPECT_NEAR(fieldValue(comparison, "PhotographFringeSpacing") / truth.spacing, 1, 0.01);
  EXPECT_NEAR(
    std::remainder(fieldValue(comparison, "PhotographFringeAngle") - truth.angle, 180), 0, 0.5);
  EXPECT_NEAR(fieldValue(comparison, "PhotographFringeContrast"), truth.contrast, 0.05);
}

TEST(Photograph, GreyPhotographHasNoFringes)
{
  const Interferograms of({ 0, 0, 0, 0 }); // of no contrast: striae, dust and an uneven lamp
  auto comparison = compared(of.bench, of.taken, truePlace());
  comparison->Update();
  EXPECT_TRUE(has(report(comparison), "No fringes are found")) << report(comparison);
  EXPECT_EQ(fieldArray(comparison, "PhotographFringeContrast"), nullptr);
  of.taken.withFlow->GetPointData()->GetScalars()->Fill(120);
  of.taken.withFlow->Modified();
  comparison->Update();
  EXPECT_TRUE(has(report(comparison), "no light in it")) << report(comparison);
  EXPECT_FALSE(has(report(comparison), "ringes")) << report(comparison);
  EXPECT_FALSE(isEmpty(comparison));
}

TEST(Photograph, ShadowgraphIsComparedAsItIs)
{
  auto bench = jetBench();
  bench->SetCutoff(vtkSchlierenFilter::SHADOWGRAPH);
  bench->SetScreenDistance(0.03);
  auto finer = jetBench(1.5);
  finer->SetCutoff(vtkSchlierenFilter::SHADOWGRAPH);
  finer->SetScreenDistance(0.03);
  finer->SetSamplesPerPixel(4);
  finer->Update();
  Film film;
  film.exposure = 0.4;
  const Taken taken =
    take(planeOf(finer, "Intensity"), Grid(finer->GetOutput()), truePlace(), 1, film);
  auto comparison = compared(bench, taken, truePlace(), true, film);
  comparison->Update();
  EXPECT_EQ(fieldArray(comparison, "PhotographK"), nullptr);
  EXPECT_EQ(fieldArray(comparison, "PhotographContrast"), nullptr);
  EXPECT_GT(fieldValue(comparison, "PhotographCorrelation"), 0.9);
}

TEST(Photograph, ViewsShowBothImages)
{
  const Taken taken = take(jet().light, jet().grid, truePlace(), jet().undisturbed);
  auto comparison = compared(jet().bench, taken, truePlace());
  comparison->SetFindFeatureShift(false);
  comparison->Update();
  EXPECT_EQ(arrayOf(comparison, "FeatureShift"), nullptr);
  const Plane seen = planeOf(comparison, "Photograph"), made = planeOf(comparison, "Simulated");
  using Self = vtkCompareWithPhotograph;
  // The photograph does not reach the corner, which shows the simulated image.
  const auto at = [&](int view, int column, int row, int channel)
  {
    comparison->SetComparison(view);
    comparison->Update();
    return planeOf(comparison, "Comparison", channel)(column, row) / 255.;
  };
  EXPECT_TRUE(std::isnan(seen(columns - 1, rows - 1)));
  comparison->SetSwipePosition(0.25);
  for (const int column : { 30, 65, 100, 165 })
  {
    const int row = 70;
    const double p = seen(column, row), m = made(column, row);
    EXPECT_NEAR(at(Self::SHOW_PHOTOGRAPH, column, row, 0), p, 0.003);
    EXPECT_NEAR(at(Self::SHOW_SIMULATED, column, row, 1), m, 0.003);
    EXPECT_NEAR(at(Self::SHOW_OVER, column, row, 2), 0.5 * (p + m), 0.003);
    EXPECT_NEAR(at(Self::SHOW_SWIPE, column, row, 0), column < 50 ? p : m, 0.003);
    const bool isPhotograph = (column / 25 + row / 25) % 2 == 0;
    EXPECT_NEAR(at(Self::SHOW_CHEQUERBOARD, column, row, 0), isPhotograph ? p : m, 0.003);
    EXPECT_NEAR(at(Self::SHOW_RED_CYAN, column, row, 0), p, 0.003);
    EXPECT_NEAR(at(Self::SHOW_RED_CYAN, column, row, 2), m, 0.003);
    EXPECT_NEAR(at(Self::SHOW_DIFFERENCE, column, row, 0), 0.5 + 0.5 * (p - m), 0.003);
  }
  EXPECT_NEAR(at(Self::SHOW_OVER, columns - 1, rows - 1, 0), made(columns - 1, rows - 1), 0.003);
  EXPECT_NEAR(at(Self::SHOW_PHOTOGRAPH, columns - 1, rows - 1, 0), 0.5, 0.003);
}

TEST(Photograph, SixteenBitsOfColourAreLuminance)
{
  Film film;
  film.bits = 16;
  const Taken grey = take(jet().light, jet().grid, truePlace(), jet().undisturbed, film);
  const auto inColour = [](vtkImageData* image)
  {
    auto coloured = vtkSmartPointer<vtkImageData>::New();
    coloured->CopyStructure(image);
    vtkNew<vtkUnsignedShortArray> array;
    array->SetNumberOfComponents(4);
    array->SetNumberOfTuples(image->GetNumberOfPoints());
    vtkDataArray* values = image->GetPointData()->GetScalars();
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      const double value = values->GetComponent(i, 0);
      array->SetTuple4(i, 0, value, 0, 65535); // green alone
    }
    coloured->GetPointData()->SetScalars(array);
    return coloured;
  };
  auto comparison = compared(jet().bench, grey, truePlace(), true, film);
  comparison->Update();
  const double k = fieldValue(comparison, "PhotographK");
  EXPECT_NEAR(k / jet().k, 1, 0.02);
  const Plane plain = planeOf(comparison, "Photograph");
  comparison->SetInputData(1, inColour(grey.withFlow));
  comparison->SetInputData(2, inColour(grey.withoutFlow));
  comparison->Update();
  const Plane green = planeOf(comparison, "Photograph");
  EXPECT_NEAR(green(100, 75), 0.7152 * plain(100, 75), 1e-4);
}

TEST(Photograph, MistakesAreOneMessage)
{
  const Taken taken = take(jet().light, jet().grid, truePlace(), jet().undisturbed);
  auto comparison = compared(jet().bench, taken, truePlace());
  comparison->SetFitCutoff(false);
  comparison->SetFindFeatureShift(false);
  using Self = vtkCompareWithPhotograph;
  expectOneMessage(
    comparison.Get(), [](Self* filter) { filter->SetPhotographPosition(100, 100); },
    { "does not overlap", "Placement" }, [](Self* filter) { givePlace(filter, truePlace()); });
  expectOneMessage(
    comparison.Get(),
    [](Self* filter)
    {
      filter->SetPlacement(Self::PLACE_TWO_POINTS);
      filter->SetPhotographPoint1(5, 5);
      filter->SetPhotographPoint2(5, 5);
    },
    { "at one place", "PhotographPoint1" }, [](Self* filter) { givePlace(filter, truePlace()); });
  expectOneMessage(
    comparison.Get(),
    [](Self* filter)
    {
      filter->SetPlacement(Self::PLACE_TWO_POINTS);
      filter->SetPhotographPoint1(std::nan(""), 5);
    },
    { "at one place" }, [](Self* filter) { givePlace(filter, truePlace()); });
  expectOneMessage(
    comparison.Get(), [](Self* filter) { filter->SetFitPlace(Self::FIT_BODY); },
    { "no body", "FitPlace" }, [](Self* filter) { filter->SetFitPlace(Self::FIT_OFF); });
  vtkNew<vtkImageData> other;
  other->SetDimensions(30, 20, 1);
  other->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  other->GetPointData()->GetScalars()->Fill(100);
  expectOneMessage(
    comparison.Get(), [&](Self* filter) { filter->SetInputData(2, other); },
    { "another number of pixels" },
    [&](Self* filter) { filter->SetInputData(2, taken.withoutFlow); });
  expectOneMessage(
    comparison.Get(), [&](Self* filter) { filter->SetInputData(0, other); },
    { "no point array Deflection", "Schlieren" },
    [&](Self* filter) { filter->SetInputConnection(0, jet().bench->GetOutputPort()); });
}
