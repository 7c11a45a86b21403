// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RandomScenes.h"

#include "BowShockSource.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace schlieren
{

namespace
{

using Formula = std::function<double(double, double, double)>;

/// N of another source times a factor.
class ScaledSource : public MediumSource
{
public:
  ScaledSource(std::shared_ptr<const MediumSource> source, double factor)
    : source_(std::move(source))
    , factor_(factor)
  {
  }

  Box bounds() const override { return source_->bounds(); }
  double ambient() const override { return factor_ * source_->ambient(); }
  Content contentOf(const Box& box) const override
  {
    Content content = source_->contentOf(box);
    if (content.lowest <= content.highest)
    {
      content.lowest *= factor_;
      content.highest *= factor_;
    }
    return content;
  }
  void sample(
    const Lattice& lattice, double* refractivities, Place* places, float* distances) const override
  {
    source_->sample(lattice, refractivities, places, distances);
    for (std::int64_t i = 0; i < lattice.size(); ++i)
    {
      refractivities[i] *= factor_;
    }
  }

private:
  std::shared_ptr<const MediumSource> source_;
  double factor_;
};

/// A ball in which something is finer than pixels of a view of 48 to 64: two gratings, of 0.5 to 8 pixels a period, or a sheet
/// of a tenth to twice a pixel. Cells are a half to a twentieth of a pixel.
class FineSource : public AnalyticSource
{
public:
  explicit FineSource(Random& random, double height)
    : height_(height)
    , isPeriodic_(random.chance(0.5))
    , cell_(random.logUniform(0.05, 0.5) * pixel)
  {
    for (Layers& layers : layers_)
    {
      layers.normal = random.direction();
      layers.width = isPeriodic_ ? random.logUniform(0.5, 8) * pixel / (2 * pi)
                                 : random.logUniform(0.1, 2) * pixel;
      layers.at = random.uniform(-0.3, 0.3);
      layers.height = height * random.logUniform(0.01, 1) * (isPeriodic_ ? 0.5 : 1);
    }
  }

  double refractivity(double x, double y, double z) const override
  {
    const double ball = std::exp(-(x * x + y * y + z * z) / (radius * radius));
    double sum = height_ * ball;
    for (const Layers& layers : layers_)
    {
      const double across =
        (layers.normal[0] * x + layers.normal[1] * y + layers.normal[2] * z - layers.at) /
        layers.width;
      sum += layers.height * (isPeriodic_ ? ball * std::sin(across) : std::tanh(across));
    }
    return sum;
  }
  Range rangeOver(const Box& box) const override
  {
    const Range r = distancesTo({ 0, 0, 0 }, box);
    const auto ball = [](double x) { return std::exp(-x * x / (radius * radius)); };
    Range sum{ height_ * ball(r.second), height_ * ball(r.first) };
    for (const Layers& layers : layers_)
    {
      double low = -layers.at, high = -layers.at; // along the normal
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const double n = layers.normal[axis];
        low += n * (n > 0 ? box.low : box.high)[axis];
        high += n * (n > 0 ? box.high : box.low)[axis];
      }
      const double most = layers.height * ball(r.first);
      sum.first += isPeriodic_ ? -most : layers.height * std::tanh(low / layers.width);
      sum.second += isPeriodic_ ? most : layers.height * std::tanh(high / layers.width);
    }
    return sum;
  }
  double cellSizeOver(const Box&) const override { return cell_; }

private:
  static constexpr double pixel = 0.04, radius = 0.4; // of a box of two
  struct Layers
  {
    Vector normal;
    double width, at, height;
  };

  double height_;
  bool isPeriodic_;
  double cell_;
  std::array<Layers, 2> layers_;
};

/// Of order 1, from weak signals to glass; most are gases.
double randomHeight(Random& random)
{
  const double which = random.uniform(0, 1);
  return which < 0.6 ? random.logUniform(1e-6, 1e-3)
    : which < 0.8    ? random.logUniform(1e-12, 1e-6)
                     : random.logUniform(1e-3, 1);
}

/// Points are in units of half the longest edge, from the middle.
Formula ballsOf(Random& random)
{
  std::vector<Ball> balls(static_cast<std::size_t>(1 + random.below(3)));
  for (Ball& ball : balls)
  {
    ball = { { random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4) },
      random.uniform(0.2, 0.6), random.uniform(-1, 1) };
  }
  balls.front().height = 1;
  return [balls](double x, double y, double z)
  {
    double sum = 0;
    for (const Ball& ball : balls)
    {
      const double dx = x - ball.centre[0], dy = y - ball.centre[1], dz = z - ball.centre[2];
      sum += ball.height * std::exp(-(dx * dx + dy * dy + dz * dz) / (ball.width * ball.width));
    }
    return sum;
  };
}

