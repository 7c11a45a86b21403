// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Media and scenes in which the tracer is compared with the reference tracer. Media are cubic polynomials, which cubic splines
// reproduce, or samples whose spline the reference has as well: so there is no error of the grid.
#pragma once

#include "Fields.h"
#include "ReferenceSpline.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace schlieren::reference
{

/// Full scale, and the largest difference.
struct Difference
{
  Real full = 0, worst = 0;

  void include(Real truth, Real found)
  {
    full = std::max(full, std::abs(truth));
    worst = std::isnan(found) ? Real(1e300L) : std::max(worst, std::abs(truth - found));
  }
  void include(Pair truth, const float* found)
  {
    include(truth.real(), Real(found[0]));
    include(truth.imag(), Real(found[1]));
  }
  double relative() const { return worst == 0 ? 0 : static_cast<double>(worst / full); }
};

constexpr double ambient = 1e-4;
constexpr double lengthScale = 0.1;

/// A medium as both tracers have it. The reference has the formula, or the spline through the same samples.
struct Medium
{
  SampledField<double> samples;
  Flow flow;

  Medium(const Grid& grid, const Refractivity& refractivity, Real largest,
    std::optional<Interpolation> interpolation = {})
    : samples(grid,
        [&](double x, double y, double z) {
          return static_cast<double>(refractivity({ x, y, z }).refractivity);
        })
    , flow(interpolation ? splineThrough(grid, samples.samples, *interpolation, largest)
                         : flowOf(grid, refractivity, largest))
  {
    flow.ambient = ambient;
    flow.lengthScale = lengthScale;
    samples.field.ambient = ambient;
    samples.field.lengthScale = lengthScale;
  }
};

/// N - ambient = peak times a polynomial of third degree that has all kinds of terms.
inline Medium polynomial(Real peak, const Grid& grid = cube(24, 1))
{
  return { grid,
    [peak](const Vec& a)
    {
      const auto [x, y, z] = a;
      const Real sum = 0.2L + 0.3L * x - 0.2L * y + 0.1L * z + 0.3L * x * y - 0.4L * x * x +
        0.2L * y * y * z - 0.25L * x * x * x + 0.2L * x * y * z;
      const Vec gradient{ 0.3L + 0.3L * y - 0.8L * x - 0.75L * x * x + 0.2L * y * z,
        -0.2L + 0.3L * x + 0.4L * y * z + 0.2L * x * z, 0.1L + 0.2L * y * y + 0.2L * x * y };
      return Value{ Real(ambient) + peak * sum, peak * gradient };
    },
    peak };
}

/// A Gaussian ball, of the reference as a formula or as a spline through the samples.
inline Medium ball(Real peak, std::optional<Interpolation> interpolation, std::int64_t points)
{
  return { cube(points, 1),
    [peak](const Vec& a)
    {
      const Vec r = a - Vec{ 0.1L, -0.05L, 0.05L };
      const Real N = peak * std::exp(-(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]) / 0.09L);
      return Value{ Real(ambient) + N, (-2 * N / 0.09L) * r };
    },
    peak, interpolation };
}

inline Scene exactScene(const Vector& direction = { 0, 0, -1 })
{
  Scene scene;
  scene.device = Device::Cpu;
  scene.view.viewDirection = direction;
  scene.view.width = 9;
  scene.view.height = 7;
  scene.view.focalPoint = Vector{ 0.05, -0.1, 0.08 };
  scene.view.parallelScale = 0.5;
  scene.samplesPerPixel = 1;
  scene.kScale = 1;
  scene.pathModel = PathModel::Refracted;
  scene.integrator = Integrator::Rk4;
  scene.interpolation = Interpolation::Cubic;
  scene.precision = Precision::Double;
  scene.stepSize = 0.1;
  return scene;
}

inline const Vector oblique{ -0.4, 0.3, -0.9 };

/// The largest difference between the tracer's image and the reference's, of all light.
inline double differenceOf(const Medium& medium, const Scene& scene)
{
  const Image image = schlieren::Bench().render(medium.samples.field, scene);
  const std::vector<Color> truth = render(medium.flow, scene);
  Difference difference;
  for (std::size_t i = 0; i < image.intensity.size(); ++i)
  {
    const Color& color = truth[i];
    difference.include(
      0.2126L * color[0] + 0.7152L * color[1] + 0.0722L * color[2], image.intensity[i]);
    for (std::size_t c = 0; c < 3 && !image.color.empty(); ++c)
    {
      difference.include(color[c], image.color[3 * i + c]);
    }
  }
  return static_cast<double>(difference.worst);
}

} // namespace schlieren::reference
