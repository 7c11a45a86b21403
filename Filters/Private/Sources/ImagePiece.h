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

  /// `refractivity`: three-dimensional, with the arrays of vtkRefractiveIndex. `bodies`: in the
  /// image's axes, see turnedBack(); may be null. Throws std::runtime_error if they are no
  /// surfaces.
  ImagePiece(
    vtkImageData* refractivity, const Extents& extents, vtkDataObject* bodies, int threads);
  /// Makes a piece of a whole image.
  ImagePiece(vtkImageData* refractivity, vtkDataObject* bodies, int threads);

  /// Adds a field at the same points, with the next number, from 1 on.
  void addField(vtkImageData* values, int threads);
  int fields() const override { return static_cast<int>(this->Splines.size()) - 1; }

  bool hasGas() const { return this->KnownPoints > 0; }
  schlieren::Box bounds() const;
  std::array<double, 3> spacing() const { return this->Spacing; }
  std::array<double, 9> direction() const { return this->Direction; } // to the data's axes

  /// N at a known point of its own on the faces of the whole image.
  struct OuterValue
  {
    std::int64_t point; // in the whole image
    double value;
  };
  /// Returns the ambient N, the median over the faces with each point once. NaN: no points.
  static double ambientOf(std::vector<OuterValue> values);
  /// Returns the ambient N of a whole image: over all points if none on the faces is known.
  double ambient() const;

  /// Returns the faces around its own points without gas.
  BoundaryFaces faces() const;

  bool isGasAt(const Point& place) const;
  /// Returns the range of field 0, which is N, or of another one.
  ImageSpline::Range rangeOf(std::size_t field, const schlieren::Box& box) const;
  /// Samples all points of a lattice, also those of other pieces. `hasGas`: may be null.
  void sample(std::size_t field, const schlieren::Lattice& lattice, double* values,
    unsigned char* hasGas) const;

  Summary summary() const override;
  /// Writes its axes, the triangles of faces(), which of them hide something, and N on the faces of
  /// the whole image: at each point, or of more than a million at each nth.
  void putBoundary(std::int64_t cellsOfAll, std::vector<char>& message) const override;
  CellTree::Content contentOf(const schlieren::Box& box) const override;
  bool holds(const Point& place) const override;
  schlieren::MediumSource::FieldRange rangeOfField(
    int field, const schlieren::Box& box) const override
  {
    const ImageSpline::Range range = this->rangeOf(static_cast<std::size_t>(field) + 1, box);
    return { range.lowest, range.highest };
  }
  Samples sample(const schlieren::Lattice& lattice) const override;

private:
  std::vector<unsigned char> knownOf(const schlieren::Field& field) const;
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
  double Median; // of all known points, if there is no outer value
  std::vector<std::unique_ptr<const ImageSpline>> Splines;
};

/// What all ranks make of ImagePiece::putBoundary().
struct BoundaryOfImage
{
  std::size_t parts = 0;
  Point origin{};
  std::array<double, 3> spacing{};
  std::array<double, 9> direction{};
  BoundaryFaces faces;
  std::vector<ImagePiece::OuterValue> outer;

  /// Another rank's. Throws std::runtime_error where it has other axes.
  void add(Reader& reader);
};

/// Surfaces in the axes that `direction` leads from. Null: there are none.
vtkSmartPointer<vtkDataObject> turnedBack(
  vtkDataObject* bodies, const std::array<double, 9>& direction);

} // namespace filters
