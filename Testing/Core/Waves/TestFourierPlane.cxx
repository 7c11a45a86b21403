// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Edges, filters and plates in the plane where undisturbed light is a point, in coherent light and in that of a slit; and
// reference beams.
#include "WaveBench.h"

#include <utility>

using namespace schlieren;
using namespace schlieren::waveforms;

namespace
{

constexpr double perWave = green / (2 * pi); ///< path of a radian

/// In focus on the plane that bends light.
Bench1d benchOf(double pixel, std::int64_t width, Imaging imaging)
{
  Bench1d bench{ pixel, width, 0 };
  bench.imaging = std::move(imaging);
  return bench;
}

/// Points of a slit across an edge along u.
std::vector<SourcePoint> slitOf(double width, int points, double degrees = 0)
{
  std::vector<SourcePoint> all;
  for (int number = 0; number < points; ++number)
  {
    const double place = width * ((number + 0.5) / points - 0.5);
    const double angle = degrees * radiansPerDegree;
    all.push_back({ { place * std::cos(angle), place * std::sin(angle) }, 1. / points });
  }
  return all;
}
Imaging edgeOf(double source, int points, double place = 0, double angle = 0)
{
  return { edgeMask(angle, place), slitOf(source, points, angle) };
}
Imaging plateOf(double diameter, Complex plate, Complex around = 1)
{
  return { discMask(diameter, plate, around) };
}

Ray straight(double) { return Ray{}; }

/// A grating of phases over all that is traced.
RayAt grating(double amplitude, double period)
{
  return [=](double x)
  {
    const double turn = 2 * pi / period, path = amplitude * perWave;
    return Ray{ path * std::cos(turn * x), -path * turn * std::sin(turn * x), 0 };
  };
}

/// The light of a grating of phases of which `passing` of each order passes: of order 0 as undisturbed light.
template <class Passing>
double lightOfOrders(double amplitude, double turns, const Passing& passing)
{
  Complex sum = 0;
  for (int order = -20; order <= 20; ++order)
  {
    const double bessel = std::cyl_bessel_j(static_cast<double>(std::abs(order)), amplitude);
    sum += std::pow(Complex(0, 1), std::abs(order)) * bessel * Complex(passing(order)) *
      std::polar(1., 2 * pi * order * turns);
  }
  return std::norm(sum);
}

/// The same as means over pixels of a period's `pixels`-th part.
template <class Passing>
Numbers lightOfOrders(const Numbers& x, double amplitude, double period, const Passing& passing)
{
  Numbers light;
  const double pixel = x[1] - x[0];
  for (const double middle : x)
  {
    light.push_back(
      integral([&](double place) { return lightOfOrders(amplitude, place / period, passing); },
        middle - 0.5 * pixel, middle + 0.5 * pixel, 4) /
      pixel);
  }
  return light;
}

/// The middle third.
Numbers middleOf(const Numbers& values)
{
  const auto third = static_cast<std::ptrdiff_t>(values.size() / 3);
  return { values.begin() + third, values.end() - third };
}

double meanOf(const Numbers& values)
{
  double sum = 0;
  for (const double value : values)
  {
    sum += value / static_cast<double>(values.size());
  }
  return sum;
}

} // namespace

TEST(FourierPlane, UndisturbedLightIsHalfOfASlitAndAQuarterOfALaser)
{
  for (const auto& [points, light] : { std::pair(1, 0.25), std::pair(32, 0.5) })
  {
    const Imaging imaging = edgeOf(1e-3, points);
    EXPECT_NEAR(undisturbedLight(imaging), light, 1e-12);
    for (const double value : benchOf(1e-4, 32, imaging).image(straight))
    {
      EXPECT_NEAR(value, light, 1e-6);
    }
  }
  // A quarter of the source's image is behind the edge.
  EXPECT_NEAR(benchOf(1e-4, 32, edgeOf(1e-3, 40, 0.25e-3)).image(straight)[16], 0.25, 1e-6);
  EXPECT_NEAR(benchOf(1e-4, 32, edgeOf(1e-3, 40, -0.25e-3, 180)).image(straight)[16], 0.75, 1e-6);
  EXPECT_NEAR(benchOf(1e-4, 32, plateOf(0, 0.4)).image(straight)[16], 0.16, 1e-6);
  EXPECT_NEAR(benchOf(1e-4, 32, plateOf(1e-4, 0.4)).image(straight)[16], 0.16, 1e-6);
  EXPECT_NEAR(benchOf(1e-4, 32, {}).image(straight)[16], 1, 1e-12);
}

