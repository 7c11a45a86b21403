// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceTracer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>

namespace schlieren::reference
{

namespace
{

constexpr std::size_t axes[] = { 0, 1, 2 };
const Real pi = std::acos(Real(-1));

Real dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Real length(const Vec& a) { return std::sqrt(dot(a, a)); }
Vec unit(const Vec& a) { return (1 / length(a)) * a; }
Vec vec(const Vector& a) { return { a[0], a[1], a[2] }; }
Vec cross(const Vec& a, const Vec& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}
Real limited(Real x) { return std::clamp(x, Real(0), Real(1)); }
Real fraction(Real x) { return x - std::floor(x); }
Pair turned(Real degrees) { return std::polar(Real(1), degrees * pi / 180); }
Real along(Pair a, Real degrees) { return (a * std::conj(turned(degrees))).real(); }

// ---- The grid

Real lastOf(const Grid& grid, std::size_t axis) { return Real(grid.dimensions[axis] - 1); }

/// From a point to the next one along an axis.
Vec stepOf(const Grid& grid, std::size_t axis)
{
  const Vec axisInData{ grid.direction[axis], grid.direction[3 + axis], grid.direction[6 + axis] };
  return Real(grid.spacing[axis]) * axisInData;
}

/// By how much index coordinates change along a vector.
Vec inIndex(const Grid& grid, const Vec& a)
{
  Vec found;
  for (const std::size_t axis : axes)
  {
    const Vec step = stepOf(grid, axis);
    found[axis] = dot(a, step) / dot(step, step);
  }
  return found;
}

Vec indexOf(const Grid& grid, const Vec& place) { return inIndex(grid, place - vec(grid.origin)); }

Vec centreOf(const Grid& grid)
{
  Vec centre = vec(grid.origin);
  for (const std::size_t axis : axes)
  {
    centre = centre + (lastOf(grid, axis) / 2) * stepOf(grid, axis);
  }
  return centre;
}

/// Half of the box's extent along a direction.
Real halfExtent(const Grid& grid, const Vec& direction)
{
  Real sum = 0;
  for (const std::size_t axis : axes)
  {
    sum += std::abs(dot(stepOf(grid, axis), direction)) * lastOf(grid, axis) / 2;
  }
  return sum;
}

// ---- Splines

struct Weights
{
  std::array<Real, 4> value, slope;
};

/// Of coefficients -1 ... 2 from a point: the B-spline at t from there. Linear and Cubic: for t from 0 to 1; Quadratic: from -1/2
/// to 1/2.
Weights weightsAt(Interpolation interpolation, Real t)
{
  const Real s = 1 - t, a = t - 0.5L, b = t + 0.5L;
  switch (interpolation)
  {
    case Interpolation::Linear:
      return { { 0, s, t, 0 }, { 0, -1, 1, 0 } };
    case Interpolation::Quadratic:
      return { { a * a / 2, 0.75L - t * t, b * b / 2, 0 }, { a, -2 * t, b, 0 } };
    case Interpolation::Cubic:
      return { { s * s * s / 6, 2 / 3.0L - t * t * (2 - t) / 2, 2 / 3.0L - s * s * (2 - s) / 2,
                 t * t * t / 6 },
        { -s * s / 2, t * (3 * t - 4) / 2, -s * (3 * s - 4) / 2, t * t / 2 } };
    case Interpolation::Central:
      break;
  }
  throw std::invalid_argument("no spline");
}

/// Replaces n samples of a line by the n + 2 coefficients of the spline through them: Gauss and Seidel's iteration, relaxed at
/// the ends.
void solve(std::vector<Real>& line, Interpolation interpolation)
{
  const std::array<Real, 4> w = weightsAt(interpolation, 0).value;
  const auto beyond = [&](Real a, Real b, Real c, Real d)
  {
    return interpolation == Interpolation::Linear ? 2 * a - b
      : interpolation == Interpolation::Quadratic ? 3 * a - 3 * b + c
                                                  : 4 * a - 6 * b + 4 * c - d;
  };
  const std::size_t n = line.size();
  std::vector<Real> c(n + 2);
  for (int sweep = 0; sweep < 80; ++sweep)
  {
    for (std::size_t i = 1; i <= n; ++i)
    {
      c[i] = (line[i - 1] - w[0] * c[i - 1] - w[2] * c[i + 1]) / w[1];
    }
    c[0] = (c[0] + beyond(c[1], c[2], c[3], c[4])) / 2;
    c[n + 1] = (c[n + 1] + beyond(c[n], c[n - 1], c[n - 2], c[n - 3])) / 2;
  }
  line = c;
}

/// Coefficients with one more at both ends of each axis, x fastest.
struct Spline
{
  Grid grid;
  Interpolation interpolation;
  std::array<std::size_t, 3> size;
  std::vector<Real> coefficients;

