// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The datasets that a rank has of an input, and how they are sent to another one.
#pragma once

#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

class vtkDataObject;
class vtkDataSet;

namespace refractivity
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

/// Adds plain values to a message.
template <class Value>
void put(const Value* values, std::size_t count, std::vector<char>& bytes)
{
  const auto* first = reinterpret_cast<const char*>(values);
  bytes.insert(bytes.end(), first, first + count * sizeof(Value));
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
      throw std::runtime_error("What another rank has sent of its data cannot be read. Are all "
                               "ranks of the same version of this plugin?");
    }
    if (count > 0)
    {
      std::memcpy(values, this->Bytes.data() + this->At, count * sizeof(Value));
      this->At += count * sizeof(Value);
    }
  }

private:
  const std::vector<char>& Bytes;
  std::size_t At = 0;
};

/// A part as it is sent, and as it arrives. Throw std::runtime_error where VTK cannot send a type of data.
void pack(const Part& part, std::vector<char>& bytes);
Part unpack(Reader& reader);

} // namespace refractivity
