// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/ImagingOfScene.h"

#include "Bench/CutoffMaker.h"
#include "Math/Units.h"
#include "Optics/Cutoffs.h"
#include "Rays/RayStarts.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iomanip>
#include <memory>
#include <sstream>
#include <type_traits>
#include <variant>
#include <vector>

namespace schlieren
{

namespace
{

/// Points of an extended source, whose waves do not interfere. Behind a knife edge the error of the light is 2e-4 to 6e-3 (rms),
/// for sources as wide as 5 to 250 times the wavelength by the image's width, and falls as 1 by the number of points. Of a disc
/// with a filter it is 1e-3, with a reference beam out of focus 5e-3.
constexpr int pointsOfSource = 32;

/// Points across the image of a knife edge's source, which is 1/k wide: as the edge sees them, those of a disc have as much
/// light as it is long there. A source whose light is in step all over the image is one point, a laser's.
std::vector<SourcePoint> pointsAcross(const Scene& scene, double k, bool isLaser)
{
  const int count = isLaser ? 1 : pointsOfSource;
  std::vector<SourcePoint> points;
  double all = 0;
  for (int number = 0; number < count; ++number)
  {
    const double place = (number + 0.5) / count - 0.5;
    const double angle = scene.knifeEdgeAngle * radiansPerDegree;
    const bool isDisc = scene.source.shape == SourceShape::Disc;
    points.push_back({ { place / k * std::cos(angle), place / k * std::sin(angle) },
      isDisc ? std::sqrt(0.25 - place * place) : 1 });
    all += points.back().light;
  }
  for (SourcePoint& point : points)
  {
    point.light /= all;
  }
  return points;
}

std::vector<SourcePoint> pointsOf(const Scene& scene)
{
  const int count = scene.source.shape == SourceShape::Point ? 1 : pointsOfSource;
  std::vector<SourcePoint> points;
  for (int number = 0; number < count; ++number)
  {
    points.push_back(
      { sourcePoint(scene.source, scene.knifeEdgeAngle, number, scene.seed), 1. / count });
  }
  return points;
}

Mask plateMask(const Scene& scene, double wavelength)
{
  const PhasePlate& plate = scene.phasePlate;
  const std::complex<double> passing =
    std::polar(std::sqrt(plate.transmission), 2 * pi * plate.delay * scene.wavelength / wavelength);
  return discMask(plate.diameter, passing, 1);
}

/// What a cutoff lets pass of rays, as an amplitude.
Mask maskOf(const Scene& scene, double k)
{
  const auto maker = std::make_shared<CutoffMaker>();
  const Cutoffs cutoff = maker->cutoffOf(scene, k, { 1 });
  return filterMask(
    // The maker has the cutoff's table.
    [maker, cutoff](const Angles& place)
    {
      const RayAtFilm ray{ { place[0], place[1] }, 0, { 0, 0 } };
      return std::visit(
        [&ray](const auto& kind)
        {
          double light[std::decay_t<decltype(kind)>::channels];
          kind.shade(ray, light);
          return luminanceOf(light);
        },
        cutoff);
    });
}

/// The carrier of the reference beam, whose tilt is of paths.
EvenPhase carrierOf(const Scene& scene, double wavelength, double pixelSize)
{
  CutoffMaker maker;
  const Carrier carrier = std::get<Interferogram>(maker.cutoffOf(scene, 0, { pixelSize })).carrier;
  const double part = scene.wavelength / wavelength;
  return { part * carrier.perColumn, part * carrier.perRow, part * carrier.atOrigin };
}

} // namespace

Imaging imagingOf(
  const Scene& scene, double k, double wavelength, double pixelSize, double lengthScale)
{
  const double width = lengthScale * pixelSize * std::max(scene.view.width, scene.view.height);
  switch (scene.cutoff)
  {
    case Cutoff::KnifeEdge:
      return { edgeMask(scene.knifeEdgeAngle, scene.cutoffOffset / k),
        pointsAcross(scene, k, scene.wavelength * k > width) };
    case Cutoff::PhaseContrast:
      return { plateMask(scene, wavelength), pointsOf(scene) };
    case Cutoff::Interferogram:
      return { {}, pointsOf(scene), carrierOf(scene, wavelength, pixelSize) };
    case Cutoff::Shadowgraph:
    case Cutoff::BrightField:
    case Cutoff::DarkField:
    case Cutoff::GradedFilter:
    case Cutoff::ColorFilter:
    case Cutoff::Background:
    case Cutoff::NumericalSchlieren:
      break; // light depends on the deflection alone
  }
  return { maskOf(scene, k), pointsOf(scene) };
}

std::string noteOnRays(Cutoff cutoff, double width)
{
  constexpr double perMillimetre = 1e3;
  std::ostringstream note;
  note << std::setprecision(3);
  switch (cutoff)
  {
    case Cutoff::KnifeEdge:
    case Cutoff::GradedFilter:
      note << "rays suffice for features wider than " << perMillimetre * 2 * width
           << " mm in focus";
      break;
    case Cutoff::BrightField:
    case Cutoff::DarkField:
      note << "rays suffice where paths differ by several wavelengths across features wider than "
           << perMillimetre * 2 * width << " mm in focus";
      break;
    case Cutoff::PhaseContrast:
      note << "rays do not show phases";
      break;
    case Cutoff::Shadowgraph:
    case Cutoff::ColorFilter:
    case Cutoff::Interferogram:
    case Cutoff::Background:
    case Cutoff::NumericalSchlieren:
      break; // rays are right where paths and places alone count
  }
  return note.str();
}

} // namespace schlieren