  void solveAlong(std::size_t axis)
  {
    const std::size_t n = size[axis],
                      stride = axis == 0 ? 1
      : axis == 1                        ? size[0]
                                         : size[0] * size[1];
    std::vector<Real> found(coefficients.size() / n * (n + 2)), line;
    for (std::size_t lineOf = 0; lineOf < coefficients.size() / n; ++lineOf)
    {
      const std::size_t inner = lineOf % stride, outer = lineOf / stride;
      line.resize(n);
      for (std::size_t i = 0; i < n; ++i)
      {
        line[i] = coefficients[(outer * n + i) * stride + inner];
      }
      solve(line, interpolation);
      for (std::size_t i = 0; i < n + 2; ++i)
      {
        found[(outer * (n + 2) + i) * stride + inner] = line[i];
      }
    }
    coefficients = found;
    size[axis] = n + 2;
  }

  /// The polynomial that belongs to a point.
  Value valueAt(const std::array<std::size_t, 3>& point, const Vec& place) const
  {
    const Vec index = indexOf(grid, place);
    std::array<Weights, 3> w;
    for (const std::size_t axis : axes)
    {
      w[axis] = weightsAt(interpolation, index[axis] - Real(point[axis]));
    }
    Value sum;
    const std::size_t points = interpolation == Interpolation::Cubic ? 4 : 3;
    for (std::size_t k = 0; k < points; ++k)
    {
      for (std::size_t j = 0; j < points; ++j)
      {
        const Real* row =
          &coefficients[point[0] + size[0] * (point[1] + j + size[1] * (point[2] + k))];
        for (std::size_t i = 0; i < points; ++i)
        {
          const Real x = w[0].value[i], y = w[1].value[j], z = w[2].value[k];
          sum.refractivity += row[i] * x * y * z;
          sum.gradient = sum.gradient +
            row[i] * Vec{ w[0].slope[i] * y * z, x * w[1].slope[j] * z, x * y * w[2].slope[k] };
        }
      }
    }
    Vec gradient{};
    for (const std::size_t axis : axes)
    {
      const Vec step = stepOf(grid, axis);
      gradient = gradient + (sum.gradient[axis] / dot(step, step)) * step;
    }
    return { sum.refractivity, gradient };
  }
};

// ---- The equation of rays

using Numbers = std::array<Real, 7>; ///< position, momentum, path

Vec placeOf(const Numbers& y) { return { y[0], y[1], y[2] }; }
Vec momentumOf(const Numbers& y) { return { y[3], y[4], y[5] }; }

Numbers slopeOf(const Refractivity& refractivity, const Numbers& y)
{
  const auto [N, gradient] = refractivity(placeOf(y));
  const Vec t = (1 / (1 + N)) * momentumOf(y);
  return { t[0], t[1], t[2], gradient[0], gradient[1], gradient[2], 1 + N };
}

struct Step
{
  Numbers end;
  Real error; ///< of any of the numbers
  int parts;
};

/// Extrapolates the explicit midpoint rule with 2, 4, 6 ... parts to parts of no length (Gragg 1965; Hairer, Norsett & Wanner
/// 1993, section II.9), until the error is small enough or 16 parts do not do.
Step extrapolated(const Refractivity& refractivity, const Numbers& start, Real step, Real tolerance)
{
  Step found{ start, std::abs(step), 0 };
  std::vector<Numbers> coarser;
  for (int half = 1; half <= 8 && found.error > tolerance; ++half)
  {
    const Real h = step / (2 * half);
    Numbers before = start, here = start + h * slopeOf(refractivity, start);
    for (int part = 1; part < 2 * half; ++part)
    {
      std::swap(before, here);
      here = here + 2 * h * slopeOf(refractivity, before);
    }
    std::vector<Numbers> finer{ here };
    for (int times = 1; times < half; ++times)
    {
      const Real ratio = Real(half) / Real(half - times);
      const Numbers& last = finer.back();
      finer.push_back(last + (1 / (ratio * ratio - 1)) * (last - coarser[finer.size() - 1]));
    }
    if (half > 1)
    {
      const Numbers error = finer.back() - finer[finer.size() - 2];
      const auto [least, most] = std::minmax_element(error.begin(), error.end());
      found.error = std::max(*most, -*least);
    }
    found.end = finer.back();
    found.parts = 2 * half;
    coarser = finer;
  }
  return found;
}

/// How far beyond the side of a piece a ray has gone, along itself; less than 0 before it.
Real beyond(const Grid& grid, const Piece& piece, const Numbers& y)
{
  const Vec index = indexOf(grid, placeOf(y)), speed = inIndex(grid, unit(momentumOf(y)));
  Real most = -std::numeric_limits<Real>::infinity();
  for (const std::size_t axis : axes)
  {
    const Real side = speed[axis] > 0 ? piece.high[axis] : piece.low[axis];
    most = speed[axis] == 0 ? most : std::max(most, (index[axis] - side) / speed[axis]);
  }
  return most;
}

} // namespace

Flow flowOf(const Grid& grid, const Refractivity& refractivity, Real largest)
{
  const Piece all{ {}, { lastOf(grid, 0), lastOf(grid, 1), lastOf(grid, 2) }, refractivity };
  return { grid, [all](const Vec&) { return all; }, largest };
}

Flow splineThrough(
  const Grid& grid, const std::vector<double>& samples, Interpolation interpolation, Real largest)
{
  const auto spline =
    std::make_shared<Spline>(Spline{ grid, interpolation, {}, { samples.begin(), samples.end() } });
  std::copy(grid.dimensions.begin(), grid.dimensions.end(), spline->size.begin());
  std::for_each(
    std::begin(axes), std::end(axes), [&](std::size_t axis) { spline->solveAlong(axis); });
  const auto pieceAt = [=](const Vec& index)
  {
    // Between points; of a quadratic spline around a point.
    const Real half = interpolation == Interpolation::Quadratic ? 0.5L : 0;
    Piece piece;
    std::array<std::size_t, 3> point;
    for (const std::size_t axis : axes)
    {
      const Real last = lastOf(grid, axis);
      const Real low = std::clamp(std::floor(index[axis] + half), Real(0), last - 1 + 2 * half);
      point[axis] = static_cast<std::size_t>(low);
      piece.low[axis] = std::max(low - half, Real(0));
      piece.high[axis] = std::min(low + 1 - half, last);
    }
    piece.valueAt = [=](const Vec& place) { return spline->valueAt(point, place); };
    return piece;
  };
  return { grid, pieceAt, largest };
}

RayState follow(const Flow& flow, const RayState& start)
{
  const Grid& grid = flow.grid;
  const Real size = 2 * halfExtent(grid, unit({ 1, 1, 1 }));
  // Of a step; rounding is 1e-19.
  const Real tolerance = std::max(1e-13L * flow.largest, 1e-17L) * size;
  const auto [x, p, path] = start;
  Numbers y{ x[0], x[1], x[2], p[0], p[1], p[2], path };
  const Real longest = size / 16; // no step misses what is between the places where it looks
  Real step = longest;
  while (true)
  {
    const Vec ahead = indexOf(grid, placeOf(y) + 1e-10L * size * unit(momentumOf(y)));
    for (const std::size_t axis : axes)
    {
      if (!(ahead[axis] >= 0 && ahead[axis] <= lastOf(grid, axis)))
      {
        return { placeOf(y), momentumOf(y), y[6] };
      }
    }
    const Piece piece = flow.pieceAt(ahead);
    for (Real rest = -beyond(grid, piece, y); rest > 0;)
    {
      Real tried = std::min(step, rest);
      Step next = extrapolated(piece.valueAt, y, tried, tolerance);
      if (next.error > tolerance)
      {
        step = tried / 2;
        continue;
      }
      step = next.parts < 12 ? std::min(std::max(step, 2 * tried), longest) : step;
      Real past = beyond(grid, piece, next.end);
      // To where the bent ray meets the side, by Newton's method.
      const bool isLast = past > -0.01L * tried;
      for (int times = 0; isLast && times < 20 && std::abs(past) > 1e-16L * size; ++times)
      {
        tried -= past;
        next = extrapolated(piece.valueAt, y, tried, tolerance);
        past = beyond(grid, piece, next.end);
      }
      y = next.end;
      rest = isLast ? 0 : -past;
    }
  }
}

namespace
{

// ---- Light of a ray

/// What a ray has. Places are in data units of the image, from its middle.
struct Ray
{
  Pair deflection, displacement;
  Real path = 0;       ///< optical path difference where it leaves the grid, metres
  Real pathOnFilm = 0; ///< where it meets the film, metres
  Pair shift;          ///< on the film, data units there
  Pair place;          ///< on the film
};

Real linearOf(Real srgb)
{
  return srgb <= 0.04045L ? srgb / 12.92L : std::pow((srgb + 0.055L) / 1.055L, 2.4L);
}
Real luminance(const Color& color) { return dot(color, { 0.2126L, 0.7152L, 0.0722L }); }

/// Of an image from -1 to 1 both ways: linear between the centres of its pixels.
Color colorIn(const RgbImage& image, Pair place)
{
  const auto between = [](Real x, int size)
  { return std::clamp((x + 1) / 2 * size - 0.5L, Real(0), Real(size - 1)); };
  const Pair at{ between(place.real(), image.width), between(place.imag(), image.height) };
  Color color{};
  for (std::size_t byte = 0; byte < image.rgb.size(); ++byte)
  {
    const int pixel = static_cast<int>(byte / 3);
    const Real right = std::abs(at.real() - pixel % image.width),
               up = std::abs(at.imag() - pixel / image.width);
    color[byte % 3] +=
      std::max(1 - right, Real(0)) * std::max(1 - up, Real(0)) * linearOf(image.rgb[byte] / 255.0L);
  }
  return color;
}

/// Hue by the direction, saturation by the size, 1 as value, taken as sRGB (Brownlee et al. 2011, eq. 17).
Color wheelAt(Pair fromAxis)
{
  Color color;
  for (const std::size_t c : axes) // red at 0, green at 120, blue at 240 degrees
  {
    const Real sixths = std::abs(std::arg(fromAxis * turned(-120 * Real(c)))) * 3 / pi;
    color[c] = linearOf(1 - std::min(Real(1), std::abs(fromAxis)) * (1 - limited(2 - sixths)));
  }
  return color;
}

/// Two beams of all wavelengths from 380 to 780 nm, as the CIE's standard observer sees them (fit of Wyman, Sloan & Shirley
/// 2013), where light that has not been divided is white. `turns`: of the carrier at the scene's wavelength.
Color whiteFringes(const Scene& scene, Real path, Real turns)
{
  constexpr Real lobes[7][5] = { { 0, 1.056L, 599.8L, 0.0264L, 0.0323L },
    { 0, 0.362L, 442.0L, 0.0624L, 0.0374L }, { 0, -0.065L, 501.1L, 0.0490L, 0.0382L },
    { 1, 0.821L, 568.8L, 0.0213L, 0.0247L }, { 1, 0.286L, 530.9L, 0.0613L, 0.0322L },
    { 2, 1.217L, 437.0L, 0.0845L, 0.0278L }, { 2, 0.681L, 459.0L, 0.0385L, 0.0725L } };
  Color sum{}, all{};
  for (Real nm = 380.25L; nm < 780; nm += 0.5L)
  {
    const Real dispersion =
      scene.fringes.dispersion ? scene.fringes.dispersion(double(nm * 1e-9L)) : 1;
    const Real phase = 2 * pi * (dispersion * path + turns * Real(scene.wavelength)) / (nm * 1e-9L);
    for (const auto& [xyz, height, centre, below, above] : lobes)
    {
      const Real x = (nm - centre) * (nm < centre ? below : above);
      const Real seen = height * std::exp(-x * x / 2);
      all[std::size_t(xyz)] += seen;
      sum[std::size_t(xyz)] += seen * (1 + std::cos(phase)) / 2;
    }
  }
  // Bradford's adaptation from E to D65, then XYZ to linear sRGB.
  constexpr Vec adapt[] = { { 0.9531874L, -0.0265906L, 0.0238731L },
    { -0.0382467L, 1.0288406L, 0.0094060L }, { 0.0026068L, -0.0030332L, 1.0892565L } };
  constexpr Vec toRgb[] = { { 3.2404542L, -1.5371385L, -0.4985314L },
    { -0.9692660L, 1.8760108L, 0.0415560L }, { 0.0556434L, -0.2040259L, 1.0572252L } };
  const Vec e{ sum[0] / all[0], sum[1] / all[1], sum[2] / all[2] };
  const Vec d65{ dot(adapt[0], e), dot(adapt[1], e), dot(adapt[2], e) };
  return { limited(dot(toRgb[0], d65)), limited(dot(toRgb[1], d65)), limited(dot(toRgb[2], d65)) };
}

/// A dark dot in each square cell of edge 1, anywhere in it: by random bits of its column and row (Steele, Lea & Flood 2014).
Real dotsAt(Pair place, std::uint32_t seed)
{
  const auto mixed = [](std::uint64_t z)
  {
    z += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  };
  Real white = 1;
  for (int n = 0; n < 9; ++n)
  {
    const Real column = std::floor(place.real()) + n % 3 - 1,
               row = std::floor(place.imag()) + n / 3 - 1;
    const std::uint64_t bits = mixed(
      mixed(mixed(seed) ^ std::uint64_t(std::int64_t(column))) ^ std::uint64_t(std::int64_t(row)));
    const Pair middle{ column + std::ldexp(Real(bits >> 32), -32),
      row + std::ldexp(Real(bits & 0xffffffffu), -32) };
    // Half of the light passes at 0.423 periods; a cubic leads from dark to white over 0.2 around there.
    const Real t = limited((std::abs(place - middle) - 0.423L) / 0.2L + 0.5L);
    white *= t * t * (3 - 2 * t);
  }
  return white;
}

/// The pattern behind the flow. What is finer than four pixels fades, and is gone at two.
Color patternAt(const Scene& scene, Pair place)
{
  const BackgroundPattern& pattern = scene.background;
  const View& view = scene.view;
  const Real pixel = 2 * Real(view.parallelScale) / view.height;
  if (pattern.kind == PatternKind::Image)
  {
    return colorIn(*pattern.image,
      { 2 * place.real() / (pixel * view.width), 2 * place.imag() / (pixel * view.height) });
  }
  const Real period = pattern.period > 0 ? Real(pattern.period) : 8 * pixel;
  const Real light = pattern.kind == PatternKind::Dots
    ? dotsAt(place / period, scene.seed)
    : (1 + std::cos(2 * pi * along(place, pattern.angle) / period)) / 2;
  const Real seen = 0.5L + limited((period / pixel - 2) / 2) * (light - 0.5L);
  return { seen, seen, seen };
}

/// The light of a ray. Of a technique without colours all three are the same.
Color lightOf(const Scene& scene, const Ray& ray)
{
  const Pair fromAxis = Real(scene.kScale.value_or(0)) * ray.deflection;
  const Real past = along(fromAxis, scene.knifeEdgeAngle) - Real(scene.cutoffOffset);
  Real light = 1;
  switch (scene.cutoff)
  {
    case Cutoff::KnifeEdge:
    {
      const Real x = std::clamp(2 * past, Real(-1), Real(1));
      light = scene.source.shape == SourceShape::Disc
        ? 0.5L + (x * std::sqrt(1 - x * x) + std::asin(x)) / pi
        : limited(0.5L + past);
      light = scene.invertCutoff ? 1 - light : light;
      break;
    }
    case Cutoff::GradedFilter:
    {
      const std::vector<double>& filter = scene.gradedFilter;
      const Real at = limited(0.5L + past) * Real(filter.size() - 1);
      const auto first = std::min(static_cast<std::size_t>(at), filter.size() - 2);
      light = filter[first] + (at - Real(first)) * (Real(filter[first + 1]) - filter[first]);
      light = scene.invertCutoff ? 1 - light : light;
      break;
    }
    case Cutoff::Shadowgraph:
      break;
    case Cutoff::Circular:
      light = limited(1 - std::abs(fromAxis));
      break;
    case Cutoff::CircularComplement:
      light = limited(std::abs(fromAxis));
      break;
    case Cutoff::NumericalSchlieren:
      light = std::exp(-5 * std::abs(fromAxis));
      break;
    case Cutoff::ColorFilter:
      return scene.colorFilter ? colorIn(*scene.colorFilter, fromAxis) : wheelAt(fromAxis);
    case Cutoff::Interferogram:
    {
      const Fringes& fringes = scene.fringes;
      const Real turns =
        fringes.finite ? along(ray.place, fringes.angle) / Real(fringes.spacing) : 0;
      if (fringes.whiteLight)
      {
        return whiteFringes(scene, ray.pathOnFilm, turns);
      }
      light = (1 + std::cos(2 * pi * (ray.pathOnFilm / Real(scene.wavelength) + turns))) / 2;
      break;
    }
    case Cutoff::Background:
      return patternAt(scene, ray.place);
  }
  return { light, light, light };
}

// ---- The bench

/// The undisturbed light, and what becomes of it. zeta: distance from the image's plane along the light.
struct Bench
{
  const Flow& flow;
  const Scene& scene;
  Vec u, v, travel;
  Vec middle;         ///< of the image, in its plane
  Real pixel;         ///< its size
  Real exit, film;    ///< zeta of the data's far end, and of what is recorded
  Real curvature = 0; ///< of the undisturbed wave in the image's plane
  Real magnification; ///< of the image's plane on the film
  bool isOfCamera;    ///< light counts where a ray starts