TEST(FourierPlane, LaserSeesHilbertsTransformOfAWeakPhase)
{
  const double amplitude = 1e-3, width = 5e-4;
  const Bench1d bench = benchOf(2 * width / 50, 500, edgeOf(0, 1)); // 20 widths
  const Numbers seen = bench.image(column(amplitude * perWave, width));
  Numbers exact, middle;
  const Numbers x = bench.pixels();
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    if (std::abs(x[i]) < 3 * width)
    {
      exact.push_back(0.25 * (1 - 4 * amplitude / std::sqrt(pi) * dawson(x[i] / width)));
      middle.push_back(seen[i]);
    }
  }
  EXPECT_LT(rms(middle, exact), 5e-3 * 0.5 * amplitude);
}

TEST(FourierPlane, SlitSeesSlopesOfFeaturesThatAreNotTooFine)
{
  // Of a component of frequency f the light is -min(f, s / 2) / s of its phase, s the slit in frequencies.
  const double amplitude = 0.01, period = 8e-4;
  for (const auto& [orders, response] :
    { std::pair(0.5, 0.5), std::pair(2., 0.5), std::pair(4., 0.25), std::pair(16., 0.0625) })
  {
    const Bench1d bench = benchOf(period / 40, 400, edgeOf(orders * green / period, 64));
    const Numbers x = bench.pixels(), seen = bench.image(grating(amplitude, period));
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      sum += 2 * seen[i] * std::sin(2 * pi * x[i] / period) / static_cast<double>(x.size());
    }
    EXPECT_NEAR(sum / amplitude, -response, 0.02) << orders;
  }
}

TEST(FourierPlane, DarkFieldShowsTheSquareOfAWeakPhase)
{
  const double width = 5e-4, amplitude = 0.1;
  const Bench1d bench = benchOf(width / 12, 120, plateOf(0, 0));
  const Numbers seen = bench.image(column(amplitude * perWave, width));
  Numbers exact;
  for (const double x : bench.pixels())
  {
    exact.push_back(
      std::pow(2 * std::sin(0.5 * amplitude * std::exp(-x * x / (width * width))), 2));
  }
  EXPECT_LT(rms(seen, exact), 1e-3 * amplitude * amplitude);
}

TEST(FourierPlane, StopsAndAperturesPassOrdersOfAGrating)
{
  const double amplitude = 1.5, period = 8e-4, order = green / period;
  struct Case
  {
    Mask mask;
    std::function<Complex(int)> passing;
  };
  const Case cases[] = {
    { discMask(order, 0, 1), [](int n) { return n == 0 ? 0. : 1.; } },
    { discMask(3 * order, 0, 1), [](int n) { return std::abs(n) < 2 ? 0. : 1.; } },
    { discMask(3 * order, 1, 0), [](int n) { return std::abs(n) < 2 ? 1. : 0.; } },
    { discMask(order, Complex(0, 1), 1), [](int n) { return n == 0 ? Complex(0, 1) : 1.; } },
    { discMask(3 * order, 1, Complex(0, 0.5)),
      [](int n) { return std::abs(n) < 2 ? 1 : Complex(0, 0.5); } },
    { edgeMask(0, 0.5 * order), [](int n) { return n > 0 ? 1. : 0.; } },
    // A slit.
    { filterMask(
        [=](const Angles& at) { return at[0] > -0.5 * order && at[0] < 2.5 * order ? 1. : 0.; }),
      [](int n) { return n >= 0 && n <= 2 ? 1. : 0.; } },
  };
  int number = 0;
  for (const Case& each : cases)
  {
    Bench1d bench = benchOf(period / 16, 144, { each.mask });
    bench.height = bench.width;
    bench.leastMargin = 240; // light falls to undisturbed light in half of it
    const Numbers seen = middleOf(bench.image(grating(amplitude, period)));
    const Numbers exact = lightOfOrders(middleOf(bench.pixels()), amplitude, period, each.passing);
    EXPECT_LT(rms(seen, exact), 4e-3) << number;
    EXPECT_NEAR(meanOf(seen), meanOf(exact), 1e-3) << number; // squares of Bessel's functions
    ++number;
  }
}

