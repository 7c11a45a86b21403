// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The same rays make the same image on host and device.
#include "Bench/CutoffMaker.h"
#include "Bench/StageSettings.h"
#include "Fields.h"
#include "Film/CentreValues.h"
#include "Film/CudaFilm.h"
#include "Film/Development.h"
#include "Optics/AutomaticK.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

namespace schlieren
{

namespace
{

using HostAndDeviceFilm = WithCuda;

constexpr int width = 151, height = 103; // whole blocks of threads do not fit
constexpr std::int64_t heldMargin = 5;   // more than is used
constexpr std::int64_t margin = 3;
constexpr Projection projection{ -0.7, 1 / 0.013, 1 };

/// Rays of all fates, some of them far off the film or strange (in the margin that is not used for means).
RayExits anyExits(const Pass& pass, std::mt19937& random)
{
  std::uniform_real_distribution<double> unit(-1, 1);
  std::uniform_int_distribution<int> fate(0, 9);
  RayExits exits;
  for (std::int64_t ray = 0; ray < pass.columns * pass.rows; ++ray)
  {
    RayExit exit{};
    exit.fate = static_cast<RayFate>(std::min(fate(random), 4));
    exit.steps = static_cast<std::int32_t>(1e9 * std::abs(unit(random)));
    for (int axis = 0; axis < 2; ++axis)
    {
      exit.deflection[axis] = 0.05 * std::pow(unit(random), 5);
      exit.displacement[axis] = static_cast<float>(0.02 * unit(random));
    }
    exit.opticalPathDifference = unit(random);
    exits.push_back(exit);
  }
  RayExit* strange = exits.data() + (heldMargin - 1) * pass.columns + heldMargin;
  strange[1].displacement[0] = 1e38f;
  strange[2].displacement[1] = std::nanf("");
  strange[3].deflection[0] = 1;
  strange[4].deflection[1] = -1.5;
  return exits;
}

/// Rays through many small lenses and past a body: cells are bent and folded, within the film and across its border.
RayExits lensExits(const Pass& pass, std::mt19937&)
{
  RayExits exits;
  for (std::int64_t ray = 0; ray < pass.columns * pass.rows; ++ray)
  {
    RayExit exit{};
    const double x = pass.columnOf(ray), y = pass.rowOf(ray);
    exit.fate = std::hypot(x - 40, y - 30) < 9 ? RayFate::Blocked : RayFate::Left;
    exit.steps = 3;
    exit.deflection[0] = 0.09 * std::sin(0.2 * x + 0.1 * y);
    exit.deflection[1] = 0.09 * std::cos(0.25 * y - 0.05 * x);
    exit.opticalPathDifference = 1e-6 * std::sin(0.1 * x);
    exits.push_back(exit);
  }
  return exits;
}

void expectSameImages(const Cutoffs& cutoff, std::int64_t raysPerBand = std::int64_t{ 1 } << 20,
  decltype(anyExits)* exitsOf = anyExits)
{
  constexpr int passes = 3;
  constexpr std::int64_t rays = passes * (width + 2 * margin) * (height + 2 * margin);
  std::mt19937 random(5);
  std::vector<RayExits> exits;
  std::vector<TracedRays> traced;
  Films films(channelsOf(cutoff), width, height, rays);
  Films filmsOfDevice = Films(channelsOf(cutoff), width, height, rays);
  CudaFilm onDevice(films, raysPerBand);
  for (int number = 0; number < passes; ++number)
  {
    const Pass pass{ -heldMargin, -heldMargin, width + 2 * heldMargin, height + 2 * heldMargin,
      { 0.1 * number, -0.07 * number }, { 0, 0 }, std::ldexp(1, -number) };
    exits.push_back(exitsOf(pass, random));
    traced.push_back({ pass, exits.back().data() });
    onDevice.expose(CudaPass(exits.back()), pass, cutoff, projection, margin);
  }
  const RayCounts counts = expose(traced, cutoff, projection, margin, 1, films);
  const RayCounts countsOfDevice = onDevice.develop(filmsOfDevice);

  for (std::size_t plane = 0; plane < films.planes.size(); ++plane)
  {
    const Film& film = films.planes[plane];
    EXPECT_EQ(film.light(), filmsOfDevice.planes[plane].light());
    EXPECT_EQ(film.sums().emitted, filmsOfDevice.planes[plane].sums().emitted);
    EXPECT_EQ(film.sums().outside, filmsOfDevice.planes[plane].sums().outside);
    EXPECT_GT(*std::max_element(film.light().begin(), film.light().end()), 0);
  }
  Image host, device;
  CentreValues(width, height, 1).develop(traced, host);
  onDevice.developCentres(device);
  EXPECT_EQ(host.deflection, device.deflection);
  EXPECT_EQ(host.displacement, device.displacement);
  EXPECT_EQ(host.opticalPathDifference, device.opticalPathDifference);
  EXPECT_EQ(host.blockedFraction, device.blockedFraction);
  EXPECT_EQ(counts.crossed, countsOfDevice.crossed);
  EXPECT_EQ(counts.steps, countsOfDevice.steps);
  EXPECT_EQ(counts.blocked, countsOfDevice.blocked);
  EXPECT_EQ(counts.lost, countsOfDevice.lost);
  EXPECT_EQ(counts.shaded, countsOfDevice.shaded);
  EXPECT_EQ(counts.saturated, countsOfDevice.saturated);
}

TEST_F(HostAndDeviceFilm, IsTheSameOfTheSameRays)
{
  expectSameImages(KnifeEdge::at(30, 300));
  expectSameImages(KnifeEdge::at(270, 20));
  expectSameImages(Shadowgraph{});
}

/// Most cells are added by bentKernel, and there are more of them than it has threads.
TEST_F(HostAndDeviceFilm, IsTheSameOfBentCells)
{
  for (const std::int64_t raysPerBand : { std::int64_t{ 1 }, std::int64_t{ 1 } << 20 })
  {
    expectSameImages(KnifeEdge::at(30, 10), raysPerBand, lensExits);
  }
  const std::array<float, 12> pixels{ 0.1f, 0.2f, 0.3f, 0.9f, 0, 1, 0.5f, 0.6f, 0, 1, 1, 0.2f };
  expectSameImages(
    ColorImage{ 10, 2, 2, { pixels.data(), pixels.size() } }, std::int64_t{ 1 } << 20, lensExits);
}

/// Of 16 rows each, of 20, and of all but the last one.
TEST_F(HostAndDeviceFilm, IsTheSameInBands)
{
  constexpr std::int64_t columns = width + 2 * margin, rows = height + 2 * margin;
  for (const std::int64_t raysPerBand :
    { std::int64_t{ 1 }, 20 * columns + 1, (rows - 1) * columns })
  {
    expectSameImages(KnifeEdge::at(30, 300), raysPerBand);
  }
}

TEST_F(HostAndDeviceFilm, IsTheSameForEveryCutoff)
{
  Scene scene;
  scene.view.width = width;
  scene.view.height = height;
  scene.fringes.spacing = 0.1;
  const auto image =
    std::make_shared<RgbImage>(RgbImage{ 2, 2, { 1, 2, 3, 40, 50, 60, 70, 80, 90, 255, 0, 200 } });
  CutoffMaker maker;
  std::set<std::size_t> kinds;
  const auto check = [&]
  {
    const Cutoffs cutoff = maker.cutoffOf(scene, 300, { 0.013 });
    kinds.insert(cutoff.index());
    SCOPED_TRACE(cutoff.index());
    expectSameImages(cutoff);
  };
  for (const Cutoff cutoff : { Cutoff::Shadowgraph, Cutoff::BrightField, Cutoff::DarkField,
         Cutoff::GradedFilter, Cutoff::NumericalSchlieren })
  {
    scene.cutoff = cutoff;
    check();
  }
  scene.cutoff = Cutoff::KnifeEdge;
  for (const SourceShape shape : { SourceShape::Slit, SourceShape::Disc })
  {
    scene.source.shape = shape;
    check();
  }
  scene.cutoff = Cutoff::ColorFilter;
  check();
  scene.colorFilter = image;
  check();
  scene.cutoff = Cutoff::Interferogram;
  check();
  scene.cutoff = Cutoff::Background;
  scene.background.image = image;
  for (const PatternKind kind : { PatternKind::Dots, PatternKind::Stripes, PatternKind::Image })
  {
    scene.background.kind = kind;
    check();
  }
  EXPECT_EQ(kinds.size(), std::variant_size_v<Cutoffs>);
}

TEST_F(HostAndDeviceFilm, ShowsTheSameWithoutTheFlow)
{
  Scene scene;
  scene.view.width = width;
  scene.view.height = height;
  scene.cutoff = Cutoff::Background;
  CutoffMaker maker;
  constexpr std::int64_t passes = 2,
                         maxRays = passes * (width + 2 * margin) * (height + 2 * margin);
  const Exposure exposure{ maker.cutoffOf(scene, 0, { 0.013 }), projection, margin, maxRays };
  const FilmSettings settings = filmSettingsOf(scene);
  UndisturbedImage onHost(settings, exposure), onDevice(settings, exposure);
  while (onHost.passes() < passes)
  {
    onHost.addPass(Device::Cpu, {});
    onDevice.addPass(Device::Cuda, {});
  }
  const PixelArray<float> light = onHost.develop();
  EXPECT_EQ(light, onDevice.develop());
  EXPECT_GT(*std::max_element(light.begin(), light.end()), 0.5f);
}

TEST_F(HostAndDeviceFilm, FindsTheSameStrongDeflection)
{
  const Pass pass{ -heldMargin, -heldMargin, width + 2 * heldMargin, height + 2 * heldMargin,
    { 0, 0 } };
  std::mt19937 random(11);
  RayExits exits = anyExits(pass, random);
  const auto expectTheSame = [&]
  {
    const double onHost = strongDeflection({ pass, exits.data() }, width, height, {}, 2);
    EXPECT_EQ(onHost, strongDeflection(CudaPass(exits), pass, width, height, {}));
    return onHost;
  };
  const double strong = expectTheSame();
  EXPECT_GT(strong, 0.01);
  EXPECT_LT(strong, 0.07);
  for (std::size_t ray = 0; ray < exits.size(); ++ray) // most light is not bent at all
  {
    if (ray % 200 != 0)
    {
      exits[ray].deflection[0] = exits[ray].deflection[1] = 0;
    }
  }
  EXPECT_GT(expectTheSame(), 0.01); // the largest
  for (RayExit& exit : exits)
  {
    exit.fate = RayFate::Missed;
  }
  EXPECT_EQ(expectTheSame(), 0);
}

TEST_F(HostAndDeviceFilm, GetsRaysAsTheyWereSent)
{
  RayExits exits(1000, RayExit{});
  for (std::size_t ray = 0; ray < exits.size(); ++ray)
  {
    exits[ray].opticalPathDifference = static_cast<double>(ray);
  }
  const RayExits back = CudaPass(exits).toHost();
  ASSERT_EQ(back.size(), exits.size());
  for (std::size_t ray = 0; ray < exits.size(); ++ray)
  {
    EXPECT_EQ(back[ray].opticalPathDifference, exits[ray].opticalPathDifference);
  }
}

} // namespace

} // namespace schlieren