/// `thickness`: of a shock; 0: a step.
Formula shockOf(Random& random, double thickness)
{
  const Vector n = random.direction();
  const double at = random.uniform(-0.2, 0.2);
  const double curvature = random.chance(0.5) ? random.uniform(-0.5, 0.5) : 0;
  const Formula ball = ballsOf(random);
  const double strength = random.uniform(0.2, 1);
  return [=](double x, double y, double z)
  {
    const double across = n[0] * x + n[1] * y + n[2] * z - at + curvature * (x * x + y * y + z * z);
    const double jump = thickness > 0 ? std::tanh(across / thickness) : across > 0 ? 1. : -1.;
    return strength * 0.5 * (1 + jump) + 0.5 * ball(x, y, z);
  };
}

Formula columnOf(Random& random)
{
  Vector axis{ 0, 0, 0 };
  axis[static_cast<std::size_t>(random.below(3))] = 1;
  if (random.chance(0.5))
  {
    axis = random.direction();
  }
  const Vector centre{ random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3),
    random.uniform(-0.3, 0.3) };
  const double width = random.uniform(0.15, 0.6);
  return [=](double x, double y, double z)
  {
    const double d[3] = { x - centre[0], y - centre[1], z - centre[2] };
    const double along = d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2];
    const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2] - along * along;
    return std::exp(-square / (width * width));
  };
}

/// `shortest`: wavelength.
Formula wavesOf(Random& random, int count, double shortest)
{
  struct Wave
  {
    Vector k;
    double height, phase;
  };
  std::vector<Wave> waves(static_cast<std::size_t>(count));
  for (Wave& wave : waves)
  {
    const double length = random.logUniform(shortest, std::max(2., 2 * shortest));
    wave.k = random.direction();
    for (double& component : wave.k)
    {
      component *= 2 * pi / length;
    }
    wave.height = count > 4 ? std::pow(length, 5. / 6) : random.uniform(0.3, 1);
    wave.phase = random.uniform(0, 2 * pi);
  }
  return [waves](double x, double y, double z)
  {
    double sum = 0;
    for (const Wave& wave : waves)
    {
      sum += wave.height * std::sin(wave.k[0] * x + wave.k[1] * y + wave.k[2] * z + wave.phase);
    }
    return sum / static_cast<double>(waves.size());
  };
}

Grid randomGrid(Random& random, bool isFlat)
{
  Grid grid;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    grid.dimensions[axis] = 12 + random.below(25);
    grid.spacing[axis] = random.chance(0.5) ? 1 : random.logUniform(0.4, 2.5);
  }
  if (isFlat)
  {
    grid.dimensions[2] = 2;
    grid.spacing[2] = random.uniform(4, 40);
  }
  double longest = 0;
  const std::size_t axes = isFlat ? 2 : 3;
  for (std::size_t axis = 0; axis < axes; ++axis)
  {
    longest =
      std::max(longest, grid.spacing[axis] * static_cast<double>(grid.dimensions[axis] - 1));
  }
  const double unit = random.chance(0.3) ? random.logUniform(1e-3, 1e3) : 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    grid.spacing[axis] *= 2 * unit / longest;
    grid.origin[axis] = -0.5 * grid.spacing[axis] * static_cast<double>(grid.dimensions[axis] - 1);
  }
  return grid;
}

