// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Data of all kinds that may stay on several ranks, whole and in pieces, with a field that tints.
#pragma once

#include "Pieces.h"

#include "vtkAppendFilter.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkSphereSource.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

using Extent = std::array<int, 6>;

inline constexpr Extent allCells{ 0, 24, 0, 20, 0, 20 };

/// Its range is not that of any part.
inline double warmth(const Vec& x) { return std::sin(2 * x[0]) + 0.3 * x[1] * x[2]; }

inline vtkSmartPointer<vtkImageData> imageOf(const Extent& extent)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(extent[0], extent[1], extent[2], extent[3], extent[4], extent[5]);
  image->SetSpacing(0.09, 0.1, 0.1);
  image->SetOrigin(-1.2, -1, -1);
  addPointArray(image, "N", ball);
  addPointArray(image, "warmth", warmth);
  addCellArray(image, "N of cells", ball);
  addCellArray(image, "warmth of cells", warmth);
  return image;
}

inline Data meshOf(const Extent& extent)
{
  vtkNew<vtkAppendFilter> append;
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  append->AddInputData(imageOf(extent));
  append->Update();
  return append->GetOutput();
}

/// Some of several blocks.
inline Data blocksOf(const std::vector<Extent>& extents, std::size_t first, std::size_t count)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  blocks->SetNumberOfBlocks(static_cast<unsigned>(extents.size()));
  for (std::size_t n = first; n < first + count; ++n)
  {
    blocks->SetBlock(static_cast<unsigned>(n), imageOf(extents[n]));
  }
  return blocks;
}

inline void askForFields(vtkRefractiveIndex* filter, const std::vector<const char*>& fields)
{
  filter->ClearFields();
  for (const char* field : fields)
  {
    filter->AddField(field);
  }
}

struct PieceCase
{
  const char* name;
  Data whole;
  std::vector<Data> parts;
  bool ofCells;
  vtkSmartPointer<vtkDataObject> bodies;
};

inline std::vector<PieceCase> cases()
{
  const std::vector<Extent> extents{ { 0, 9, 0, 20, 0, 20 }, { 9, 13, 0, 20, 0, 20 },
    { 13, 24, 0, 20, 0, 20 } };
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.3);
  sphere->SetCenter(0.5, 0.2, 0);
  sphere->Update();
  std::vector<PieceCase> found{ { "mesh", meshOf(allCells), {}, false, nullptr },
    { "mesh of cells", meshOf(allCells), {}, true, nullptr },
    { "image", imageOf(allCells), {}, false, sphere->GetOutput() },
    { "blocks", blocksOf(extents, 0, 3), {}, true, nullptr },
    { "scattered blocks", {}, {}, true, nullptr } };
  for (std::size_t n = 0; n < extents.size(); ++n)
  {
    found[0].parts.push_back(meshOf(extents[n]));
    found[1].parts.push_back(meshOf(extents[n]));
    found[2].parts.push_back(imageOf(extents[n]));
    found[3].parts.push_back(blocksOf(extents, n, 1));
  }
  std::array<std::vector<Extent>, 3> scattered; // of two ranks, and of both
  for (int n = 0; n < 64; ++n)
  {
    const int x = n % 4 * 6, y = n / 4 % 4 * 5, z = n / 16 * 5;
    const Extent extent{ x, x + 6, y, y + 5, z, z + 5 };
    scattered[static_cast<std::size_t>((n + n / 4 + n / 16) % 2)].push_back(extent);
    scattered[2].push_back(extent);
  }
  found[4].whole = blocksOf(scattered[2], 0, 64);
  found[4].parts = { blocksOf(scattered[0], 0, 32), blocksOf(scattered[1], 0, 32) };
  for (PieceCase& one : found)
  {
    one.parts.insert(one.parts.begin() + 1, nullptr); // this rank has nothing
  }
  return found;
}
