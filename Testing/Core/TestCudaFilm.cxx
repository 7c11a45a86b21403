// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The same rays make the same picture on host and device.
#include "Fields.h"
#include "Film/CudaFilm.h"
#include "Optics/Cutoffs.h"

#include <random>

namespace schlieren
{

namespace
{

constexpr int width = 301, height = 203; // whole blocks of threads do not fit
constexpr std::int64_t heldMargin = 5; // more than is used
constexpr std::int64_t margin = 3;
constexpr Projection projection{ -0.7, 1 / 0.013 };

/// Rays of all fates, some far off the film, some at its edges, some strange.
std::vector<RayExit> anyExits(const Pass& pass, std::mt19937& random)
{
  std::uniform_real_distribution<double> unit(-1, 1);
  std::uniform_int_distribution<int> fate(0, 9);
  std::vector<RayExit> exits;
  for (std::int64_t ray = 0; ray < pass.columns * pass.rows; ++ray)
  {
    RayExit exit{};
    exit.fate = static_cast<RayFate>(std::min(fate(random), 4));
    exit.steps = static_cast<std::int32_t>(1e9 * std::abs(unit(random)));
    for (int axis = 0; axis < 2; ++axis)
    {
      exit.deflection[axis] = 0.05 * std::pow(unit(random), 5);
      exit.displacement[axis] = 0.02 * unit(random);
    }
    exit.opticalPathDifference = unit(random);
    exits.push_back(exit);
  }
  exits[1].displacement[0] = 1e300;
  exits[2].displacement[1] = std::nan("");
  exits[3].deflection[0] = 1;
  exits[4].deflection[0] = -1;
  exits[4].deflection[1] = 1;
  return exits;
}

template <class CutoffKind>
void expectSamePictures(const CutoffKind& cutoff)
{
  constexpr int passes = 5;
  Film film(width, height, std::int64_t{ passes } * (width + 2 * margin) * (height + 2 * margin));
  PixelMeans means(std::size_t{ width } * height);
  RayCounts counts;
  CudaFilm onDevice(film);

  std::mt19937 random(5);
  Pass pass{ -heldMargin, -heldMargin, width + 2 * heldMargin, height + 2 * heldMargin, {} };
  for (int number = 0; number < passes; ++number)
  {
    pass.offset = { 0.1 * number, -0.07 * number };
    const std::vector<RayExit> exits = anyExits(pass, random);
    onDevice.shade(cutoff, projection, CudaPass(exits), pass, margin);
    for (std::int64_t row = -margin; row < height + margin; ++row)
    {
      for (std::int64_t column = -margin; column < width + margin; ++column)
      {
        const std::int64_t ray = (row - pass.firstRow) * pass.columns + column - pass.firstColumn;
        const RayExit& exit = exits[static_cast<std::size_t>(ray)];
        counts.add(exit);
        if (column >= 0 && column < width && row >= 0 && row < height)
        {
          means.add(static_cast<std::size_t>(row * width + column), exit);
        }
        if (exit.reachesFilm())
        {
          const Landing at = landingOf(exit, pass.columnOf(ray), pass.rowOf(ray), projection);
          film.splat(at.column, at.row, cutoff.transmission(exit.deflection));
        }
      }
    }
  }

  Film filmOfDevice(
    width, height, std::int64_t{ passes } * (width + 2 * margin) * (height + 2 * margin));
  PixelMeans meansOfDevice(std::size_t{ width } * height);
  const RayCounts countsOfDevice = onDevice.develop(filmOfDevice, meansOfDevice);
  EXPECT_EQ(film.light(), filmOfDevice.light());
  Image host, device;
  means.develop(host);
  meansOfDevice.develop(device);
  EXPECT_EQ(host.deflection, device.deflection);
  EXPECT_EQ(host.opticalPathDifference, device.opticalPathDifference);
  EXPECT_EQ(host.blockedFraction, device.blockedFraction);
  for (std::size_t n = 0; n < host.displacement.size(); ++n)
  {
    const bool areBothNan = host.displacement[n] != host.displacement[n] &&
      device.displacement[n] != device.displacement[n];
    EXPECT_TRUE(areBothNan || host.displacement[n] == device.displacement[n]);
  }
  EXPECT_EQ(counts.crossed, countsOfDevice.crossed);
  EXPECT_EQ(counts.steps, countsOfDevice.steps);
  EXPECT_EQ(counts.blocked, countsOfDevice.blocked);
  EXPECT_EQ(counts.lost, countsOfDevice.lost);
}

TEST(HostAndDevice, MakeTheSamePictureOfTheSameRays)
{
  std::string reason;
  if (!cudaAvailable(&reason))
  {
    GTEST_SKIP() << "no CUDA device: " << reason;
  }
  expectSamePictures(KnifeEdge::at(30, 300, false));
  expectSamePictures(KnifeEdge::at(90, 20, true));
  expectSamePictures(Shadowgraph{});
}

TEST(HostAndDevice, RaysComeBackAsTheyWereSent)
{
  std::string reason;
  if (!cudaAvailable(&reason))
  {
    GTEST_SKIP() << "no CUDA device: " << reason;
  }
  std::vector<RayExit> exits(1000);
  for (std::size_t ray = 0; ray < exits.size(); ++ray)
  {
    exits[ray].opticalPathDifference = static_cast<double>(ray);
  }
  const std::vector<RayExit> back = CudaPass(exits).toHost();
  ASSERT_EQ(back.size(), exits.size());
  for (std::size_t ray = 0; ray < exits.size(); ++ray)
  {
    EXPECT_EQ(back[ray].opticalPathDifference, exits[ray].opticalPathDifference);
  }
}

} // namespace

} // namespace schlieren
