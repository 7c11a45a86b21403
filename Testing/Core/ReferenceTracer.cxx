// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceTracer.h"

#include "Rays/Light.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

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
Pair turned(Real degrees) { return std::polar(Real(1), degrees * pi / 180); }
Real along(Pair a, Real degrees) { return (a * std::conj(turned(degrees))).real(); }

Real lastOf(const Grid& grid, std::size_t axis) { return Real(grid.dimensions[axis] - 1); }

/// By how much index coordinates change along a vector.
Vec inIndex(const Grid& grid, const Vec& a)
{
  Vec found;
  for (const std::size_t axis : axes)
  {
    found[axis] = dot(a, stepOf(grid, axis)) / Real(grid.spacing[axis] * grid.spacing[axis]);
  }
  return found;
}

} // namespace

Vec stepOf(const Grid& grid, std::size_t axis)
{
  const std::array<double, 9>& d = grid.direction;
  return Real(grid.spacing[axis]) * Vec{ d[axis], d[3 + axis], d[6 + axis] };
}

Vec indexOf(const Grid& grid, const Vec& place) { return inIndex(grid, place - vec(grid.origin)); }

namespace
{

// ---- The equation of rays

static_assert(std::numeric_limits<Real>::digits >= 64, "tolerances are below those of doubles");
using Numbers = std::array<Real, 7>; ///< position, momentum, path

Vec placeOf(const Numbers& y) { return { y[0], y[1], y[2] }; }
Vec momentumOf(const Numbers& y) { return { y[3], y[4], y[5] }; }

Numbers slopeOf(const Refractivity& refractivity, const Numbers& y)
{
  const auto [N, gradient] = refractivity(placeOf(y));
  const Vec t = (1 / (1 + N)) * momentumOf(y);
  return { t[0], t[1], t[2], gradient[0], gradient[1], gradient[2], 1 + N };
}

/// Extrapolates the explicit midpoint rule with 2, 4, 6 ... parts to parts of no length (Gragg 1965; Hairer, Norsett & Wanner
/// 1993, section II.9), until the error is small enough or 16 parts do not do. Returns the end and the error.
std::pair<Numbers, Real> extrapolated(
  const Refractivity& refractivity, const Numbers& start, Real step, Real tolerance)
{
  std::vector<Numbers> coarser{ start };
  Real error = std::numeric_limits<Real>::infinity();
  for (int half = 1; half <= 8 && error > tolerance; ++half)
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
    const Numbers change = finer.back() - (half == 1 ? start : finer[finer.size() - 2]);
    const auto [low, high] = std::minmax_element(change.begin(), change.end());
    error = std::max(*high, -*low);
    coarser = finer;
  }
  return { coarser.back(), error };
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

RayState follow(const Flow& flow, const RayState& start)
{
  const Grid& grid = flow.grid;
  Real size = 0;
  for (const std::size_t axis : axes)
  {
    size = std::max(size, lastOf(grid, axis) * Real(grid.spacing[axis]));
  }
  // Of a step; rounding is 1e-19.
  const Real tolerance = std::max(1e-13L * flow.largest, 1e-17L) * size;
  const auto [x, p, path] = start;
  Numbers y{ x[0], x[1], x[2], p[0], p[1], p[2], path };
  const Real longest = size / 16; // so that no step misses anything
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
      auto [end, error] = extrapolated(piece.valueAt, y, tried, tolerance);
      step = std::min(error > tolerance ? tried / 2 : 2 * tried, longest);
      if (error > tolerance)
      {
        continue;
      }
      Real past = beyond(grid, piece, end);
      // To where the bent ray meets the side, by Newton's method.
      const bool isLast = past > -0.01L * tried;
      for (int times = 0; isLast && times < 20 && std::abs(past) > 1e-16L * size; ++times)
      {
        tried -= past;
        end = extrapolated(piece.valueAt, y, tried, tolerance).first;
        past = beyond(grid, piece, end);
      }
      y = end;
      rest = isLast ? 0 : -past;
    }
  }
}