double longestHalf(const Grid& grid)
{
  return -*std::min_element(grid.origin.begin(), grid.origin.end());
}

Formula formulaOf(DataKind kind, const Grid& grid, Random& random)
{
  const std::size_t axes = kind == DataKind::Flat ? 2 : 3;
  double voxel = 0; // on the average, in the formula's unit
  for (std::size_t axis = 0; axis < axes; ++axis)
  {
    voxel += grid.spacing[axis] / static_cast<double>(axes);
  }
  voxel /= kind == DataKind::Flat ? -std::min(grid.origin[0], grid.origin[1]) : longestHalf(grid);
  const auto anyShock = [&] { return shockOf(random, random.logUniform(0.7, 6) * voxel); };
  switch (kind)
  {
    case DataKind::Shock:
      return anyShock();
    case DataKind::Column:
      return columnOf(random);
    case DataKind::Waves:
      return wavesOf(random, 2 + random.below(2), 8 * voxel);
    case DataKind::Turbulence:
      return wavesOf(random, 24, 5 * voxel);
    case DataKind::Step:
      return shockOf(random, 0);
    case DataKind::Body:
    case DataKind::Flat:
      return random.chance(0.5) ? ballsOf(random) : anyShock();
    default:
      return ballsOf(random);
  }
}

/// Marks a sphere or a box as solid.
void addBody(RandomData& data, const Grid& grid, Random& random)
{
  const double size = random.uniform(0.15, 0.35) * longestHalf(grid);
  const bool isBox = random.chance(0.4);
  const Vector centre{ random.uniform(-0.2, 0.2) * longestHalf(grid),
    random.uniform(-0.2, 0.2) * longestHalf(grid), random.uniform(-0.2, 0.2) * longestHalf(grid) };
  const SampledField<double> inside(grid,
    [&](double x, double y, double z)
    {
      const Vector r{ std::abs(x - centre[0]), std::abs(y - centre[1]), std::abs(z - centre[2]) };
      return (isBox ? std::max({ r[0], r[1], r[2] })
                    : std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2])) < size
        ? 1.
        : 0.;
    });
  for (const double isInside : inside.samples)
  {
    data.valid.push_back(isInside > 0 ? 0 : 1);
  }
  data.field.valid = data.valid.data();
}

void sampleOnGrid(RandomData& data, Random& random)
{
  const bool isFlat = data.kind == DataKind::Flat;
  Grid grid = randomGrid(random, isFlat);
  const Formula formula = formulaOf(data.kind, grid, random);
  const double height = randomHeight(random);
  const double unit = isFlat ? -std::min(grid.origin[0], grid.origin[1]) : longestHalf(grid);
  // In glass the formula must not fall below vacuum by much.
  const double offset = height > 0.05 ? height : 0;
  data.samples = std::make_unique<SampledField<double>>(grid,
    [&](double x, double y, double z)
    { return offset + height * formula(x / unit, y / unit, isFlat ? 0 : z / unit); });
  data.field = data.samples->field;
  if (random.chance(0.7))
  {
    data.field.ambient = offset;
  }
  if (data.kind == DataKind::Body)
  {
    addBody(data, grid, random);
  }
  else if (!isFlat && random.chance(0.15)) // turns the axes around z
  {
    const double angle = random.uniform(0, 2 * pi);
    const double c = std::cos(angle), s = std::sin(angle);
    data.field.grid.direction = { c, -s, 0, s, c, 0, 0, 0, 1 };
    const double x = grid.origin[0], y = grid.origin[1];
    data.field.grid.origin = { c * x - s * y, s * x + c * y, grid.origin[2] };
  }
}

