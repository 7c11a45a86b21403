// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Amr/AmrLevels.h"
#include "Schlieren.h"
#include "Sources/DataPiece.h"
#include "Sources/ImageSpline.h"
#include "Walls/BoundaryFaces.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

class vtkDataObject;
class vtkImageData;

namespace filters
{

/**
 * A spline through the points of an image, or of a rank's piece of it. Positions are in the image's
 * axes.
 *
 * Points without gas are walls, or windows where the data's masks say so: the cube around each, as
 * in the grid of an image. Points inside closed bodies have no value.
 *
 * A piece needs `layers` of other ranks' points around its own. Then the splines of two ranks
 * differ by less than single precision where they meet (a change k points away changes a
 * coefficient by (3 - sqrt(8))^k; Unser, Aldroubi & Eden 1993).
 */
class ImagePiece : public DataPiece
{
public:
  static constexpr int layers = 12;

  /// The extents of a piece and of the whole image; inclusive, as VTK's.
  struct Extents
  {
    using Extent = std::array<int, 6>;
    Extent whole;
    Extent own; // without points of other ranks
  };
  static Extents extentsOf(vtkImageData* whole);

  /// `refractivity`: three-dimensional, with the arrays of vtkRefractiveIndex. `bodies`: in the
  /// image's axes, see turnedBack(); may be null. Throws std::runtime_error if they are no
  /// surfaces.
  ImagePiece(
    vtkImageData* refractivity, const Extents& extents, vtkDataObject* bodies, int threads);

  /// N at a known point of its own on the faces of the whole image.
  struct OuterValue
  {
    std::int64_t point; // in the whole image
    double value;
  };
  /// Returns the ambient N, see schlieren::ambientOf(), of the faces with each point once. NaN: no points.
  static double ambientOf(std::vector<OuterValue> values);
  const std::vector<OuterValue>& outer() const { return this->Outer; }

  /// Return the first point and the points of the whole image.
  const std::array<double, 3>& origin() const { return this->Origin; }
  const Counts& whole() const { return this->Whole; }

  /// Returns the faces around its own points without gas.
  BoundaryFaces faces() const;

  Facts facts() const override;
  bool dependsOnLattice() const override { return false; }
  CellTree::Content contentOf(const schlieren::Box& box) const override;
  bool holds(const Point& place) const override;
  void sample(const schlieren::Lattice& lattice, double* refractivity, unsigned char* found,
    CellsOfLattice* cells) const override;

private:
  std::vector<unsigned char> knownOf(const schlieren::Field& field) const;
  void findOuter(const schlieren::Field& field);
  schlieren::Box bounds() const;
  ImageSpline::Range rangeOf(const schlieren::Box& box) const;
  /// Returns the index of the nearest point of the whole image, from its first one.
  double indexAt(double place, std::size_t axis) const;
  double indexWithin(double place, std::size_t axis) const; // clamped to the points that it has
  Counts nearestPoint(const Point& place) const;
  schlieren::Place kindOf(const Counts& point) const;
  CellBox all() const { return { { 0, 0, 0 }, this->Points }; }

  Counts Points;                         // of the refractivity, with other ranks' points
  Counts First;                          // of Points, in the whole image
  Counts Whole;                          // of the whole image
  CellBox Own;                           // its own among Points
  std::array<double, 3> Origin, Spacing; // of the whole image
  std::array<double, 9> Direction;
  std::vector<schlieren::Place> Kinds; // of each point; empty: all gas
  std::vector<unsigned char> IsKnown;  // of each point: gas outside of bodies
  std::int64_t KnownPoints = 0;        // of its own
  std::vector<OuterValue> Outer;
  std::unique_ptr<const ImageSpline> Spline; // of N
};

/// Surfaces in the axes that `direction` leads from. Null: there are none.
vtkSmartPointer<vtkDataObject> turnedBack(
  vtkDataObject* bodies, const std::array<double, 9>& direction);

} // namespace filters