namespace
{

// ---- Light of a ray

/// Hue by the direction, saturation by the size, 1 as value, taken as sRGB (Brownlee et al. 2011, eq. 17).
Color wheelAt(Pair fromAxis)
{
  Color color;
  for (const std::size_t c : axes) // red at 0, green at 120, blue at 240 degrees
  {
    const Real sixths = std::abs(std::arg(fromAxis * turned(-120 * Real(c)))) * 3 / pi;
    const Real srgb = 1 - limited(std::abs(fromAxis)) * (1 - limited(2 - sixths));
    color[c] = srgb <= 0.04045L ? srgb / 12.92L : std::pow((srgb + 0.055L) / 1.055L, 2.4L);
  }
  return color;
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
    const auto column = static_cast<std::int64_t>(std::floor(place.real())) + n % 3 - 1;
    const auto row = static_cast<std::int64_t>(std::floor(place.imag())) + n / 3 - 1;
    const std::uint64_t bits =
      mixed(mixed(mixed(seed) ^ std::uint64_t(column)) ^ std::uint64_t(row));
    const Real right = std::ldexp(Real(bits >> 32), -32),
               up = std::ldexp(Real(bits & 0xffffffffu), -32);
    const Pair middle{ Real(column) + right, Real(row) + up };
    // Half of the light passes at 0.423 periods; a cubic leads from dark to white over 0.2 around there.
    const Real t = limited((std::abs(place - middle) - 0.423L) / 0.2L + 0.5L);
    white *= t * t * (3 - 2 * t);
  }
  return white;
}

/// The pattern behind the flow. What is finer than four pixels fades, and is gone at two.
Real patternAt(const Scene& scene, const Ray& ray)
{
  const BackgroundPattern& pattern = scene.background;
  const Real pixel = ray.magnification * 2 * Real(scene.view.parallelScale) / scene.view.height;
  const Real period = pattern.period > 0 ? Real(pattern.period) : 8 * pixel;
  const Real light = pattern.kind == PatternKind::Dots
    ? dotsAt(ray.behind / period, scene.seed)
    : (1 + std::cos(2 * pi * along(ray.behind, pattern.angle) / period)) / 2;
  return 0.5L + limited((period / pixel - 2) / 2) * (light - 0.5L);
}

