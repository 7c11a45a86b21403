// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Fixtures.h"

#include "vtkAMRBox.h"
#include "vtkAMRGaussianPulseSource.h"
#include "vtkAMRUtilities.h"
#include "vtkOverlappingAMR.h"
#include "vtkStructuredData.h"
#include "vtkUniformGrid.h"
#include "vtkUniformGridAMR.h"
#include "vtkVersion.h"

#include <array>

/// A ball A exp(-r^2/s^2) around the origin.
struct GaussianBall
{
  double A = 2.7e-4;
  double s = 0.3;

  double operator()(const Vec& x) const
  {
    return this->A * std::exp(-dot(x, x) / (this->s * this->s));
  }
};

/// Its mean over a cube of edge h, which is what finite volumes hold.
struct MeanOfBall
{
  GaussianBall ball;
  double h;

  double operator()(const Vec& x) const
  {
    double mean = this->ball.A;
    for (const double c : x)
    {
      mean *= std::sqrt(pi) / 2 * this->ball.s / this->h *
        (std::erf((c + this->h / 2) / this->ball.s) - std::erf((c - this->h / 2) / this->ball.s));
    }
    return mean;
  }
};

/// VTK 9.6 deprecates the names that earlier versions have for these.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
inline void initialize(vtkUniformGridAMR* amr, const std::vector<unsigned int>& blocks)
{
  amr->Initialize(blocks);
}
inline vtkImageData* blockOf(vtkUniformGridAMR* amr, unsigned int level, unsigned int i)
{
  return amr->GetDataSetAsImageData(level, i);
}
inline unsigned int blocksOf(vtkUniformGridAMR* amr, unsigned int level)
{
  return amr->GetNumberOfBlocks(level);
}
constexpr int xyzGrid = vtkStructuredData::VTK_STRUCTURED_XYZ_GRID;
#else
inline void initialize(vtkUniformGridAMR* amr, const std::vector<unsigned int>& blocks)
{
  const std::vector<int> counts(blocks.begin(), blocks.end());
  amr->Initialize(static_cast<int>(counts.size()), counts.data());
}
inline vtkUniformGrid* blockOf(vtkUniformGridAMR* amr, unsigned int level, unsigned int i)
{
  return amr->GetDataSet(level, i);
}
inline unsigned int blocksOf(vtkUniformGridAMR* amr, unsigned int level)
{
  return amr->GetNumberOfDataSets(level);
}
constexpr int xyzGrid = VTK_XYZ_GRID;
#endif

/// A region of a level, in cells of that level, as one block or as eight.
struct AmrRegion
{
  int first, count;
  bool inEight = false;
};

inline vtkSmartPointer<vtkUniformGrid> amrBlock(
  const int first[3], int cells, double h, const GaussianBall& ball = GaussianBall())
{
  auto grid = vtkSmartPointer<vtkUniformGrid>::New();
  grid->SetDimensions(cells + 1, cells + 1, cells + 1);
  grid->SetSpacing(h, h, h);
  grid->SetOrigin(-1 + first[0] * h, -1 + first[1] * h, -1 + first[2] * h);
  addCellArray(grid, "N", MeanOfBall{ ball, h });
  return grid;
}

/// The ball in the cube from -1 to 1: `cells` of the coarsest level along each edge, half the size on every
/// further level. Cells under finer ones are marked, and hold nonsense.
inline vtkSmartPointer<vtkOverlappingAMR> ballOnLevels(
  int cells, const std::vector<AmrRegion>& regions, const GaussianBall& ball = GaussianBall())
{
  auto amr = vtkSmartPointer<vtkOverlappingAMR>::New();
  std::vector<unsigned int> blocks;
  for (const AmrRegion& region : regions)
  {
    blocks.push_back(region.inEight ? 8u : 1u);
  }
  initialize(amr, blocks);
  amr->SetGridDescription(xyzGrid);
  const double origin[3] = { -1, -1, -1 };
  amr->SetOrigin(origin);
  for (unsigned int level = 0; level < regions.size(); ++level)
  {
    const double h = 2. / cells / (1 << level);
    const double spacing[3] = { h, h, h };
    amr->SetSpacing(level, spacing);
    amr->SetRefinementRatio(level, 2);
    const AmrRegion& region = regions[level];
    const int edge = region.inEight ? region.count / 2 : region.count;
    for (unsigned int i = 0; i < (region.inEight ? 8u : 1u); ++i)
    {
      const int first[3] = { region.first + static_cast<int>(i & 1) * edge,
        region.first + static_cast<int>(i >> 1 & 1) * edge,
        region.first + static_cast<int>(i >> 2) * edge };
      auto grid = amrBlock(first, edge, h, ball);
      amr->SetAMRBox(
        level, i, vtkAMRBox(grid->GetOrigin(), grid->GetDimensions(), spacing, origin));
      amr->SetDataSet(level, i, grid);
    }
  }
  vtkAMRUtilities::BlankCells(amr);
  for (unsigned int level = 0; level + 1 < regions.size(); ++level)
  {
    for (unsigned int i = 0; i < blocksOf(amr, level); ++i)
    {
      vtkImageData* grid = blockOf(amr, level, i);
      vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray();
      for (vtkIdType cell = 0; ghosts && cell < grid->GetNumberOfCells(); ++cell)
      {
        if (ghosts->GetValue(cell) & vtkDataSetAttributes::REFINEDCELL)
        {
          grid->GetCellData()->GetArray("N")->SetComponent(cell, 0, -7);
        }
      }
    }
  }
  return amr;
}

/// A bench for VTK's own adaptive mesh, which has values of 1e-4 at most: 5 x 5 x 5 cells of edge 0.5, of which
/// two blocks are refined once.
inline vtkSmartPointer<vtkSchlierenFilter> benchOfPulse(
  const std::array<double, 3>& centre, double width, int pixels)
{
  vtkNew<vtkAMRGaussianPulseSource> source;
  source->SetDimension(3);
  source->SetPulseAmplitude(1e-4);
  source->SetPulseOrigin(centre[0], centre[1], centre[2]);
  source->SetPulseWidth(width, width, width);
  source->Update();
  vtkNew<vtkOverlappingAMR> amr;
  amr->ShallowCopy(source->GetOutputDataObject(0));
  auto filter = bench(amr, pixels);
  filter->SetInputArrayToProcess(vtkRefractiveIndex::INDEX_ARRAY, 0, 0,
    vtkDataObject::FIELD_ASSOCIATION_CELLS, "Gaussian-Pulse");
  return filter;
}
