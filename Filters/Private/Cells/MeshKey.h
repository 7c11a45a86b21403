// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>

class vtkDataObject;
class vtkDataSet;

namespace filters
{

/// A hash of the numbers that it is given, in their order. Meshes are known by such hashes, since readers make new
/// objects for each time step, and programs change old ones without telling.
class Hash
{
public:
  void add(std::uint64_t bits)
  {
    this->Value = (this->Value ^ bits) * 0x9e3779b97f4a7c15u;
    this->Value ^= this->Value >> 29;
  }
  void add(const double* values, int count)
  {
    for (int i = 0; i < count; ++i)
    {
      std::uint64_t bits;
      std::memcpy(&bits, values + i, sizeof(bits));
      this->add(bits);
    }
  }
  std::uint64_t value() const { return this->Value; }

private:
  std::uint64_t Value = 1;
};

/// Hashes a point's number. The sum over several points is a hash of their set, regardless of their order.
inline std::uint64_t hashOfPoint(std::uint64_t number)
{
  std::uint64_t bits = number + 1;
  bits = (bits ^ (bits >> 31)) * 0x7fb5d329728ea185u; // P. Evensen's mixer
  bits = (bits ^ (bits >> 27)) * 0x81dadef4bc2dd44du;
  return bits ^ (bits >> 33);
}

/// Where points are.
void addPoints(Hash& hash, vtkDataSet* data);

/// Which points each cell has, and its type.
void addCells(Hash& hash, vtkDataSet* data);

/// Points, cells and which of them ghost arrays hide.
void addMesh(Hash& hash, vtkDataSet* data);

/// Hashes which points have a finite scalar.
void addGas(Hash& hash, vtkDataSet* data);

/// Hashes the surfaces of bodies; may be null.
void addBodies(Hash& hash, vtkDataObject* bodies);

} // namespace filters