  Bench(const Flow& aFlow, const Scene& aScene)
    : flow(aFlow)
    , scene(aScene)
    , isOfCamera(aScene.cutoff == Cutoff::Background)
  {
    const View& view = scene.view;
    const Vec forward = unit(vec(view.viewDirection)), w = Real(-1) * forward;
    u = unit(cross(forward, vec(view.viewUp)));
    v = cross(u, forward);
    pixel = 2 * Real(view.parallelScale) / view.height;
    const Vec centre = centreOf(flow.grid),
              focal = view.focalPoint ? vec(*view.focalPoint) : centre;
    const Real depth = 2 * halfExtent(flow.grid, w);
    const bool isPerspective = view.viewAngle > 0;
    middle = isPerspective ? focal : focal + dot(centre - focal, w) * w;
    travel = isPerspective || isOfCamera ? forward : w;
    exit = dot(centre - middle, travel) + depth / 2;
    if (isPerspective)
    {
      curvature = std::tan(Real(view.viewAngle) / 360 * pi) / Real(view.parallelScale);
    }
    else if (scene.source.distance && !isOfCamera)
    {
      curvature = 1 / Real(*scene.source.distance);
    }
    const RecordedPlane plane = techniqueOf(scene.cutoff).plane;
    film = plane == RecordedPlane::Focus ? Real(scene.focusOffset) * dot(w, travel)
                                         : exit +
        (plane == RecordedPlane::Screen ? scene.screenDistance : scene.background.distance)
          .value_or(double(depth));
    magnification = 1 + film * curvature;
  }

