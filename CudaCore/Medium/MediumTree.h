// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Leaves.h"
#include "Medium/MediumSource.h"
#include "Schlieren.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace schlieren
{

/// What a view looks at: an orthographic column through the data; unbounded where the half widths are infinite.
struct Column
{
  Vec3<double> u, v;      ///< of the picture, unit vectors, along the source's axes
  double middle[2];       ///< picture coordinates, data units
  double halfWidth[2];    ///< along u and v, data units
  double finest;          ///< no voxel needs to be smaller: data units, the pixel's size or a part of it
};

/// How fine leaves are made.
struct TreeSettings
{
  /// Error of the deflection of a ray that is allowed, of the largest one. 0: as fine as the data are.
  double tolerance = 0.01;
  std::size_t memory = std::size_t{ 1 } << 30; ///< bytes that leaves may take
  Interpolation interpolation = Interpolation::Quadratic;
  int threads = 0;
};

/// The medium of a source: nu = (N - N_ref) / (1 + N_ref), as fine as data and views ask for.
template <class Real>
class MediumTree
{
public:
  static constexpr int brickEdge = 16; ///< samples

  /// Throws Error where no gas is found or values are impossible, as buildMedium does.
  MediumTree(std::shared_ptr<const MediumSource> source, double ambient, const TreeSettings& settings);

  /// Makes the leaves that a view needs and that are not there; keeps the others while memory allows. Returns
  /// whether anything has changed. Where `monitor` says stop, what has been made stays, and the same call goes on.
  bool refine(const Column& column, const Monitor& monitor = {});

  // What rays see. Grid::dimensions of the whole domain are those of its coarsest level.
  const Grid& grid() const;
  const std::vector<Leaf<Real>>& leaves() const;
  const std::vector<std::int32_t>& roots() const;
  const std::vector<std::int32_t>& children() const;
  LeafFinder finder() const;
  int apron() const;                ///< samples around each brick
  const std::vector<Real>& samples() const; ///< all bricks, one after the other; brick 0 is 0 everywhere
  std::int64_t samplesPerBrick() const;
  /// One for each sample of the maps of Leaf::Mixed: the distance to where gas ends, in 1/8192 of a voxel, positive in
  /// gas; the lowest bit tells what is outside: 0 a wall, 1 a window.
  const std::vector<std::int16_t>& gasDistances() const;

  // What is known of it.
  double largestNu() const;
  double rangeOfNu() const;
  double largestN() const;
  Vec3<double> slope() const; ///< largest |d nu / d index| of all leaves, axis by axis
  MediumStatistics statistics() const;

private:
  struct Parts;
  std::shared_ptr<Parts> parts_;
};

} // namespace schlieren
