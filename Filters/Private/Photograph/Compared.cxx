// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photograph/Compared.h"

#include "Photograph/Description.h"
#include "Photograph/PlaceFit.h"
#include "Photograph/Reading.h"
#include "PhotographSettings.h"

#include "vtkImageData.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>

namespace filters
{

namespace
{

using Settings = PhotographSettings;

constexpr double leastFull = 0.01;     // fraction of points with all light, from which k is known
constexpr double leastContrast = 0.02; // of a photograph that shows something
constexpr double leastSeen = 0.2; // of the loss: what fringes, or the side of a tilt, must explain
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

CameraFit startOf(const SimulatedLight& light, const Photograph& photograph,
  const Exposure& exposure, const PhotographSettings& settings)
{
  CameraFit fit;
  fit.light = light.start();
  fit.camera.exponent = 1 / settings.Gamma;
  fit.camera.black = photograph.black;
  std::vector<float> seen = knownValues(exposure.photograph, exposure.known);
  fit.camera.surface[0] = std::log(std::max(quantile(seen, 0.5) - fit.camera.black, 0.05));
  return fit;
}

Fitted fittedOf(const Photograph& photograph, const PhotographSettings& settings)
{
  return photograph.isBlackKnown ? (settings.FitCutoff ? Fitted::Light : Fitted::Brightness)
                                 : (settings.FitCutoff ? Fitted::All : Fitted::BrightnessAndBlack);
}

/// Returns the light that makes these values, in units of white.
Plane lightOf(Plane values, const Camera& camera)
{
  for (float& value : values.values)
  {
    value = static_cast<float>(std::pow(std::max(value - camera.black, 0.), 1 / camera.exponent));
  }
  return values;
}

/// Fits from all sides on which the cutoff may have been, and returns the best.
CameraFit firstFit(
  const SimulatedLight& light, const Exposure& exposure, const CameraFit& start, Fitted what)
{
  CameraFit best = start;
  best.cost = std::numeric_limits<double>::infinity();
  const bool isOther = what == Fitted::Light || what == Fitted::All; // than that of the image
  for (const auto& parameters : isOther
      ? light.starts(lightOf(exposure.photograph, start.camera),
          lightOf(exposure.withoutFlow, start.camera), exposure.known)
      : std::vector<SimulatedLight::Parameters>{ light.start() })
  {
    CameraFit one = start;
    one.light = parameters;
    one = fitCamera(light, exposure, one, what, Blur::Kept);
    if (one.cost < best.cost)
    {
      best = one;
    }
  }
  return fitCamera(light, exposure, best, what);
}

/// Returns the light that the camera has seen, relative to undisturbed light: what recorded() makes values of.
Plane seenLight(const SimulatedLight& light, const Exposure& exposure, const CameraFit& fit)
{
  Plane result = recorded(light, exposure, fit);
  const Plane model = blurred(light.light(fit.light), fit.camera.blur);
  for (std::size_t i = 0; i < result.size(); ++i)
  {
    const double black = fit.camera.black;
    const double made = std::max(result.values[i] - black, 1e-4);
    const double seen = std::max(exposure.photograph.values[i] - black, 0.);
    result.values[i] = exposure.known.values[i] > 0
      ? std::clamp(
          static_cast<float>(model.values[i] * std::pow(seen / made, 1 / fit.camera.exponent)), 0.f,
          4.f)
      : model.values[i];
  }
  return result;
}

/// Improves the place by the body's silhouette, or by the flow.
Place improved(Place place, const SimulatedLight& light, const Photograph& photograph,
  const Grid& image, const PhotographSettings& settings)
{
  if (settings.FitPlace == Settings::FIT_BODY)
  {
    const float least = *std::min_element(light.open().values.begin(), light.open().values.end());
    if (least > 0.5f)
    {
      throw std::runtime_error(
        "There is no body in the image whose silhouette could be found in the "
        "photograph. Set FitPlace to Off, and place the photograph by points.");
    }
    const CameraFit start =
      startOf(light, photograph, exposureOf(photograph, place, image, light.open()), settings);
    const Plane lit = lightOrNone(photograph.values, start.camera.black, start.camera.exponent);
    // A saturated pixel is in light; the mirror's edge is none of the body.
    return fittedPlace(place, FreePlace::RotationAndPosition, lit, photograph.used, photograph.grid,
      light.open(), image);
  }
  constexpr int rounds = 3;
  for (int round = 0; round < rounds && settings.FitPlace == Settings::FIT_FLOW; ++round)
  {
    const Exposure exposure = exposureOf(photograph, place, image, light.open());
    const CameraFit fit = firstFit(light, exposure, startOf(light, photograph, exposure, settings),
      fittedOf(photograph, settings));
    const Place moved =
      fittedPlace({ image.middle(), image.middle(), 1, 0, 1 }, FreePlace::ScaleToo,
        seenLight(light, exposure, fit), exposure.known, image, light.light(fit.light), image);
    place.position = moved.inImage(place.position);
    place.scale *= moved.scale;
    place.rotation += moved.rotation;
  }
  return place;
}

/// Finds the standard deviations of contrast, k (relative) and angle by fits to halves of the image: columns, rows and fields of a
/// chequerboard in turn. That of the Jacobian is 3 to 20 times too small, as striae are no white noise.
void measureUncertainty(Compared& result, const SimulatedLight& light, const Exposure& exposure,
  const CameraFit& fit, Fitted what)
{
  constexpr int fields = 8;
  const auto field = [](double place) { return static_cast<int>(place * fields); };
  const std::array<std::function<int(double, double)>, 3> ways{ [&](double x, double)
    { return field(x); },
    [&](double, double y) { return field(y); },
    [&](double x, double y) { return field(x) + field(y); } };
  double ofContrast = 0, ofK = 0, ofAngle = 0;
  for (const auto& way : ways)
  {
    SimulatedLight::Values half[2];
    for (int which = 0; which < 2; ++which)
    {
      const auto uses = [&](double x, double y) { return way(x, y) % 2 == which; };
      half[which] = light.values(fitCamera(light, exposure, fit, what, Blur::Fitted, uses).light);
    }
    // The mean of both halves differs from them by half of their distance.
    ofContrast += std::pow(std::log(half[1].contrast / half[0].contrast) / 2, 2);
    ofK += std::pow(std::log(half[1].k / half[0].k) / 2, 2);
    ofAngle += std::pow(std::remainder(half[1].angle - half[0].angle, 360) / 2, 2);
  }
  result.contrastUncertainty = std::sqrt(ofContrast / static_cast<double>(ways.size()));
  result.kUncertainty = std::sqrt(ofK / static_cast<double>(ways.size()));
  result.angleUncertainty = std::sqrt(ofAngle / static_cast<double>(ways.size()));
}

void measureDifference(Compared& result, const Plane& known)
{
  result.difference = Plane(known.columns, known.rows, unknown);
  double count = 0, squares = 0, p = 0, m = 0, pp = 0, pm = 0, mm = 0;
  for (std::size_t i = 0; i < known.size(); ++i)
  {
    if (!(known.values[i] > 0))
    {
      continue;
    }
    const double seen = result.photograph.values[i], made = result.simulated.values[i];
    result.difference.values[i] = static_cast<float>(seen - made);
    ++count;
    squares += (seen - made) * (seen - made);
    p += seen;
    m += made;
    pp += seen * seen;
    pm += seen * made;
    mm += made * made;
  }
  result.residual = std::sqrt(squares / std::max(count, 1.));
  const double spread = (count * pp - p * p) * (count * mm - m * m);
  result.correlation = spread > 0 ? (count * pm - p * m) / std::sqrt(spread) : 0;
}

void measureShift(Compared& result, const Grid& image)
{
  std::vector<float> lengths;
  for (std::size_t i = 0; i < result.shift->acrossRight.size(); ++i)
  {
    const double right = result.shift->acrossRight.values[i] * image.spacing[0];
    const double up = result.shift->acrossUp.values[i] * image.spacing[1];
    if (std::isfinite(right))
    {
      lengths.push_back(static_cast<float>(std::hypot(right, up)));
    }
  }
  result.shiftMedian = quantile(lengths, 0.5);
  result.shiftLarge = quantile(lengths, 0.95);
}

} // namespace

Compared compare(vtkImageData* input, vtkImageData* photographed, vtkImageData* withoutFlow,
  const PhotographSettings& settings, const WorkProgress& progress)
{
  const SimulatedLight light(input);
  const Grid image(input), whole(photographed);
  Place place = placeOf(image, whole, settings);
  const double finer = image.spacing[1] / (place.scale * whole.spacing[1]);
  const Photograph photograph = readPhotograph(
    photographed, withoutFlow, static_cast<int>(std::clamp(finer, 1., 100.)), settings);
  progress.reach(0.1);
  place = improved(place, light, photograph, image, settings);
  progress.reach(0.3);
  const Exposure exposure = exposureOf(photograph, place, image, light.open());
  if (std::none_of(exposure.photograph.values.begin(), exposure.photograph.values.end(),
        [](float value) { return std::isfinite(value); }))
  {
    throw std::runtime_error(
      "The photograph does not overlap the image. Set Placement to Fill Image, or correct the "
      "points or the position that place it; the image's coordinates are data units.");
  }

  Compared result;
  result.scale = place.scale;
  result.rotation = vtkMath::DegreesFromRadians(std::remainder(place.rotation, 2 * vtkMath::Pi()));
  result.middle = place.inImage(whole.middle());
  result.photograph = exposure.photograph;
  CameraFit fit = startOf(light, photograph, exposure, settings);
  std::vector<float> values = knownValues(exposure.photograph, exposure.known);
  const bool isFitted = quantile(values, 0.99) - quantile(values, 0.01) > leastContrast;
  if (isFitted)
  {
    const Fitted what = fittedOf(photograph, settings);
    fit = firstFit(light, exposure, fit, what);
    progress.reach(0.5);
    Exposure pulled = exposure;
    if (settings.FindFeatureShift)
    {
      const auto findShift = [&]
      {
        result.shift =
          shiftOfFeatures(recorded(light, exposure, fit), exposure.photograph, exposure.known);
      };
      constexpr int passes = 3; // one leaves k 3 % wrong with a jet that is 2 % too long, three 1 %
      for (int pass = 0; pass < passes; ++pass)
      {
        findShift();
        Exposure moved = pulledBack(exposure, *result.shift);
        const CameraFit fitted = fitCamera(light, moved, fit, what);
        progress.reach(0.5 + 0.1 * pass);
        if (!(fitted.cost < fit.cost)) // nothing has moved
        {
          break;
        }
        fit = fitted;
        pulled = std::move(moved);
      }
      findShift();
      measureShift(result, image);
    }
    progress.reach(0.9);
    if (settings.FitCutoff && light.hasFringes())
    {
      const auto fitFrom = [&](const SimulatedLight::Parameters& parameters, Fitted free)
      {
        CameraFit other = fit;
        other.light = parameters;
        return fitCamera(light, pulled, other, free);
      };
      const auto isWorse = [&](const CameraFit& other)
      { return fit.cost < (1 - leastSeen) * other.cost; };
      const CameraFit mirrored = fitFrom(SimulatedLight::mirrored(fit.light), what);
      result.isTiltKnown = isWorse(mirrored) || SimulatedLight::areSame(mirrored.light, fit.light);
      result.lacksFringes =
        !isWorse(fitFrom(SimulatedLight::withoutContrast(fit.light), Fitted::Brightness));
    }
    else if (settings.FitCutoff && !fit.light.empty())
    {
      measureUncertainty(result, light, pulled, fit, what);
    }
    const std::vector<bool> isFull = light.isFull(fit.light);
    double full = 0, all = 0;
    for (std::size_t i = 0; i < isFull.size(); ++i)
    {
      all += pulled.known.values[i] > 0 ? 1 : 0;
      full += pulled.known.values[i] > 0 && isFull[i] ? 1 : 0;
    }
    result.fullFraction = full / std::max(all, 1.);
    result.isKKnown = !light.hasOffset() || result.fullFraction >= leastFull;
  }
  result.cutoff = light.values(isFitted && settings.FitCutoff && !result.lacksFringes
      ? fit.light
      : SimulatedLight::Parameters());
  if (result.cutoff.fringeSpacing > 0)
  {
    // As recorded: blur takes from the contrast of even fringes, and a fit cannot separate both.
    const double turn =
      vtkMath::Pi() * fit.camera.blur * image.spacing[0] / result.cutoff.fringeSpacing;
    result.cutoff.fringeContrast *= std::exp(-2 * turn * turn);
  }
  result.black = fit.camera.black;
  result.simulated = recorded(light, exposure, fit);
  measureDifference(result, exposure.known);
  describe(result, image, settings, isFitted);
  progress.reach(1);
  return result;
}

} // namespace filters