  Pair inImage(const Vec& a) const { return { dot(a, u), dot(a, v) }; }
  Vec inData(Pair a) const { return a.real() * u + a.imag() * v; }

  Pair placeOf(Real column, Real row) const
  {
    return pixel *
      Pair{ column - Real(scene.view.width - 1) / 2, row - Real(scene.view.height - 1) / 2 };
  }

  /// Where light crosses the box, if it does: from < to.
  std::pair<Real, Real> chordOf(const Vec& origin, const Vec& steep) const
  {
    std::pair<Real, Real> chord{ -std::numeric_limits<Real>::infinity(), exit };
    const Vec index = indexOf(flow.grid, origin), speed = inIndex(flow.grid, steep);
    for (const std::size_t axis : axes)
    {
      // Of light along a side: infinities of different signs between the sides, else of the same.
      const Real near = -index[axis] / speed[axis],
                 far = (lastOf(flow.grid, axis) - index[axis]) / speed[axis];
      chord = { std::max(chord.first, std::min(near, far)),
        std::min(chord.second, std::max(near, far)) };
    }
    return chord;
  }

  /// The ray of a place in the image, from a point of the light source (radians).
  Ray rayOf(Pair place, Pair source) const
  {
    const Vec tilt = inData(source / magnification);
    const Vec steep = travel + inData(curvature * place) + tilt, d = unit(steep);
    const Vec origin = middle + inData(place) - film * tilt; // undisturbed: origin + zeta * steep
    Ray ray;
    ray.place = place;
    auto [from, to] = chordOf(origin, steep);
    from = scene.view.viewAngle > 0 ? std::max(from, -1 / curvature) : from; // not before the pupil
    if (!(from < to))
    {
      return ray;
    }
    const Vec start = origin + from * steep;
    const Real n = 1 + flow.pieceAt(indexOf(flow.grid, start)).valueAt(start).refractivity;
    const Real around = 1 + flow.ambient;
    const RayState end = follow(flow, { start, n * d, 0 });
    const Vec t = unit(end.momentum);
    const auto onPlane = [&](Real zeta)
    { return end.position + (zeta - dot(end.position - middle, travel)) / dot(t, travel) * t; };
    ray.deflection = inImage(t - d);
    ray.displacement = inImage(onPlane(exit) - (origin + exit * steep));
    ray.shift = inImage(onPlane(film) - (origin + film * steep));
    ray.place += ray.shift / magnification;
    ray.path = flow.lengthScale * (end.path - around * dot(end.position - start, d));
    // Against the undisturbed wave: a plane, or a sphere around the source.
    const Vec landed = onPlane(film);
    const Vec centre = origin - (1 / curvature) * steep;
    const auto radius = [&](const Vec& x)
    { return dot(x - centre, d) < 0 ? -length(x - centre) : length(x - centre); };
    const Real straight = curvature > 0 ? radius(landed) - radius(start) : dot(landed - start, d);
    ray.pathOnFilm =
      flow.lengthScale * (end.path + around * (dot(landed - end.position, t) - straight));
    return ray;
  }

