// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Triangles.h"
#include "Common/WorkProgress.h"
#include "Schlieren.h"
#include "Walls/BodySurfaces.h"
#include "Walls/BoundaryFaces.h"
#include "Walls/OutsidePlaces.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

class vtkDataObject;
class vtkDataSet;

namespace filters
{

/**
 * The boundary of the gas of meshes, and its walls. Faces to hidden cells, and Bodies, are walls
 * with any `Outside`. Thread-safe.
 */
class GasBoundary
{
public:
  using Place = schlieren::Place;

  /// `bodies`: may be null; see BodySurfaces. Keeps copies of all data.
  GasBoundary(BoundaryFaces faces, vtkDataObject* bodies, Outside outside,
    const WorkProgress& progress = WorkProgress());
  GasBoundary(const GasBoundary&) = delete;
  GasBoundary& operator=(const GasBoundary&) = delete;

  /// Returns the ambient N, see schlieren::ambientOf(): of the outer boundary, or of all of the
  /// boundary without one. NaN: no boundary. `leaves`: these or others on the same mesh.
  double ambient(const std::vector<vtkDataSet*>& leaves) const;
  /// Returns the ambient of N at the points of surface().
  double ambient(const std::vector<double>& values) const;

  /// Kinds of faces in a box.
  struct Kinds
  {
    bool wall, window;
  };
  Kinds facesIn(const schlieren::Box& box) const;
  /// Returns whether all faces in and near a box are in one plane of a wall; false for sheets, whose
  /// voxels depend on the voxel size.
  bool areWallsFlatNear(const schlieren::Box& box) const;
  /// Returns the points that show what is in a box without faces: its middle and its corners, of
  /// the part within the bounds of the data.
  static std::array<Point, 9> testedPlaces(const schlieren::Box& box, const schlieren::Box& bounds);
  /// Bodies that have no cells, as OutsidePlaces have decided.
  struct Decided
  {
    int bodies;
    bool isAlone; ///< nothing else stops light
  };
  Decided decided() const;

  /// Returns whether any of the Bodies meets a box.
  bool hasBodiesIn(const schlieren::Box& box) const;

  /// Returns the kind of a point, given whether a visible cell contains it. Outside, OutsidePlaces
  /// decide with Outside::Auto, and otherwise, and near faces, the nearest face.
  Place kindAt(const Point& place, bool isInCell) const;

  /// Fills `places` and `distances` (may be null), see MediumSource::sample(), given the points in
  /// visible cells. Distances are at least 1/4096 in cells and at most -1/4096 outside. Points
  /// outside and beyond reach of faces have the kind of their neighbours. Points outside that no
  /// face separates from gas beside them, in gaps between cells, are windows.
  ///
  /// If a wall is thinner than a voxel, with gas on both sides, the nearer point becomes a wall,
  /// half a voxel deep. So the corners with gas of a voxel are all on one side of it, and trilinear
  /// interpolation of distances has no leaks.
  void sample(const schlieren::Lattice& lattice, const unsigned char* isInCell, Place* places,
    float* distances) const;

  /// Returns the surface, for tests and messages.
  const Triangles& surface() const { return this->Faces.surface; }
  bool isWall(std::size_t triangle) const { return this->Walls[triangle] != 0; }

private:
  BoundaryFaces Faces;
  TriangleTree Tree;
  std::vector<unsigned char> Walls;   // of each triangle
  std::optional<OutsidePlaces> Outer; // where they decide, or values are known
  bool IsAuto;                        // they decide
  Place Far;                          // without any faces
  std::unique_ptr<BodySurfaces> Bodies;
};

} // namespace filters
