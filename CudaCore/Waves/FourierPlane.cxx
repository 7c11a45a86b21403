// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Waves/FourierPlane.h"

#include "Math/Trigonometry.h"
#include "Math/Units.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace schlieren
{

namespace
{

using Value = ComplexField::Value;

/// The fraction of a cell on the far side of a line. `distance`: of the cell's middle behind the line; `width`: of the cell
/// across it. A cell without a size that is on the line is half there.
double fractionBehind(double distance, double width)
{
  constexpr double rounding = 1e-12; // radians
  return width > 0         ? std::clamp(distance / width + 0.5, 0., 1.)
    : distance > rounding  ? 1
    : distance < -rounding ? 0
                           : 0.5;
}

/// The spectrum of the light of one point of the source behind a mask.
class PointSpectrum
{
public:
  PointSpectrum(const FieldBeforeScreen& before, const Mask& mask, const Angles& ofPoint)
    : before_(before)
    , mask_(mask)
    , ofPoint_(ofPoint)
  {
    const std::int64_t points[2] = { before.grid.columns, before.grid.rows };
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      cell_[axis] =
        before.space.wavelength / (static_cast<double>(points[axis]) * before.space.spacing);
      for (std::int64_t i = 0; i < points[axis]; ++i)
      {
        places_[axis].push_back(placeOf(axis, frequencyOf(i, points[axis], before.space.spacing)));
      }
    }
  }

  /// What the mask makes of undisturbed light.
  Value undisturbed() const
  {
    return mask_ ? mask_({ placeOf(0, 0), placeOf(1, 0) }, { 0, 0 }) : Value(1);
  }

  /// Multiplies the spectrum of light by what the mask and space make of it. The point's image is away from that of the middle
  /// by the distance times its angle. `fringes`: of points; of the means over their cells of light that has these.
  SpectrumFilter filter(const EvenPhase* fringes) const
  {
    const double perPoint[2] = { fringes ? fringes->perColumn : 0, fringes ? fringes->perRow : 0 };
    std::array<std::vector<Value>, 2> factors;
    const FreeSpace& space = before_.space;
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      const auto points = static_cast<std::int64_t>(places_[axis].size());
      for (std::int64_t i = 0; i < points; ++i)
      {
        const double frequency = frequencyOf(i, points, space.spacing);
        const double mean = fringes ? sincPi(frequency * space.spacing + perPoint[axis]) : 1;
        factors[axis].push_back(
          std::polar(mean, -2 * pi * space.distance * ofPoint_[axis] * frequency));
      }
    }
    return [this, factors = std::move(factors)](std::int64_t column, Value* alongY)
    {
      const auto x = static_cast<std::size_t>(column);
      for (std::size_t y = 0; y < factors[1].size(); ++y)
      {
        const Value passing = mask_ ? mask_({ places_[0][x], places_[1][y] }, cell_) : Value(1);
        alongY[y] *= passing == Value(0) ? passing : passing * factors[0][x] * factors[1][y];
      }
    };
  }

private:
  double placeOf(std::size_t axis, double frequency) const
  {
    return ofPoint_[axis] + before_.space.wavelength * (before_.space.carrier[axis] + frequency);
  }

  const FieldBeforeScreen& before_;
  const Mask& mask_;
  Angles ofPoint_, cell_;
  std::array<std::vector<double>, 2> places_; ///< of the spectrum's columns and rows
};

/// The phase by which a field's light is ahead of a reference beam in the plane in focus: of points, from the first ray's first
/// one. `image`: of the image's pixels.
EvenPhase fringesOf(const FieldBeforeScreen& before, const Screen& screen, const EvenPhase& image,
  const Angles& ofPoint, const WavePixels& pixels)
{
  const WaveGrid& grid = before.grid;
  const FreeSpace& space = before.space;
  const auto perRay = static_cast<double>(grid.pointsPerRay);
  const double perPixel = perRay * static_cast<double>(pixels.raysPerPixel);
  // Where the first point is: in rays from the first one, and in pixels from the image's first one.
  const double ray = 0.5 / perRay - 0.5;
  const double pixel = 0.5 / perPixel - 0.5 - static_cast<double>(pixels.leftOut);
  const double ofImage[2] = { image.perColumn, image.perRow };
  double perPoint[2];
  double first = before.path / screen.wavelength +
    SpaceFilter(space, before.field).turnsOfCarrier() + image.atFirst;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    perPoint[axis] = space.carrier[axis] * grid.spacing + ofImage[axis] / perPixel;
    first += space.carrier[axis] * (ray * perRay * grid.spacing - space.distance * ofPoint[axis]) +
      ofImage[axis] * pixel;
  }
  return { perPoint[0], perPoint[1], first };
}

} // namespace

