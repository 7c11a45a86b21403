// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Waves/EdgeWaves.h"

#include "Math/Units.h"
#include "Waves/WavePixels.h"

#include <algorithm>
#include <cmath>

namespace schlieren
{

namespace
{

using Value = ComplexField::Value;

/// What passes an edge of the light of one point of the source.
class PassingEdge
{
public:
  PassingEdge(const Edge& edge, double ofPoint, const FieldBeforeScreen& before)
    : isOther_(edge.isOther)
    , across_{ std::cos(edge.angle * radiansPerDegree), std::sin(edge.angle * radiansPerDegree) }
    , fromEdge_(ofPoint - edge.place)
    , wavelength_(before.space.wavelength)
    , carrier_{ before.space.carrier[0], before.space.carrier[1] }
  {
    const double length[2] = { static_cast<double>(before.grid.columns) * before.grid.spacing,
      static_cast<double>(before.grid.rows) * before.grid.spacing };
    width_ = wavelength_ * (std::abs(across_[0]) / length[0] + std::abs(across_[1]) / length[1]);
  }

  /// The fraction of a frequency's cell in the spectrum that passes.
  double at(double fx, double fy) const
  {
    const double passing = std::clamp(placeOf(fx, fy) / width_ + 0.5, 0., 1.);
    return isOther_ ? 1 - passing : passing;
  }
  /// Undisturbed light is a point: all of it passes, or nothing, or half where it is on the edge.
  double undisturbed() const
  {
    const double place = placeOf(0, 0), rounding = 1e-9 * width_;
    const double passing = place > rounding ? 1 : place < -rounding ? 0 : 0.5;
    return isOther_ ? 1 - passing : passing;
  }

private:
  double placeOf(double fx, double fy) const
  {
    return fromEdge_ +
      wavelength_ * (across_[0] * (fx + carrier_[0]) + across_[1] * (fy + carrier_[1]));
  }

  bool isOther_;
  double across_[2];
  double fromEdge_;
  double wavelength_;
  double carrier_[2];
  double width_; ///< of a frequency's cell, radians
};

} // namespace

std::vector<float> lightBehindEdge(const LightAtExit& light, const Screen& screen, const Edge& edge,
  const Monitor& monitor, WaveReport& report)
{
  // An edge spreads light as 1 / distance: half of the image beside it keeps that to 2e-3.
  const double around = 0.5 * light.spacing * screen.raysPerPixel *
    static_cast<double>(std::max(screen.width, screen.height));
  FieldBeforeScreen before = fieldBefore(light, screen, around, 2, report);
  if (!makeSpectrum(before.field, screen.threads, monitor))
  {
    return {};
  }
  const SpaceFilter space(before.space, before.field);
  WavePixels pixels(light, screen.raysPerPixel);
  ComplexField field(before.grid.columns, before.grid.rows);
  for (int number = 0; number < edge.points; ++number)
  {
    const double ofPoint = edge.source * ((number + 0.5) / edge.points - 0.5);
    const PassingEdge passing(edge, ofPoint, before);
    const double turn = ofPoint / before.space.wavelength;
    const double tilt[2] = { turn * std::cos(edge.angle * radiansPerDegree),
      turn * std::sin(edge.angle * radiansPerDegree) };
    const auto filter = [&](std::int64_t column, Value* alongY)
    {
      const double fx = frequencyOf(column, field.columns, before.grid.spacing);
      for (std::int64_t row = 0; row < field.rows; ++row)
      {
        const double fy = frequencyOf(row, field.rows, before.grid.spacing);
        const double passes = passing.at(fx, fy);
        alongY[row] *= passes == 0 ? 0 : passes * space.at(fx, fy, tilt);
      }
    };
    field.values = before.field.values;
    if (!makeField(field, filter, screen.threads, monitor))
    {
      return {};
    }
    pixels.add(field, before.grid, passing.undisturbed(), 1. / edge.points, screen.threads);
  }
  return pixels.image(screen.width, screen.height);
}

} // namespace schlieren
