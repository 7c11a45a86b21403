// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshKey.h"

#include "InputDescription.h"

#include "vtkCellArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace refractivity
{

namespace
{

/// Adds the hashes of parts of fixed size, made by hashPart(first, last, hash) in any order.
template <class HashPart>
void addParts(Hash& hash, vtkIdType count, const HashPart& hashPart)
{
  constexpr vtkIdType size = 1 << 15;
  std::vector<Hash> parts(static_cast<std::size_t>((count + size - 1) / size));
  vtkSMPTools::For(0, static_cast<vtkIdType>(parts.size()), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType part = begin; part < end; ++part)
      {
        hashPart(
          part * size, std::min(count, (part + 1) * size), parts[static_cast<std::size_t>(part)]);
      }
    });
  hash.add(static_cast<std::uint64_t>(count));
  for (const Hash& part : parts)
  {
    hash.add(part.value());
  }
}

void addPoints(Hash& hash, vtkDataSet* data)
{
  addParts(hash, data->GetNumberOfPoints(),
    [data](vtkIdType first, vtkIdType last, Hash& part)
    {
      double x[3];
      for (vtkIdType i = first; i < last; ++i)
      {
        data->GetPoint(i, x);
        part.add(x, 3);
      }
    });
}

void addIds(Hash& hash, const vtkIdType* ids, vtkIdType count)
{
  for (vtkIdType i = 0; i < count; ++i)
  {
    hash.add(static_cast<std::uint64_t>(ids[i]));
  }
}

} // namespace

void addMesh(Hash& hash, vtkDataSet* data)
{
  hash.add(static_cast<std::uint64_t>(data->GetDataObjectType()));
  addPoints(hash, data);
  vtkUnsignedCharArray* ghosts = data->GetCellGhostArray();
  const auto hashCells = [data, ghosts](vtkIdType first, vtkIdType last, Hash& part)
  {
    vtkNew<vtkIdList> storage;
    for (vtkIdType i = first; i < last; ++i)
    {
      vtkIdType count;
      const vtkIdType* points;
      data->GetCellPoints(i, count, points, storage);
      const unsigned char ghost = ghosts ? ghosts->GetValue(i) : 0;
      part.add(static_cast<std::uint64_t>(count) << 16 | static_cast<std::uint64_t>(ghost) << 8 |
        static_cast<std::uint64_t>(data->GetCellType(i)));
      addIds(part, points, count);
    }
  };
  if (data->GetNumberOfCells() > 0)
  {
    Hash first;
    hashCells(0, 1, first); // VTK makes what it needs on the first call, which one thread has to do
  }
  addParts(hash, data->GetNumberOfCells(), hashCells);
}

void addGas(Hash& hash, vtkDataSet* data)
{
  const double* values =
    vtkDoubleArray::SafeDownCast(data->GetPointData()->GetScalars())->GetPointer(0);
  addParts(hash, data->GetNumberOfPoints(),
    [values](vtkIdType first, vtkIdType last, Hash& part)
    {
      std::uint64_t bits = 0;
      for (vtkIdType i = first; i < last; ++i)
      {
        bits = bits << 1 | (std::isfinite(values[i]) ? 1 : 0);
        if ((i + 1 - first) % 64 == 0 || i + 1 == last)
        {
          part.add(bits);
          bits = 0;
        }
      }
    });
}

void addBodies(Hash& hash, vtkDataObject* bodies)
{
  for (vtkDataObject* leaf : leavesOf(bodies))
  {
    auto* data = vtkPolyData::SafeDownCast(leaf);
    hash.add(data ? 1 : 0);
    if (!data)
    {
      continue;
    }
    addPoints(hash, data);
    for (vtkCellArray* cells : { data->GetPolys(), data->GetStrips() })
    {
      addParts(hash, cells->GetNumberOfCells(),
        [cells](vtkIdType first, vtkIdType last, Hash& part)
        {
          vtkNew<vtkIdList> points;
          for (vtkIdType i = first; i < last; ++i)
          {
            cells->GetCellAtId(i, points);
            part.add(static_cast<std::uint64_t>(points->GetNumberOfIds()));
            addIds(part, points->GetPointer(0), points->GetNumberOfIds());
          }
        });
    }
  }
}

} // namespace refractivity
