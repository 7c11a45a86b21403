// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Light that is bent into an image from beside it is found by a coarse look, however far away the screen is.
#include "Fields.h"

#include <cmath>

namespace schlieren
{

namespace
{

struct Flow
{
  const char* name;
  std::function<double(double, double, double)> refractivity;
  double screenDistance; ///< moves light by some pixels, less than the widest margin
};

/// All of them reach beyond the image, which is 2 wide.
std::vector<Flow> flows()
{
  constexpr double twoPixels = 0.0625;
  const auto sheet = [](double across) { return 1e-4 * std::exp(-across * across); };
  return {
    { "lens", [](double x, double y, double) { return 2e-3 * std::exp(-x * x - y * y); }, 60 },
    { "sheet along a column",
      [=](double x, double, double) { return sheet((x - 0.95) / twoPixels); }, 60 },
    { "sheet along a row", [=](double, double y, double) { return sheet((y + 0.97) / twoPixels); },
      60 },
    { "oblique sheet",
      [=](double x, double y, double) { return sheet((x - 0.9 * y + 0.2) / twoPixels); }, 45 },
    { "waves",
      [](double x, double y, double z)
      { return 3e-4 * std::sin(9 * x + 4 * z) * std::cos(11 * y - 2 * z); },
      150 },
  };
}

class MovedLightOnDevice : public OnDevice
{
};

/// Against an image with as much around it as there can be of a margin, and a margin of its own.
TEST_P(MovedLightOnDevice, ComesFromBesideTheImage)
{
  constexpr int size = 64, around = 16;
  for (const Flow& flow : flows())
  {
    SampledField<double> field(cube(145, 2.25), flow.refractivity);
    field.field.ambient = 0;
    for (const double source : { 0., 200. })
    {
      for (const double part : { 0.3, 1. })
      {
        SCOPED_TRACE(testing::Message() << flow.name << ", source " << source << ", part " << part);
        Scene scene;
        scene.device = GetParam();
        scene.cutoff = Cutoff::Shadowgraph;
        scene.screenDistance = part * flow.screenDistance;
        scene.samplesPerPixel = 1;
        if (source > 0)
        {
          scene.source.distance = source;
        }
        scene.view.focalPoint = Vector{ 0, 0, 0 };
        scene.view.width = scene.view.height = size;
        scene.view.parallelScale = 1;
        const Image image = Bench().render(field.field, scene);
        scene.view.width = scene.view.height = size + 2 * around;
        scene.view.parallelScale = static_cast<double>(size + 2 * around) / size;
        const Image wide = Bench().render(field.field, scene);
        double moved = 0, worst = 0;
        for (int row = 0; row < size; ++row)
        {
          for (int column = 0; column < size; ++column)
          {
            const std::size_t here = pixelOf(image, column, row);
            const std::size_t there = pixelOf(wide, column + around, row + around);
            worst = std::max(
              worst, static_cast<double>(std::abs(image.intensity[here] - wide.intensity[there])));
            moved = std::max(moved,
              std::abs(static_cast<double>(image.deflection[2 * here])) * *scene.screenDistance /
                image.frame.pixelSize);
            moved = std::max(moved,
              std::abs(static_cast<double>(image.deflection[2 * here + 1])) *
                *scene.screenDistance / image.frame.pixelSize);
          }
        }
        EXPECT_GT(moved, 1); // or else nothing could be missed
        EXPECT_LT(moved, around);
        // Of diverging light, which in the wider image has steeper rays, steps are others, too.
        EXPECT_LT(worst, source > 0 ? 1e-3 : 1e-5);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, MovedLightOnDevice, bothDevices(), deviceName);

} // namespace

} // namespace schlieren
