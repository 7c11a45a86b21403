// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/WorkProgress.h"
#include "Schlieren.h"
#include "Sources/ImagePiece.h"
#include "Walls/GasBoundary.h"

#include "vtkSmartPointer.h"

#include <array>
#include <memory>

class vtkDataObject;
class vtkImageData;

namespace filters
{

/// The refractivity of an image with Bodies, for bricks of the tracer. Silhouettes are at the
/// bodies' surfaces, where a grid would block whole voxels. Interpolates the image by the same
/// quadratic spline as a grid (see ImagePiece).
class ImageSource : public schlieren::MediumSource
{
public:
  /// `refractivity`: three-dimensional, with the arrays of vtkRefractiveIndex. `bodies`: not null.
  /// Throws std::runtime_error if they are no surfaces.
  ImageSource(vtkImageData* refractivity, vtkDataObject* bodies, int threads,
    const WorkProgress& progress = WorkProgress());

  /// Adds a field at the same points, in the form of a refractivity.
  void addField(vtkImageData* values, int threads) { this->Piece.addField(values, threads); }

  bool hasGas() const { return this->Piece.hasGas(); }
  /// Returns whether bodies meet the image.
  bool meetsBodies() const { return this->Boundary->hasBodiesIn(this->bounds()); }

  schlieren::Box bounds() const override { return this->Piece.bounds(); }
  double ambient() const override { return this->Ambient; }
  std::array<double, 3> voxelShape() const override { return this->Piece.spacing(); }
  std::array<double, 9> direction() const override { return this->Piece.direction(); }
  Content contentOf(const schlieren::Box& box) const override;
  void sample(const schlieren::Lattice& lattice, double* refractivity, schlieren::Place* places,
    float* distances) const override;

  int fields() const override { return static_cast<int>(this->Piece.fields()); }
  FieldRange rangeOfField(int field, const schlieren::Box& box) const override;
  void sampleWithFields(const schlieren::Lattice& lattice, double* refractivity,
    schlieren::Place* places, float* distances, double* values) const override;

private:
  vtkSmartPointer<vtkDataObject> Bodies; // in the image's axes; null after the first use
  ImagePiece Piece;
  double Ambient;
  std::shared_ptr<const GasBoundary> Boundary;
};

} // namespace filters
