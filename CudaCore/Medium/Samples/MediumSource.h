// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the tracer requests of data that are no regular grid: meshes, AMR, several blocks. The medium's tree
// (MediumTree) queries it node by node, from several threads at once.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace schlieren
{

/// What there is at a point; the values are those of Field::valid.
enum class Place : unsigned char
{
  Wall = 0,  ///< of a body: stops light
  Gas = 1,   ///< has data
  Window = 2 ///< no data: light goes straight on, as through the ambient gas
};

/// Between two corners; data units.
struct Box
{
  std::array<double, 3> low, high;
};

/// Points first + (i, j, k) spacing, x fastest; data units.
struct Lattice
{
  std::array<double, 3> first, spacing;
  std::array<int, 3> points;

  std::int64_t size() const { return std::int64_t{ points[0] } * points[1] * points[2]; }
};

class BrickMakers;

class MediumSource
{
public:
  MediumSource() = default;
  MediumSource(const MediumSource&) = delete;
  MediumSource& operator=(const MediumSource&) = delete;
  virtual ~MediumSource() = default;

  /// All data lie within; outside of it is ambient gas.
  virtual Box bounds() const = 0;

  /// N of the gas around the flow: see ambientOf(), at the outer boundary of the domain.
  virtual double ambient() const = 0;

  /// Proportions that voxels should have, e.g. (1, 0.1, 1) where cells are ten times finer along y.
  virtual std::array<double, 3> voxelShape() const { return { 1, 1, 1 }; }

  /// Whether nothing depends on z: along it, bounds() give a depth and nothing else. Then lattices to be sampled
  /// have one layer, in the middle of the depth, and along z the larger one of their spacings.
  virtual bool isFlat() const { return false; }

  /// The rotation, by rows, from its axes to those of the data, whose images are to be made.
  virtual std::array<double, 9> direction() const { return { 1, 0, 0, 0, 1, 0, 0, 0, 1 }; }

  /// What is known of a box without looking at single points. It may say less than there is to say, never
  /// something wrong: a wider range, smaller cells, more kinds of points.
  struct Content
  {
    double lowest, highest; ///< N of all data in the box; lowest > highest: it has no data
    std::array<double, 3>
      cellSize; ///< along each axis the smallest edge of cells in the box; infinite: no cells
    bool hasWall, hasGas, hasWindow;
    bool areWallsFlat =
      false; ///< all walls in and near the box are one plane, with gas on one side of it
  };
  virtual Content contentOf(const Box& box) const = 0;

  /// The points of a lattice. `refractivity`: N where there is gas; elsewhere anything. `places`: what each point
  /// is. `distances` (may be null): to the nearest place where gas ends, in spacings of the lattice (the
  /// metric in which its spacings are all 1), positive in gas, negative outside of it, limited to
  /// -`reach` ... `reach`; linear across the surface, so that its zero is where the surface is.
  virtual void sample(
    const Lattice& lattice, double* refractivity, Place* places, float* distances) const = 0;
  static constexpr float reach = 3;

  /// True: the value of a point may depend a little on the lattice that it belongs to. Then lattices are those that are
  /// requested of sources with makers(), so that the medium does not depend on where the data are.
  virtual bool dependsOnLattice() const { return false; }

  /// Ranks that have the data together and make bricks of them; null: this one has all. Each has a source that answers
  /// for what has been prepared, and contentOf(bounds()) at any time.
  virtual const BrickMakers* makers() const { return nullptr; }
  /// Until the next call, contentOf() answers for these boxes. All ranks call it, with the same boxes,
  /// as the next one.
  virtual void prepareContents(const std::vector<Box>& /*boxes*/) const {}
  /// The same of sample() and every nth lattice: on rank 0 of n the first one, and so on.
  virtual void prepareSamples(const std::vector<Lattice>& /*lattices*/) const {}
};

} // namespace schlieren
