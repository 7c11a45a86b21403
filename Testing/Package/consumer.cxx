// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// A refractivity that grows along x by 1e-5 for each unit bends light that crosses 2 units of it along z by 2e-5.
#include <Schlieren.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <vector>

int main()
{
  constexpr int points = 33;
  constexpr double slope = 1e-5, depth = 2;
  std::vector<float> samples;
  for (int k = 0; k < points; ++k)
  {
    for (int j = 0; j < points; ++j)
    {
      for (int i = 0; i < points; ++i)
      {
        samples.push_back(static_cast<float>(slope * depth * i / (points - 1)));
      }
    }
  }
  schlieren::Field field;
  field.grid.dimensions = { points, points, points };
  field.grid.spacing = { depth / (points - 1), depth / (points - 1), depth / (points - 1) };
  field.singles = samples.data();

  schlieren::Scene scene;
  scene.device = schlieren::Device::Cpu;
  scene.view.width = 8;
  scene.view.height = 8;
  scene.view.parallelScale = 0.5;

  const schlieren::Image image = schlieren::Bench().render(field, scene);
  double worst = image.deflection.size() == 2 * 8 * 8 ? 0 : 1;
  for (std::size_t pixel = 0; 2 * pixel < image.deflection.size(); ++pixel)
  {
    worst = std::max(worst, std::abs(image.deflection[2 * pixel] / (slope * depth) - 1));
  }
  std::printf("Schlieren %s: the deflection is right to %.1e\n", schlieren::version(), worst);
  return worst < 1e-3 && std::strcmp(schlieren::version(), PACKAGE_VERSION) == 0 ? 0 : 1;
}
