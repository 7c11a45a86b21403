// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "FlatData.h"
#include "GasBoundary.h"
#include "Medium/MediumSource.h"
#include "Medium/Prefilter.h"
#include "Schlieren.h"
#include "WorkProgress.h"

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
 * The refractivity of an image with Bodies in it, box by box, for the tracer. The silhouettes of bodies are where their
 * surfaces are: as the grid that an image is without them, the medium would be blocked voxel by voxel.
 *
 * Between the image's points, N is the quadratic spline through them (Unser, Aldroubi & Eden 1993), as in the grid. Points
 * inside closed bodies have no value of their own: what is around them continues linearly.
 *
 * Points that are no gas in the data are walls, or windows where the data's masks say so, as they stand: the cube around
 * each, as in the grid.
 */
class ImageSource : public schlieren::MediumSource
{
public:
  /// `refractivity`: three-dimensional, with the arrays of vtkRefractiveIndex. `bodies`: not null. Throws
  /// std::runtime_error where they are no surfaces.
  ImageSource(vtkImageData* refractivity, vtkDataObject* bodies, int threads,
    const WorkProgress& progress = WorkProgress());

  /// One more field at the same points, as if it were a refractivity.
  void addField(vtkImageData* values, int threads);

  bool hasGas() const { return this->HasGas; }
  /// Whether the bodies reach into the image.
  bool meetsBodies() const { return this->Boundary->hasBodiesIn(this->bounds()); }

  schlieren::Box bounds() const override;
  double ambient() const override { return this->Ambient; }
  std::array<double, 3> voxelShape() const override { return this->Spacing; }
  std::array<double, 9> direction() const override { return this->Direction; }
  Content contentOf(const schlieren::Box& box) const override;
  void sample(const schlieren::Lattice& lattice, double* refractivity, schlieren::Place* places,
    float* distances) const override;

  int fields() const override { return static_cast<int>(this->Fields.size()); }
  FieldRange rangeOfField(int field, const schlieren::Box& box) const override;
  void sampleWithFields(const schlieren::Lattice& lattice, double* refractivity,
    schlieren::Place* places, float* distances, double* values) const override;

private:
  /// Values at the image's points, and between them. Those that are not known are continued.
  class Spline
  {
  public:
    /// Of an image's field; `isKnown`: of each point.
    Spline(const schlieren::Field& field, const std::vector<unsigned char>& isKnown,
      const std::array<int, 3>& points, int threads);

    /// At lattice points; `places`: their index coordinates along each axis, within the image.
    void sample(const std::array<std::vector<double>, 3>& places, double* values) const;
    /// Of the values around points from `first` to `last`.
    FieldRange rangeIn(const std::array<int, 3>& first, const std::array<int, 3>& last) const;

  private:
    double Offset; // near all values, so that single precision is enough for what differs
    schlieren::PaddedVolume<float> Coefficients;
    // Of blocks of values.
    std::array<int, 3> Blocks;
    std::vector<FieldRange> Ranges;
  };

  double indexAt(double place, std::size_t axis) const;
  FieldRange rangeOf(const Spline& values, const schlieren::Box& box) const;
  std::size_t nearestPoint(const Point& place) const;
  std::array<std::vector<double>, 3> indicesOf(const schlieren::Lattice& lattice) const;
  BoundaryFaces findFaces() const;

  std::array<int, 3> Points;
  std::array<double, 3> Origin, Spacing; // in the image's own axes
  std::array<double, 9> Direction;       // from these to the data's
  std::vector<schlieren::Place> Kinds;   // of each point in the data; empty: all gas
  bool HasGas = false;
  double Ambient = 0;
  std::vector<unsigned char> IsKnown; // of each point: gas, and in no body
  std::unique_ptr<const Spline> Refractivity;
  std::unique_ptr<const GasBoundary> Boundary;
  std::vector<std::unique_ptr<const Spline>> Fields;
};

} // namespace filters