/// The light of a ray; of a technique without colours all three are the same.
Color lightOf(const Scene& scene, const Ray& ray)
{
  const Pair fromAxis = Real(scene.kScale.value_or(0)) * ray.deflection;
  const Real past = along(fromAxis, scene.knifeEdgeAngle) - Real(scene.cutoffOffset);
  const auto grey = [](Real light) { return Color{ light, light, light }; };
  const auto ofSide = [&](Real light) { return grey(scene.invertCutoff ? 1 - light : light); };
  switch (scene.cutoff)
  {
    case Cutoff::KnifeEdge:
    {
      const Real x = std::clamp(2 * past, Real(-1), Real(1));
      const Real ofDisc = (x * std::sqrt(1 - x * x) + std::asin(x)) / pi;
      return ofSide(0.5L + (scene.source.shape == SourceShape::Disc ? ofDisc : x / 2));
    }
    case Cutoff::GradedFilter:
    {
      const std::vector<double>& filter = scene.gradedFilter;
      const Real at = limited(0.5L + past) * Real(filter.size() - 1);
      const auto first = std::min(static_cast<std::size_t>(at), filter.size() - 2);
      return ofSide(filter[first] + (at - Real(first)) * Real(filter[first + 1] - filter[first]));
    }
    case Cutoff::Circular:
      return grey(limited(1 - std::abs(fromAxis)));
    case Cutoff::CircularComplement:
      return grey(limited(std::abs(fromAxis)));
    case Cutoff::NumericalSchlieren:
      return grey(std::exp(-5 * std::abs(fromAxis)));
    case Cutoff::ColorFilter:
      return wheelAt(fromAxis);
    case Cutoff::Interferogram:
    {
      const Real fringes = scene.fringes.finite ? 1 / Real(scene.fringes.spacing) : 0;
      const Real turns =
        ray.onFilm / Real(scene.wavelength) + fringes * along(ray.place, scene.fringes.angle);
      return grey((1 + std::cos(2 * pi * turns)) / 2);
    }
    case Cutoff::Background:
      return grey(patternAt(scene, ray));
    default:
      return grey(1);
  }
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
  Real curvature;     ///< of the undisturbed wave in the image's plane
  Real magnification; ///< of that plane on the film
  bool isOfCamera;    ///< light counts where a ray starts

  Bench(const Flow& ofFlow, const Scene& ofScene)
    : flow(ofFlow)
    , scene(ofScene)
  {
    isOfCamera = scene.cutoff == Cutoff::Background;
    const View& view = scene.view;
    const Vec forward = unit(vec(view.viewDirection)), w = Real(-1) * forward;
    u = unit(cross(forward, vec(view.viewUp)));
    v = cross(u, forward);
    pixel = 2 * Real(view.parallelScale) / view.height;
    Vec centre = vec(flow.grid.origin);
    Real depth = 0;
    for (const std::size_t axis : axes)
    {
      const Vec edge = lastOf(flow.grid, axis) * stepOf(flow.grid, axis);
      centre = centre + 0.5L * edge;
      depth += std::abs(dot(edge, w));
    }
    const Vec focal = view.focalPoint ? vec(*view.focalPoint) : centre;
    const bool isPerspective = view.viewAngle > 0;
    middle = isPerspective ? focal : focal + dot(centre - focal, w) * w;
    travel = isPerspective || isOfCamera ? forward : w;
    exit = dot(centre - middle, travel) + depth / 2;
    curvature = isPerspective ? std::tan(Real(view.viewAngle) / 360 * pi) / Real(view.parallelScale)
      : scene.source.distance && !isOfCamera ? 1 / Real(*scene.source.distance)
                                             : 0;
    const auto behind = isOfCamera ? scene.background.distance : scene.screenDistance;
    film = techniqueOf(scene.cutoff).plane == RecordedPlane::Focus
      ? Real(scene.focusOffset) * dot(w, travel)
      : exit + Real(behind.value_or(double(depth)));
    magnification = 1 + film * curvature;
  }

  Pair inImage(const Vec& a) const { return { dot(a, u), dot(a, v) }; }
  Vec inData(Pair a) const { return a.real() * u + a.imag() * v; }

  Pair placeOf(Real column, Real row) const
  {
    return pixel *
      Pair{ column - Real(scene.view.width - 1) / 2, row - Real(scene.view.height - 1) / 2 };
  }

  /// The ray of a place in the image, from a point of the light source (radians).
  Ray rayOf(Pair place, Pair source) const
  {
    const Vec tilt = inData(source / magnification);
    const Vec steep = travel + inData(curvature * place) + tilt, d = unit(steep);
    const Vec origin = middle + inData(place) - film * tilt; // undisturbed: origin + zeta * steep
    Ray ray;
    ray.place = place;
    ray.magnification = magnification;
    ray.behind = inImage(middle) + magnification * place;
    // Where it is in the box; with a perspective not before the pupil.
    Real from = -1 / (scene.view.viewAngle > 0 ? curvature : 0), to = exit;
    const Vec index = indexOf(flow.grid, origin), speed = inIndex(flow.grid, steep);
    for (const std::size_t axis : axes)
    {
      // Of light along a side: infinite, with different signs between the sides.
      const Real low = -index[axis] / speed[axis];
      const Real high = (lastOf(flow.grid, axis) - index[axis]) / speed[axis];
      from = std::max(from, std::min(low, high));
      to = std::min(to, std::max(low, high));
    }
    if (!(from < to))
    {
      return ray;
    }
    const Vec start = origin + from * steep;
    const Real n = 1 + flow.pieceAt(indexOf(flow.grid, start)).valueAt(start).refractivity;
    const Real around = 1 + flow.ambient;
    const RayState end = follow(flow, { start, n * d, 0 });
    const Vec t = unit(end.momentum);
    const auto toPlane = [&](Real zeta)
    { return (zeta - dot(end.position - middle, travel)) / dot(t, travel); };
    ray.deflection = inImage(t - d);
    ray.displacement = inImage(end.position + toPlane(exit) * t - (origin + exit * steep));
    ray.shift = inImage(end.position + toPlane(film) * t - (origin + film * steep));
    ray.place += ray.shift / magnification;
    ray.behind += ray.shift;
    // Against the undisturbed wave: a plane, on the film a sphere around the source.
    const auto longer = [&](Real zeta, Real curved)
    {
      const Vec landed = end.position + toPlane(zeta) * t;
      const Vec centre = origin - (1 / curvature) * steep;
      const Real inFront = dot(landed - centre, d) < 0 ? -1 : 1;
      const Real wave = curved > 0 ? inFront * length(landed - centre) - length(start - centre)
                                   : dot(landed - start, d);
      return flow.lengthScale * (end.path + around * (toPlane(zeta) - wave));
    };
    ray.opticalPath = longer(exit, 0);
    ray.onFilm = longer(film, curvature);
    return ray;
  }

  /// The light at a place on the film by its area: of the ray that lands there, by the area that rays around it cover.
  Color densityAt(Pair target, Pair source) const
  {
    const auto crossed = [](Pair a, Pair b) { return (std::conj(a) * b).imag(); };
    for (Pair place = target;;)
    {
      const Ray ray = rayOf(place, source);
      const Real h = 1e-3L * pixel;
      const auto changeBy = [&](Pair step)
      { return (rayOf(place + step, source).place - rayOf(place - step, source).place) / (2 * h); };
      const Pair byU = changeBy(h), byV = changeBy({ 0, h }), off = ray.place - target;
      const Real area = crossed(byU, byV);
      if (std::abs(off) < 1e-7L * pixel)
      {
        return (1 / std::abs(area)) * lightOf(scene, ray);
      }
      place -= Pair{ crossed(off, byV), crossed(byU, off) } / area; // Newton's method
    }
  }

  /// The mean light over a pixel, by Gauss and Legendre's rule of three points each way.
  Color meanOver(int column, int row, Pair source) const
  {
    Color mean{};
    for (int n = 0; n < 9; ++n)
    {
      const int i = n % 3 - 1, j = n / 3 - 1;
      const Real node = std::sqrt(0.15L), weight = (i == 0 ? 8 : 5) * (j == 0 ? 8 : 5) / Real(324);
      const Pair place = placeOf(column + i * node, row + j * node);
      mean =
        mean + weight * (isOfCamera ? lightOf(scene, rayOf(place, 0)) : densityAt(place, source));
    }
    return mean;
  }
};