Mask edgeMask(double degrees, double place)
{
  const double normal[2] = { std::cos(degrees * radiansPerDegree),
    std::sin(degrees * radiansPerDegree) };
  return [=](const Angles& at, const Angles& cell) -> Value
  {
    return fractionBehind(at[0] * normal[0] + at[1] * normal[1] - place,
      cell[0] * std::abs(normal[0]) + cell[1] * std::abs(normal[1]));
  };
}

Mask discMask(double diameter, std::complex<double> disc, std::complex<double> around)
{
  return [=](const Angles& at, const Angles& cell)
  {
    const double area = cell[0] * cell[1], fromAxis = std::hypot(at[0], at[1]);
    double inside = area == 0 ? 1 : 0;
    if (diameter > 0)
    {
      const double width = fromAxis == 0
        ? cell[0]
        : (cell[0] * std::abs(at[0]) + cell[1] * std::abs(at[1])) / fromAxis;
      inside = fractionBehind(0.5 * diameter - fromAxis, width);
      // Of a disc that is smaller than a cell.
      inside = area == 0 ? inside : std::min(inside, 0.25 * pi * diameter * diameter / area);
    }
    return around + inside * (disc - around);
  };
}

Mask filterMask(std::function<double(const Angles& place)> transmission)
{
  return [transmission = std::move(transmission)](const Angles& at, const Angles& cell) -> Value
  {
    constexpr double quarter = 0.25, cellsOfTip = 2;
    // Filters that are even around the axis have a tip there.
    if (std::abs(at[0]) >= cellsOfTip * cell[0] || std::abs(at[1]) >= cellsOfTip * cell[1])
    {
      return std::sqrt(transmission(at));
    }
    double sum = 0;
    for (const double u : { -quarter, quarter })
    {
      for (const double v : { -quarter, quarter })
      {
        sum += quarter * std::sqrt(transmission({ at[0] + u * cell[0], at[1] + v * cell[1] }));
      }
    }
    return sum;
  };
}

double undisturbedLight(const Imaging& imaging)
{
  double light = 0;
  for (const SourcePoint& point : imaging.points)
  {
    light += point.light * (imaging.mask ? std::norm(imaging.mask(point.place, { 0, 0 })) : 1);
  }
  return light;
}

std::vector<float> lightInFocus(const LightAtExit& light, const Screen& screen,
  const Imaging& imaging, const Monitor& monitor, WaveReport& report)
{
  // A mask's edge spreads light as 1 / distance: half of the image beside it keeps that to 2e-3.
  const double around = imaging.mask ? 0.5 * light.spacing * screen.raysPerPixel *
      static_cast<double>(std::max(screen.width, screen.height))
                                     : 0;
  FieldBeforeScreen before = fieldBefore(light, screen, around, 2, report);
  if (!makeSpectrum(before.field, filterOf(before.space, before.field), screen.threads, monitor))
  {
    return {};
  }
  WavePixels pixels(light, screen.raysPerPixel, pixelsAround(light, screen));
  const RowRange rows = pixels.rowsOf(before.grid);
  ComplexField field(before.grid.columns, before.grid.rows);
  for (const SourcePoint& point : imaging.points)
  {
    const PointSpectrum spectrum(before, imaging.mask, point.place);
    const auto make = [&](const EvenPhase* fringes) {
      return makeField(
        before.field, spectrum.filter(fringes), field, rows, screen.threads, monitor);
    };
    if (!make(nullptr))
    {
      return {};
    }
    const Value undisturbed = spectrum.undisturbed();
    constexpr double ofOneBeam = 0.25;
    const double part = imaging.reference ? ofOneBeam * point.light : point.light;
    pixels.add(field, before.grid, undisturbed, part, screen.threads);
    if (imaging.reference)
    {
      const EvenPhase fringes = fringesOf(before, screen, *imaging.reference, point.place, pixels);
      if (!make(&fringes))
      {
        return {};
      }
      pixels.addFringes(field, before.grid,
        undisturbed * sincPi(fringes.perColumn) * sincPi(fringes.perRow), fringes, 2 * part,
        screen.threads);
    }
  }
  return pixels.image(screen.width, screen.height);
}

} // namespace schlieren
