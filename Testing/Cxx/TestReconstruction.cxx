// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is made of values at points, in cells: smoother than what is linear along each edge.
#include "CellMeshes.h"

#include "CellSampler.h"

#include "vtkDataSetTriangleFilter.h"
#include "vtkSMPTools.h"

#include <random>

using refractivity::CellSampler;
using refractivity::CellTree;
using schlieren::Lattice;
using Reconstruction = refractivity::CellTree::Reconstruction;

namespace
{

void setN(vtkDataSet* data, const ScalarField& field)
{
  data->GetPointData()->SetScalars(addPointArray(data, "N", field));
}

/// n^3 boxes in the unit cube, each cut into five tetrahedra, their points moved at random by so many cells.
Mesh jittered(int n, double by)
{
  vtkNew<vtkDataSetTriangleFilter> toTetrahedra;
  toTetrahedra->SetInputData(cube(n + 1));
  toTetrahedra->Update();
  Mesh mesh = toTetrahedra->GetOutput();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> move(-by / n, by / n);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    Vec x;
    mesh->GetPoint(i, x.data());
    for (double& along : x)
    {
      along = (along + 1) / 2;
      const double moved = move(random);
      along += along > 1e-6 && along < 1 - 1e-6 ? moved : 0;
    }
    points->InsertNextPoint(x.data());
  }
  mesh->SetPoints(points);
  return mesh;
}

struct Errors
{
  double deflection, divergence; // rms, of the largest
};

/// Of light along z through what is interpolated in the middle of the unit cube, against that of the field itself.
Errors errorsOf(vtkDataSet* mesh, Reconstruction reconstruction, const ScalarField& field, int n)
{
  const CellTree tree({ mesh }, reconstruction);
  const CellSampler sampler(tree);
  const double h = 1. / n;
  const auto size = static_cast<std::size_t>(n);
  std::vector<double> errors(size * size, 0), truth(size * size, 0);
  std::vector<double> layer(size * size);
  std::vector<unsigned char> found(size * size);
  for (int k = 0; k < n; ++k)
  {
    const Lattice lattice = { { h / 2, h / 2, (k + 0.5) * h }, { h, h, h }, { n, n, 1 } };
    sampler.sample(lattice, layer.data(), found.data());
    for (std::size_t i = 0; i < layer.size(); ++i)
    {
      EXPECT_EQ(found[i], 1);
      const double exact = field({ (static_cast<double>(i % size) + 0.5) * h,
        (static_cast<double>(i / size) + 0.5) * h, (k + 0.5) * h });
      errors[i] += h * (layer[i] - exact);
      truth[i] += h * exact;
    }
  }
  double sums[2] = { 0, 0 }, most[2] = { 0, 0 };
  int count = 0;
  for (std::size_t j = 1; j + 1 < size; ++j)
  {
    for (std::size_t i = 1; i + 1 < size; ++i)
    {
      const std::size_t at = j * size + i;
      const auto derivatives = [&](const std::vector<double>& of)
      {
        const double right = of[at + 1], left = of[at - 1], up = of[at + size],
                     down = of[at - size];
        return std::array<double, 2>{ std::hypot(right - left, up - down) / (2 * h),
          (right + left + up + down - 4 * of[at]) / (h * h) };
      };
      const auto wrong = derivatives(errors), right = derivatives(truth);
      for (std::size_t d = 0; d < 2; ++d)
      {
        sums[d] += wrong[d] * wrong[d];
        most[d] = std::max(most[d], std::abs(right[d]));
      }
      ++count;
    }
  }
  return { std::sqrt(sums[0] / count) / most[0], std::sqrt(sums[1] / count) / most[1] };
}

} // namespace

TEST(Reconstruction, ABallOnTetrahedraIsSmooth)
{
  const auto ball = [](const Vec& x)
  {
    const double s = 0.25; // ten cells
    const Vec r = { (x[0] - 0.5) / s, (x[1] - 0.5) / s, (x[2] - 0.5) / s };
    return 3e-4 * std::exp(-dot(r, r));
  };
  const Mesh mesh = jittered(40, 0.2);
  setN(mesh, ball);
  for (const int n : { 40, 60, 80 })
  {
    const Errors linear = errorsOf(mesh, Reconstruction::Linear, ball, n);
    const Errors smooth = errorsOf(mesh, Reconstruction::Smooth, ball, n);
    printf("n %d: linear %.3g %.3g smooth %.3g %.3g\n", n, linear.deflection, linear.divergence,
      smooth.deflection, smooth.divergence);
  }
}
