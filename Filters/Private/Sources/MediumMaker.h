// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/WorkProgress.h"
#include "Input/Flow.h"
#include "Sources/ImagePiece.h"
#include "Sources/MeshCache.h"
#include "Sources/RefractivityCache.h"
#include "Sources/Revolution.h"

#include "vtkSchlierenFiltersModule.h" // for export macro

#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkDataObject;
class vtkImageData;

namespace schlieren
{
class MediumSource;
} // namespace schlieren

namespace filters
{

/// What is read of data and what becomes of them: chosen once, for all that follows. Valid as long as the data.
struct Choice
{
  vtkDataObject* input = nullptr;
  Flow flow;
  std::optional<Revolution> revolution; ///< of axisymmetric data
  bool isDepthFound = false;            ///< of a plane, see chooseDepth()
  int flatAxis = -1; ///< coordinate axis across the plane of the data; -1: no plane

  /// Returns whether data are an image, whose grid is kept.
  bool keepsGrid() const { return this->flow.image && !this->revolution; }
};

/// Makes the medium of data: a source for the tracer, or the refractivity of an image on its own grid. Functions throw
/// std::runtime_error with a message for the user, std::bad_alloc, or Stopped if cancelled.
class VTKSCHLIERENFILTERS_EXPORT MediumMaker
{
public:
  /// `progress`: reports all work.
  explicit MediumMaker(Progress progress = {});

  /// Settings for the next data.
  MediumSettings settings;
  /// 0: VTK_SMP_MAX_THREADS if set, else the process's cores. Results do not depend on it.
  int numberOfThreads = 0;

  /// Returns the arrays of the last data, among which defaults are chosen.
  KnownArrays& known() { return this->Known; }
  /// Returns the completed settings for the last data, or for others.
  MediumChoice choice() const;
  MediumChoice choiceFor(vtkDataObject* input);
  int threads() const;
  const Progress& progress() const { return this->Report; }

  Choice choose(vtkDataObject* input);
  /// Returns whether the settings allow data on several ranks: see InputsOfRanks.
  bool canUsePieces() const { return !this->settings.isAxisymmetric(); } // planes are small

  /// Makes the refractivity for the tracer: of an image on its grid, unless there are `bodies` or it `isLarge`; else a
  /// source, which is sampled as finely as a view needs,
  ///
  /// Keeps what depends on the mesh alone until the next data: the order of cells, neighbours of
  /// points, the boundary. Meshes are compared by their content, not by times: points, cells, what
  /// hides them, valid values, bodies and Outside.
  std::shared_ptr<MadeRefractivity> make(
    const Choice& choice, vtkDataObject* bodies, bool isLarge = false);

  std::shared_ptr<MeshCache> mesh() const { return this->Mesh; }
  void setMesh(std::shared_ptr<MeshCache> mesh) { this->Mesh = std::move(mesh); }
  /// Takes over what was said of a medium that another one has made.
  void setSaid(const SaidOfFlow& said) { this->Said = said; }
  const SaidOfFlow& said() const { return this->Said; }
  /// Drops the state of the last data, for a medium that is made elsewhere.
  void forgetLast();

  /// Returns a warning about a medium of `flow` with these values, first what one can act on; `bodiesMissed`: no body is in
  /// the data; `ofShape`: about its shape, may be empty. Does not repeat the last notes.
  std::string warningOf(
    const Flow& flow, const Tally& tally, bool bodiesMissed, const std::string& ofShape = "");

private:
  WorkProgress progressOf(double from, double to) const;
  void makeImage(const Choice& choice, MadeRefractivity& made);
  std::shared_ptr<const schlieren::MediumSource> sourceOfImage(
    vtkImageData* refractivity, vtkDataObject* bodies, std::string& warning);
  std::shared_ptr<const schlieren::MediumSource> sourceOfCells(
    const Choice& choice, vtkDataObject* bodies, std::string& warning);
  std::shared_ptr<const PieceSource> makeOf(
    Flow flow, int flatAxis, double depth, vtkDataObject* bodies, Tally& tally);

  Progress Report;
  KnownArrays Known;
  std::shared_ptr<MeshCache> Mesh = std::make_shared<MeshCache>();
  SaidOfFlow Said;
};

std::string noGas(const std::string& label); // of the arrays

} // namespace filters