TEST(FourierPlane, PointOfASourceHasItsOwnPlaceInTheMask)
{
  // The middle of the first order's light is where the disc is for the point.
  const double amplitude = 1.5, period = 8e-4, order = green / period;
  Imaging imaging{ discMask(order, 0, 1), { { { -order, 0 }, 0.25 }, { { order, 0 }, 0.75 } } };
  Bench1d bench = benchOf(period / 16, 144, imaging);
  bench.height = bench.width;
  bench.leastMargin = 240; // light falls to undisturbed light in half of it
  const Numbers seen = middleOf(bench.image(grating(amplitude, period)));
  const Numbers x = middleOf(bench.pixels());
  Numbers exact(x.size());
  for (const auto& [blocked, light] : { std::pair(1, 0.25), std::pair(-1, 0.75) })
  {
    const Numbers ofPoint =
      lightOfOrders(x, amplitude, period, [n = blocked](int each) { return each == n ? 0. : 1.; });
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      exact[i] += light * ofPoint[i];
    }
  }
  EXPECT_LT(rms(seen, exact), 4e-3);
}

TEST(FourierPlane, PointOfASourceMovesTheImageOutOfFocus)
{
  const double size = 1e-3, path = 10 * perWave, angle = 2e-3, distance = 0.1;
  Bench1d middle = benchOf(5e-5, 100, {});
  middle.distance = distance;
  Bench1d beside = middle;
  beside.imaging->points = { { { angle, 0 }, 1 } };
  const Numbers still = middle.image(column(path, size)), moved = beside.image(column(path, size));
  const std::size_t shift = 4; // pixels
  for (std::size_t i = shift; i < still.size(); ++i)
  {
    EXPECT_NEAR(moved[i], still[i - shift], 2e-3);
  }
  EXPECT_GT(rms(still, moved), 0.02);
}

namespace
{

/// Means over pixels of the light of a beam and of one that is 1.
Numbers lightOfBeams(const Bench1d& bench, const std::function<Complex(double x)>& beam)
{
  Numbers light;
  for (const double x : bench.pixels())
  {
    light.push_back(integral([&](double place) { return 0.25 * std::norm(beam(place) + 1.); },
                      x - 0.5 * bench.pixel, x + 0.5 * bench.pixel, 64) /
      bench.pixel);
  }
  return light;
}

/// A reference beam whose fringes are `spacing` pixels apart, or none where that is less than 0.
Bench1d interferometer(double pixel, std::int64_t width, double spacing)
{
  EvenPhase carrier;
  if (spacing > 0)
  {
    carrier = { 1 / spacing, 0, -0.5 * static_cast<double>(width - 1) / spacing };
  }
  return benchOf(pixel, width, { {}, { {} }, carrier });
}

} // namespace

TEST(ReferenceBeam, OfATiltedWaveHasStraightFringes)
{
  for (const double spacing : { 3.7, 20. })
  {
    const Bench1d bench = interferometer(2e-5, 60, spacing);
    const auto turns = [&](double x) { return x / (spacing * bench.pixel); };
    EXPECT_LT(rms(bench.image(straight),
                lightOfBeams(bench, [&](double x) { return std::polar(1., 2 * pi * turns(x)); })),
      1e-6);
    // All light is tilted, by a wedge, with a path and out of focus.
    const double tilt = 3e-3, path = 0.3 * green, distance = 0.01;
    Bench1d tilted = bench;
    tilted.distance = distance;
    tilted.largestDeflection = tilt;
    const Numbers seen = tilted.image([&](double x) { return Ray{ path + tilt * x, tilt, 0 }; });
    const double behind = path + distance * (std::sqrt(1 - tilt * tilt) - 1);
    const Numbers exact = lightOfBeams(tilted,
      [&](double x) { return std::polar(1., 2 * pi * (turns(x) + (tilt * x + behind) / green)); });
    EXPECT_LT(rms(seen, exact), 1e-5) << spacing;
  }
}

TEST(ReferenceBeam, HasAReferenceBeamBehindABody)
{
  const Bench1d bench = interferometer(2e-5, 100, -1);
  const Numbers seen = bench.image([](double x) { return Ray{ 0, 0, 0, std::abs(x) < 3e-4 }; });
  EXPECT_NEAR(seen[50], 0.25, 1e-5);
  EXPECT_NEAR(seen[5], 1, 1e-5);
}