void makeSource(RandomData& data, Random& random)
{
  const double height = randomHeight(random);
  std::shared_ptr<const MediumSource> source;
  if (data.kind == DataKind::TreeBalls)
  {
    std::vector<Ball> balls;
    for (int n = 1 + random.below(3); n > 0; --n)
    {
      balls.push_back(
        { { random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4) },
          random.uniform(0.1, 0.45), height * random.uniform(0.3, 1) });
    }
    source = std::make_shared<BallsSource>(balls, 1., random.uniform(0.05, 0.2));
  }
  else if (data.kind == DataKind::TreeFine)
  {
    source = std::make_shared<FineSource>(random, height);
  }
  else if (data.kind == DataKind::TreeShock)
  {
    source = std::make_shared<ScaledSource>(std::make_shared<ShellSource>(), height / 1e-4);
    data.near = random.uniform(0.4, 1);
  }
  else if (random.chance(0.7))
  {
    source = std::make_shared<ScaledSource>(
      std::make_shared<SphereSource>(random.uniform(3, 20)), height / 1e-4);
    data.near = random.uniform(1.2, 3);
  }
  else
  {
    source = std::make_shared<ScaledSource>(
      std::make_shared<BowShockSource>(), std::min(height, 0.1) / BowShockSource::far);
    data.near = random.uniform(1.5, 4);
  }
  data.field = fieldOf(source);
}

struct Seen
{
  double deflection = 0, divergence = 0, path = 0, pixelSize = 1, depth = 1;
};

/// What 98 % of the rays do not exceed, and the range of the path.
Seen scout(const RandomData& data, Scene scene)
{
  constexpr int side = 40;
  scene.cutoff = Cutoff::KnifeEdge;
  scene.view.width = scene.view.height = side;
  scene.samplesPerPixel = 1;
  scene.mediumTolerance = 0.1;
  const Image image = Bench().render(data.field, scene);
  std::vector<double> deflections, divergences;
  double lowest = 0, highest = 0;
  for (int row = 0; row + 1 < side; ++row)
  {
    for (int column = 0; column + 1 < side; ++column)
    {
      const std::size_t at = pixelOf(image, column, row), right = at + 1, up = at + side;
      const float* eps = image.deflection.data();
      if (image.blockedFraction[at] + image.blockedFraction[right] + image.blockedFraction[up] > 0)
      {
        continue;
      }
      deflections.push_back(std::hypot(eps[2 * at], eps[2 * at + 1]));
      divergences.push_back(
        std::abs(eps[2 * right] - eps[2 * at]) + std::abs(eps[2 * up + 1] - eps[2 * at + 1]));
      lowest = std::min(lowest, image.opticalPathDifference[at]);
      highest = std::max(highest, image.opticalPathDifference[at]);
    }
  }
  const auto strong = [](std::vector<double>& values)
  {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0 : values[values.size() * 98 / 100];
  };
  return { strong(deflections), strong(divergences) / image.frame.pixelSize, highest - lowest,
    image.frame.pixelSize * side, image.frame.exit - image.frame.entry };
}

} // namespace

Vector Random::direction()
{
  for (;;)
  {
    const Vector a{ uniform(-1, 1), uniform(-1, 1), uniform(-1, 1) };
    const double square = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
    if (square > 0.01 && square < 1)
    {
      const double length = std::sqrt(square);
      return { a[0] / length, a[1] / length, a[2] / length };
    }
  }
}

const char* name(DataKind kind)
{
  constexpr const char* names[dataKinds] = { "balls", "shock", "column", "waves", "turbulence",
    "step", "body", "2-D", "tree, balls", "tree, shock", "tree, body", "tree, fine" };
  return names[static_cast<int>(kind)];
}

RandomData randomData(DataKind kind, Random& random)
{
  RandomData data;
  data.kind = kind;
  if (kind >= DataKind::TreeBalls)
  {
    makeSource(data, random);
  }
  else
  {
    sampleOnGrid(data, random);
  }
  Grid box = data.field.grid;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.spacing[axis] *= static_cast<double>(box.dimensions[axis] - 1);
    box.dimensions[axis] = 2;
  }
  data.everywhere =
    std::make_unique<SampledField<double>>(box, [](double, double, double) { return 1e-6; });
  data.everywhere->field.ambient = 0;
  return data;
}