/// Where in the source, and where in their pixels, the rays of a pass start.
std::pair<Pair, Pair> startsOf(const Scene& scene, int pass)
{
  const LightSource& source = scene.source;
  const Real width = source.width;
  const Real a = pass * (1 + std::sqrt(5.0L)) / 2, b = pass * std::sqrt(2.0L);
  const auto centred = [](Real x) { return x - std::floor(x + 0.5L); };
  const PixelOffset inPixel = pixelOffset(pass, scene.seed);
  const Pair offset{ inPixel.column, inPixel.row };
  if (scene.lens.aperture > 0) // of a view with a perspective
  {
    const auto place = pupilPoint(pass, scene.samplesPerPixel);
    const Real pupil =
      Real(scene.view.parallelScale) / std::tan(Real(scene.view.viewAngle) / 360 * pi);
    return { Real(scene.lens.aperture) / (2 * pupil) * Pair{ place[0], place[1] }, offset };
  }
  if (source.shape == SourceShape::Point || scene.cutoff == Cutoff::Background)
  {
    return { 0, offset };
  }
  const Pair inSlit{ width * centred(a), Real(source.length) * centred(b) };
  const Pair inDisc = std::polar(width / 2 * std::sqrt(a - std::floor(a)), 2 * pi * centred(b));
  const bool isSlit = source.shape == SourceShape::Slit;
  return { isSlit ? inSlit * turned(scene.knifeEdgeAngle) : inDisc, offset };
}

} // namespace

std::vector<Ray> trace(const Flow& flow, const Scene& scene)
{
  const Bench bench(flow, scene);
  std::vector<Ray> rays;
  for (int pixel = 0; pixel < scene.view.width * scene.view.height; ++pixel)
  {
    const int column = pixel % scene.view.width, row = pixel / scene.view.width;
    rays.push_back(bench.rayOf(bench.placeOf(column, row), 0));
  }
  return rays;
}

std::vector<Color> render(const Flow& flow, const Scene& scene)
{
  const Bench bench(flow, scene);
  const int width = scene.view.width, height = scene.view.height;
  std::vector<Color> image(static_cast<std::size_t>(width * height));
  const auto add = [&](int column, int row, Real weight, const Color& light)
  {
    if (column >= 0 && column < width && row >= 0 && row < height)
    {
      Color& pixel = image[static_cast<std::size_t>(row * width + column)];
      pixel = pixel + (weight / scene.samplesPerPixel) * light;
    }
  };
  const bool isSplat = scene.filmEstimator == FilmEstimator::Photon;
  Real farthest = 0; // a splat comes from, pixels
  for (const Ray& ray : trace(flow, scene))
  {
    farthest = isSplat ? std::max(farthest, 2 + 1.5L * std::abs(ray.shift) / bench.pixel) : 0;
  }
  const int margin = static_cast<int>(farthest);
  const int columns = width + 2 * margin, rays = columns * (height + 2 * margin);
  for (int n = 0; n < rays * scene.samplesPerPixel; ++n)
  {
    const int column = n % rays % columns - margin, row = n % rays / columns - margin;
    const auto [source, offset] = startsOf(scene, n / rays);
    if (!isSplat)
    {
      add(column, row, 1, bench.meanOver(column, row, source));
      continue;
    }
    const Pair start = bench.placeOf(column + offset.real(), row + offset.imag());
    const Ray ray = bench.rayOf(start, source);
    const Pair counts = bench.isOfCamera ? start : ray.place;
    const Pair landed = (counts - bench.placeOf(0, 0)) / bench.pixel;
    for (int near = 0; near < 4; ++near) // bilinearly
    {
      const Real i = std::floor(landed.real()) + near % 2, j = std::floor(landed.imag()) + near / 2;
      const Real weight = (1 - std::abs(landed.real() - i)) * (1 - std::abs(landed.imag() - j));
      add(static_cast<int>(i), static_cast<int>(j), weight, lightOf(scene, ray));
    }
  }
  return image;
}

} // namespace schlieren::reference
