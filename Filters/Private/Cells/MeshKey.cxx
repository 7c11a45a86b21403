// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/MeshKey.h"

#include "Common/CellTypes.h"
#include "Input/InputDescription.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace filters
{

namespace
{

/// Hashes chunks of fixed size by hashPart(first, last, hash), in parallel.
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

/// Hashes bytes in four independent sequences, which do not wait for each other.
void addBytes(Hash& hash, const void* data, std::size_t size)
{
  constexpr std::size_t word = sizeof(std::uint64_t), lanes = 4;
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::array<Hash, lanes> each;
  std::size_t at = 0;
  const auto wordAt = [&](std::size_t place, std::size_t length)
  {
    std::uint64_t bits = 0;
    std::memcpy(&bits, bytes + place, length);
    return bits;
  };
  for (; at + lanes * word <= size; at += lanes * word)
  {
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      each[lane].add(wordAt(at + lane * word, word));
    }
  }
  for (; at < size; at += word)
  {
    each[0].add(wordAt(at, std::min(word, size - at)));
  }
  for (const Hash& lane : each)
  {
    hash.add(lane.value());
  }
}

template <class Number>
bool addIfPlain(Hash& hash, vtkDataArray* array)
{
  auto* plain = vtkAOSDataArrayTemplate<Number>::FastDownCast(array);
  if (!plain)
  {
    return false;
  }
  hash.add(sizeof(Number));
  addParts(hash, plain->GetNumberOfValues(),
    [numbers = plain->GetPointer(0)](vtkIdType first, vtkIdType last, Hash& part)
    { addBytes(part, numbers + first, static_cast<std::size_t>(last - first) * sizeof(Number)); });
  return true;
}

/// Hashes the arrays of cells if these have known types. Returns whether they have.
bool addIfPlain(Hash& hash, vtkUnstructuredGrid* mesh)
{
  vtkCellArray* cells = mesh ? mesh->GetCells() : nullptr;
  vtkDataArray* types = mesh ? cellTypesOf(mesh) : nullptr;
  if (!cells || !vtkAOSDataArrayTemplate<unsigned char>::FastDownCast(types))
  {
    return false;
  }
  for (vtkDataArray* array : { cells->GetOffsetsArray(), cells->GetConnectivityArray() })
  {
    if (!addIfPlain<vtkTypeInt64>(hash, array) && !addIfPlain<vtkTypeInt32>(hash, array))
    {
      return false;
    }
  }
  return addIfPlain<unsigned char>(hash, types);
}

void addIds(Hash& hash, const vtkIdType* ids, vtkIdType count)
{
  for (vtkIdType i = 0; i < count; ++i)
  {
    hash.add(static_cast<std::uint64_t>(ids[i]));
  }
}

} // namespace

void addPoints(Hash& hash, vtkDataSet* data)
{
  auto* set = vtkPointSet::SafeDownCast(data);
  vtkDataArray* plain = set && set->GetPoints() ? set->GetPoints()->GetData() : nullptr;
  if (plain && (addIfPlain<double>(hash, plain) || addIfPlain<float>(hash, plain)))
  {
    return;
  }
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

void addCells(Hash& hash, vtkDataSet* data)
{
  if (auto* grid = vtkStructuredGrid::SafeDownCast(data))
  {
    int points[3];
    grid->GetDimensions(points);
    addBytes(hash, points, sizeof(points)); // determine the cells
    return;
  }
  if (addIfPlain(hash, vtkUnstructuredGrid::SafeDownCast(data)))
  {
    return;
  }
  const auto hashCells = [data](vtkIdType first, vtkIdType last, Hash& part)
  {
    vtkNew<vtkIdList> storage;
    for (vtkIdType i = first; i < last; ++i)
    {
      vtkIdType count;
      const vtkIdType* points;
      data->GetCellPoints(i, count, points, storage);
      part.add(
        static_cast<std::uint64_t>(count) << 8 | static_cast<std::uint64_t>(data->GetCellType(i)));
      addIds(part, points, count);
    }
  };
  if (data->GetNumberOfCells() > 0)
  {
    Hash first;
    hashCells(0, 1, first); // the first call initializes VTK's data, in one thread
  }
  addParts(hash, data->GetNumberOfCells(), hashCells);
}

void addMesh(Hash& hash, vtkDataSet* data)
{
  hash.add(static_cast<std::uint64_t>(data->GetDataObjectType()));
  addPoints(hash, data);
  if (vtkUnsignedCharArray* ghosts = data->GetCellGhostArray())
  {
    addIfPlain<unsigned char>(hash, ghosts);
  }
  addCells(hash, data);
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

} // namespace filters