  /// How places on the film change with the place in the image, along u and v.
  std::array<Pair, 2> changesAt(Pair place, Pair source) const
  {
    const Real h = 1e-3L * pixel;
    const auto by = [&](Pair step)
    { return (rayOf(place + step, source).place - rayOf(place - step, source).place) / (2 * h); };
    return { by(h), by({ 0, h }) };
  }

  /// The light at a place on the film by its area: of the ray that lands there, by the area that rays around it cover.
  Color densityAt(Pair target, Pair source) const
  {
    const auto crossed = [](Pair a, Pair b) { return a.real() * b.imag() - a.imag() * b.real(); };
    for (Pair place = target;;)
    {
      const Ray ray = rayOf(place, source);
      const auto [byU, byV] = changesAt(place, source);
      const Real area = crossed(byU, byV);
      const Pair off = ray.place - target;
      if (std::abs(off) < 1e-7L * pixel)
      {
        return (1 / std::abs(area)) * lightOf(scene, ray);
      }
      place -= Pair{ crossed(off, byV) / area, crossed(byU, off) / area };
    }
  }

  /// The mean over a pixel, by Gauss and Legendre's rule of three points each way.
  template <class LightAt>
  Color meanOver(int column, int row, const LightAt& lightAt) const
  {
    Color mean{};
    for (int n = 0; n < 9; ++n)
    {
      const int i = n % 3 - 1, j = n / 3 - 1;
      const Real node = std::sqrt(0.15L), weight = (i == 0 ? 8 : 5) * (j == 0 ? 8 : 5) / Real(324);
      mean = mean + weight * lightAt(placeOf(column + i * node, row + j * node));
    }
    return mean;
  }
};

/// Where in the source and in their pixels the rays of a pass start: multiples of irrational numbers but for the first.
std::pair<Pair, Pair> startsOf(const Scene& scene, int pass)
{
  const LightSource& source = scene.source;
  const Real plastic = 1.32471795724474602596L, a = pass * (1 + std::sqrt(5.0L)) / 2,
             b = pass * std::sqrt(2.0L);
  const auto centred = [](Real x) { return fraction(x + 0.5L) - 0.5L; };
  const Pair offset{ centred(pass / plastic), centred(pass / (plastic * plastic)) };
  if (source.shape == SourceShape::Disc)
  {
    return { std::polar(Real(source.width) / 2 * std::sqrt(fraction(a)), 2 * pi * fraction(b)),
      offset };
  }
  const Pair inSlit{ Real(source.width) * centred(a), Real(source.length) * centred(b) };
  return { source.shape == SourceShape::Slit ? inSlit * turned(scene.knifeEdgeAngle) : 0, offset };
}

} // namespace

Images trace(const Flow& flow, const Scene& scene)
{
  const Bench bench(flow, scene);
  Images images;
  for (int pixel = 0; pixel < scene.view.width * scene.view.height; ++pixel)
  {
    const Pair place = bench.placeOf(pixel % scene.view.width, pixel / scene.view.width);
    const Ray ray = bench.rayOf(place, 0);
    images.deflection.push_back(ray.deflection);
    images.displacement.push_back(ray.displacement);
    images.opticalPathDifference.push_back(ray.path);
    images.shift.push_back(ray.shift);
  }
  return images;
}

Images render(const Flow& flow, const Scene& scene)
{
  const Bench bench(flow, scene);
  const int width = scene.view.width, height = scene.view.height;
  Images images = trace(flow, scene);
  Real farthest = 0;
  for (const Pair shift : images.shift)
  {
    farthest = std::max(farthest, std::abs(shift));
  }
  images.color.resize(static_cast<std::size_t>(width * height));
  const auto add = [&](int column, int row, Real weight, const Color& light)
  {
    if (column >= 0 && column < width && row >= 0 && row < height)
    {
      Color& pixel = images.color[static_cast<std::size_t>(row * width + column)];
      pixel = pixel + (weight / scene.samplesPerPixel) * light;
    }
  };
  for (int pass = 0; pass < scene.samplesPerPixel; ++pass)
  {
    const auto [inSource, offset] = startsOf(scene, pass);
    const Pair source = bench.isOfCamera ? 0 : inSource;
    const bool isSplat = scene.filmEstimator == FilmEstimator::Photon;
    const int margin = isSplat ? 2 + static_cast<int>(std::ceil(1.5L * farthest / bench.pixel)) : 0;
    for (int row = -margin; row < height + margin; ++row)
    {
      for (int column = -margin; column < width + margin; ++column)
      {
        if (!isSplat)
        {
          add(column, row, 1,
            bench.meanOver(column, row,
              [&, from = source](Pair place)
              {
                return bench.isOfCamera ? lightOf(scene, bench.rayOf(place, from))
                                        : bench.densityAt(place, from);
              }));
          continue;
        }
        const Pair start = bench.placeOf(column + offset.real(), row + offset.imag());
        const Ray ray = bench.rayOf(start, source);
        const Pair landed =
          ((bench.isOfCamera ? start : ray.place) - bench.placeOf(0, 0)) / bench.pixel;
        const Color light = lightOf(scene, ray);
        for (int n = 0; n < 4; ++n) // bilinearly
        {
          const int i = static_cast<int>(std::floor(landed.real())) + n % 2,
                    j = static_cast<int>(std::floor(landed.imag())) + n / 2;
          add(i, j, (1 - std::abs(landed.real() - i)) * (1 - std::abs(landed.imag() - j)), light);
        }
      }
    }
  }
  for (int pixel = 0; pixel < width * height; ++pixel)
  {
    images.intensity.push_back(luminance(images.color[std::size_t(pixel)]));
    const auto patternOf = [&](Pair place) { return patternAt(scene, place); };
    images.background.push_back(luminance(bench.meanOver(pixel % width, pixel / width, patternOf)));
  }
  return images;
}

} // namespace schlieren::reference
