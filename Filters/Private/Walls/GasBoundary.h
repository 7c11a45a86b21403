// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Triangles.h"
#include "Schlieren.h"
#include "Walls/BodySurfaces.h"
#include "Walls/BoundaryFaces.h"

#include <array>
#include <memory>
#include <vector>

class vtkDataObject;
class vtkDataSet;

namespace filters
{

/// Treatment of boundaries of the gas.
enum class Outside
{
  Auto,   ///< bodies and sheets are walls, outer boundaries are not: see findOuter()
  Blocks, ///< all boundaries are walls
  Passes  ///< only hidden cells and Bodies are walls
};

/**
 * Where the gas of meshes ends, and which of that is walls. What is towards hidden cells is a wall, and so are
 * Bodies, whatever `Outside` says. All functions may be called from several threads.
 */
class GasBoundary
{
public:
  using Place = schlieren::Place;

  /// `leaves`, `isInCell` (may be empty): see boundaryOf(). `bodies`: may be null; see BodySurfaces. All of it is kept
  /// as it is: neither need outlive this.
  GasBoundary(const std::vector<vtkDataSet*>& leaves, vtkDataObject* bodies, Outside outside,
    const CellTest& isInCell, const WorkProgress& progress = WorkProgress(),
    Extent extent = Extent::Volume);
  /// Makes the boundary of given faces.
  GasBoundary(BoundaryFaces faces, vtkDataObject* bodies, Outside outside,
    const WorkProgress& progress = WorkProgress());
  GasBoundary(const GasBoundary&) = delete;
  GasBoundary& operator=(const GasBoundary&) = delete;

  /// Returns whether sheets are equal for other values on the same mesh.
  bool hasSheetsOf(const ValuesOfCuts& valuesOf) const
  {
    return findSheets(this->Faces.cuts, valuesOf(this->Faces.cuts)) == this->Faces.areSheets;
  }

  /// N of the gas around the flow: the median over the area of the outer boundary, or of all of the boundary where
  /// there is none. NaN: there is no boundary. `leaves`: these or others on the same mesh.
  double ambient(const std::vector<vtkDataSet*>& leaves) const;
  /// Returns the ambient of N at the points of surface().
  double ambient(const std::vector<double>& values) const;

  /// Kinds of faces in a box.
  struct Kinds
  {
    bool wall, window;
  };
  Kinds facesIn(const schlieren::Box& box) const;
  /// Sets `hasWall`, `hasGas`, `hasWindow` and `areWallsFlat` of a box, given visible cells.
  void findPlaces(const schlieren::Box& box, const CellTest& isInCell,
    schlieren::MediumSource::Content& content) const;
  /// Returns the points that findPlaces() may test: the middle and the corners of a box.
  static std::array<Point, 9> testedPlaces(const schlieren::Box& box);
  /// Returns whether any of the Bodies meets a box.
  bool hasBodiesIn(const schlieren::Box& box) const;

  /// What there is at a place, given whether a visible cell holds it. Of a place outside, the nearest face counts
  /// (or one that is farther away by no more than a twentieth); but what is beyond the nearest window is one, though
  /// the wall of a hole that opens there be nearer.
  Place kindAt(const Point& place, bool isInCell) const;

  /// Fills `places` and `distances` (may be null), see MediumSource::sample(), given which points visible cells
  /// hold. Distances are never 0: points in cells have at least 1/4096, others at most -1/4096. Points outside and
  /// beyond reach of faces are what those beside them are. Points outside without a face between them and gas beside
  /// them, in gaps between cells, are windows.
  ///
  /// Where a wall is thinner than a voxel, so that there are points with gas on both sides, the nearer one becomes
  /// a wall, half a voxel deep. So the points with gas that are corners of the same voxel are all on one side of
  /// it: nothing leaks through where distances are interpolated trilinearly.
  void sample(const schlieren::Lattice& lattice, const unsigned char* isInCell, Place* places,
    float* distances) const;

  /// Returns the surface, for tests and messages.
  const Triangles& surface() const { return this->Faces.surface; }
  bool isWall(std::size_t triangle) const { return this->Walls[triangle] != 0; }

private:
  void findWindows();
  bool isBeyondAll(const Point& place) const;
  bool areWallsFlatNear(const schlieren::Box& box) const;

  BoundaryFaces Faces;
  TriangleTree Tree;
  std::vector<unsigned char> IsOuter; // of each triangle
  std::vector<unsigned char> Walls;   // of each triangle
  Triangles Windows;                  // other triangles, with Outside::Auto
  std::unique_ptr<TriangleTree> TreeOfWindows;
  Place Far; // without any faces
  std::unique_ptr<BodySurfaces> Bodies;
};

} // namespace filters