Scene randomScene(const RandomData& data, Cutoff cutoff, Random& random)
{
  Scene scene;
  scene.device = Device::Cpu;
  scene.cutoff = cutoff;
  View& view = scene.view;
  view.width = 48 + random.below(random.chance(0.2) ? 81 : 17);
  view.height = 48 + random.below(17);
  if (random.chance(0.35) || data.kind == DataKind::Flat)
  {
    view.viewDirection = { 0, 0, random.chance(0.5) ? -1. : 1. };
    if (data.kind != DataKind::Flat && random.chance(0.5))
    {
      view.viewDirection = { 1, 0, 0 };
    }
  }
  else
  {
    view.viewDirection = random.direction();
    view.viewUp = random.direction();
  }
  if (random.chance(0.25))
  {
    view.viewAngle = random.uniform(5, 40);
  }
  if (data.near > 0)
  {
    view.focalPoint = Vector{ 0, 0, 0 };
    view.parallelScale = data.near;
  }
  scene.knifeEdgeAngle = random.uniform(0, 360);
  static_cast<void>(random.chance(0.3)); // what follows is that of the scenes in accuracy.md

  const Seen seen = scout(data, scene);
  const double height = seen.pixelSize;
  const double pixel = height / view.height;
  if (random.chance(0.25))
  {
    scene.cutoffOffset = random.uniform(-0.4, 0.4);
  }
  if (random.chance(0.2))
  {
    scene.focusOffset = random.uniform(-1, 1) * seen.depth;
  }
  static_cast<void>(random.chance(0.2)); // what follows is that of the scenes in accuracy.md
  scene.gradedFilter = { 0, random.uniform(0, 1), random.uniform(0, 1), 1 };
  if (random.chance(0.2) && !(view.viewAngle > 0))
  {
    scene.source.distance = random.uniform(2, 20) * (seen.depth + height);
  }
  if (random.chance(0.2))
  {
    scene.source.shape = random.chance(0.5) ? SourceShape::Disc : SourceShape::Slit;
    scene.source.width = random.uniform(0, 4) * pixel / seen.depth;
    scene.source.length = random.uniform(0, 4) * pixel / seen.depth;
    const double most = 0.3;
    scene.source.width = std::min(most, scene.source.width);
    scene.source.length = std::min(most, scene.source.length);
  }
  const double floor = std::numeric_limits<double>::min() * 1e30;
  constexpr double farthest = 1e25;
  const double change = random.chance(0.15) ? random.uniform(0.6, 3) : random.logUniform(0.03, 0.6);
  scene.screenDistance = std::min(farthest, change / std::max(seen.divergence, floor));
  scene.background.distance =
    std::min(farthest, random.logUniform(0.1, 20) * pixel / std::max(seen.deflection, floor));
  const double fringes =
    random.chance(0.04) ? random.logUniform(1e3, 1e6) : random.logUniform(0.3, 100);
  scene.wavelength = std::max(floor, seen.path / fringes);
  if (random.chance(0.3))
  {
    scene.fringes.finite = true;
    scene.fringes.spacing = random.uniform(4, 20) * pixel;
    scene.fringes.angle = random.uniform(0, 180);
  }
  if (cutoff == Cutoff::NumericalSchlieren || random.chance(0.3))
  {
    const double full = cutoff == Cutoff::NumericalSchlieren ? 0.4 : 0.7;
    scene.kScale = seen.deflection > 0 ? random.uniform(0.3, 1.5) * full / seen.deflection : 1;
  }
  return scene;
}

double invisibleError(Cutoff cutoff)
{
  return cutoff == Cutoff::Interferogram || cutoff == Cutoff::Background ? 0.02 : 1. / 256;
}

} // namespace schlieren
