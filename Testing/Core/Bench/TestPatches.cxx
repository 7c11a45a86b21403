// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Where an image is looked at to find its error.
#include "Bench/Patches.h"
#include "Bench/StageSettings.h"
#include "Bench/ViewSetup.h"
#include "Fields.h"
#include "Medium/Medium.h"
#include "Rays/March/MakeTask.h"

#include <algorithm>
#include <cmath>

namespace schlieren
{

namespace
{

PatchLayout layoutOf(const Field& field, const Scene& scene)
{
  MediumOnDevices<float> medium(buildMedium<float>(field, Interpolation::Quadratic, 1));
  const Frame frame = frameOf(field.grid, scene.view);
  const Light light = lightOf(scene, field.grid, frame, exitFacesOf(scene, 0, 1));
  const RaySettings settings = settingsOf(scene, 1, 0);
  const RayTask<float> task = makeTask(medium.medium, light, settings);
  const Tracer<float> tracer(medium, Device::Cpu, nullptr, 1);
  const ViewSetup<float> setup{ medium, tracer, {}, light, settings, task, 1, 0, 0, {},
    projectionOf(scene, frame, light, 0), {} };
  return layOutPatches(Scouts(task, setup, scene), scene.view, setup.margin);
}

/// Leaves of a medium that are too coarse are seen in their errors, a leaf's width in the image.
TEST(Patches, WithFinerVoxelsAreInNearlyAllPartsOfTheImage)
{
  const SampledField<double> field(cube(33, 1),
    [](double x, double y, double z) { return 1e-5 * std::exp(-6 * (x * x + y * y + z * z)); });
  Scene scene;
  scene.view.viewDirection = { 0, 0, -1 };
  scene.view.parallelScale = 1; // nothing beside the data
  constexpr int pixels = 128, part = 32;
  scene.view.width = scene.view.height = pixels;
  const PatchLayout layout = layoutOf(field.field, scene);
  ASSERT_FALSE(layout.isWhole);
  int parts = 0, missed = 0;
  for (int row = 0; row + part <= pixels; row += Patch::edge)
  {
    for (int column = 0; column + part <= pixels; column += Patch::edge)
    {
      const auto isIn = [&](const Patch& patch)
      {
        return patch.column >= column && patch.column < column + part && patch.row >= row &&
          patch.row < row + part;
      };
      const bool isSeen = std::any_of(layout.ofVoxels.begin(), layout.ofVoxels.end(),
        [&](const PatchList& list) { return std::any_of(list.begin(), list.end(), isIn); });
      ++parts;
      missed += isSeen ? 0 : 1;
    }
  }
  EXPECT_LT(missed, 0.1 * parts);
}

} // namespace

} // namespace schlieren
