// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The datasets that a rank has of an input, and how they are sent to another one.
#pragma once

#include "vtkSmartPointer.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

class vtkDataObject;
class vtkDataSet;
class vtkIdList;
class vtkUnstructuredGrid;

namespace filters
{

/// The position of a dataset in the tree of blocks. Parts of one dataset have the same one on all ranks.
using Slot = std::vector<int>;

struct Part
{
  Slot slot;
  vtkSmartPointer<vtkDataSet> data;
};

/// The datasets of an input that have points, with those arrays of points and cells that are named and without copies of
/// other ranks' cells (but in images and grids, where they may touch).
std::vector<Part> partsOf(vtkDataObject* data, const std::vector<std::string>& arrays);

/// Some cells of a mesh, with all arrays.
vtkSmartPointer<vtkUnstructuredGrid> extractedCells(vtkUnstructuredGrid* mesh, vtkIdList* cells);

/// Adds plain values to a message.
template <class Value>
void put(const Value* values, std::size_t count, std::vector<char>& bytes)
{
  static_assert(std::is_trivially_copyable_v<Value>);
  const std::size_t at = bytes.size();
  bytes.resize(at + count * sizeof(Value));
  if (count > 0)
  {
    std::memcpy(bytes.data() + at, values, count * sizeof(Value));
  }
}
template <class Value>
void put(const Value& value, std::vector<char>& bytes)
{
  put(&value, 1, bytes);
}
/// A vector or a string, and how long it is.
template <class Values>
void putAll(const Values& values, std::vector<char>& bytes)
{
  put(static_cast<std::uint64_t>(values.size()), bytes);
  put(values.data(), values.size(), bytes);
}

/// Reads what put() has written. Throws std::runtime_error where there is less.
class Reader
{
public:
  explicit Reader(const std::vector<char>& bytes)
    : Bytes(bytes)
  {
  }

  bool IsAtEnd() const { return this->At == this->Bytes.size(); }

  template <class Value>
  void Get(Value* values, std::size_t count)
  {
    if (count > (this->Bytes.size() - this->At) / sizeof(Value))
    {
      Fail();
    }
    if (count > 0)
    {
      std::memcpy(values, this->Bytes.data() + this->At, count * sizeof(Value));
      this->At += count * sizeof(Value);
    }
  }

  template <class Value>
  Value Get()
  {
    Value value;
    this->Get(&value, 1);
    return value;
  }
  /// What putAll() has written.
  template <class Values>
  Values GetAll()
  {
    using Value = typename Values::value_type;
    const auto count = this->Get<std::uint64_t>();
    if (count > (this->Bytes.size() - this->At) / sizeof(Value))
    {
      this->Fail();
    }
    Values values(static_cast<std::size_t>(count), Value());
    this->Get(values.data(), values.size());
    return values;
  }

  /// Adds what is left to another message.
  void GetRest(std::vector<char>& bytes)
  {
    bytes.insert(
      bytes.end(), this->Bytes.begin() + static_cast<std::ptrdiff_t>(this->At), this->Bytes.end());
    this->At = this->Bytes.size();
  }

  /// Of what has been read, and cannot be.
  [[noreturn]] static void Fail()
  {
    throw std::runtime_error("What another rank has sent of its data cannot be read. Are all "
                             "ranks of the same version of this plugin?");
  }

private:
  const std::vector<char>& Bytes;
  std::size_t At = 0;
};

/// A part as it is sent, and as it arrives. Throw std::runtime_error where VTK cannot send a type of data.
void pack(const Part& part, std::vector<char>& bytes);
Part unpack(Reader& reader);

/// Throws std::runtime_error where parts have not the same arrays of points or cells (vtkDataObject::POINT, CELL), of which
/// some would be lost.
void requireSameArrays(const std::vector<vtkDataSet*>& parts, int kind);

/// Whether the points have three indices: an image, a rectilinear or a curvilinear grid.
bool isGrid(vtkDataSet* data);
/// Its indices of points or cells; low > high: it is no grid.
std::array<int, 6> extentOf(vtkDataSet* data, bool ofCells);

/// Parts of one image or grid as one; null where they are none.
vtkSmartPointer<vtkDataSet> joinedGrid(const std::vector<vtkDataSet*>& parts);

/// Parts of one mesh as one, cells in their order. Points that are the same to the last bit become one, if they also have
/// the same values of an array, where its name is given.
vtkSmartPointer<vtkDataSet> joinedMesh(
  const std::vector<vtkDataSet*>& parts, const char* alsoTheSame = nullptr);

} // namespace filters
