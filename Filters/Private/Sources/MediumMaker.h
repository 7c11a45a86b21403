// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/WorkProgress.h"
#include "Input/RefractivitySource.h"
#include "Sources/AmrGrid.h"
#include "Sources/FieldTints.h"
#include "Sources/ImagePiece.h"
#include "Sources/KeptMesh.h"
#include "Sources/SamplingGrid.h"

#include "vtkSchlierenFiltersModule.h" // for export macro

#include "vtkSmartPointer.h"

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

/// Makes the medium of data: a source for the tracer, or a grid. Functions throw std::runtime_error
/// with a message for the user, std::bad_alloc, or Stopped if cancelled.
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

  /// Makes `structure` the grid (extent, origin, spacing, direction; no arrays) that convert()
  /// would fill.
  void computeGrid(vtkDataObject* input, vtkImageData* structure);
  /// Makes `structure` the bounds, two points along each axis, of data that canMakeSource().
  void computeBox(vtkDataObject* input, vtkImageData* structure);
  /// Returns the coordinate axis across the plane of the last data; -1: no plane.
  int flatAxis() const { return this->FlatAxis; }
  /// Selects what to read of data; see chooseSource().
  Source choose(vtkDataObject* input, const Source* like = nullptr);
  /// Returns whether data are an image, whose grid is kept.
  bool keepsGrid(const Source& source) const
  {
    return source.image && !this->settings.isAxisymmetric();
  }
  /// Returns whether the values of an image belong to its cells: the user's choice, or else that of
  /// its data, if they are known already.
  bool willReadCells(vtkDataObject* image);

  /// Fills `output` with Refractivity and masks from `input` and `bodies`, if not null. With
  /// Differences, Refractivity is N less RefractivityOffset of the field data, about the ambient,
  /// so that weak flows keep their digits. Returns a warning, mostly empty.
  std::string convert(
    vtkDataObject* input, vtkImageData* output, vtkDataObject* bodies, Numbers numbers);
  /// Returns a text about the grid of the last convert(); empty before the first and after others.
  const std::string& grid() const { return this->Grid; }
  /// Counts grids chosen for data other than images, once for each and its settings.
  vtkTypeInt64 gridPlans() const { return this->Plan.count; }

  /// Returns whether makeSource() accepts the data. convert() makes grids of all else: images
  /// without bodies (unless `imagesToo`), flat ones, and with SamplingDimensions or SamplingBounds.
  bool canMakeSource(vtkDataObject* input, vtkDataObject* bodies, bool imagesToo);

  /// Returns whether the settings allow data on several ranks: see InputsOfRanks.
  bool canUsePieces() const;

  /// Makes the refractivity for the tracer, which samples it as finely as a view needs.
  /// `withFields`: with Fields; see FieldTints.h. `warning`: for the user.
  ///
  /// Keeps what depends on the mesh alone until the next data: the order of cells, neighbours of
  /// points, the boundary. Meshes are compared by their content, not by times: points, cells, what
  /// hides them, valid values, bodies and Outside.
  std::shared_ptr<const schlieren::MediumSource> makeSource(
    vtkDataObject* input, vtkDataObject* bodies, std::string& warning, bool withFields = false);
  /// Makes the source of data whose grid is not kept, whatever grid the settings have. `source`:
  /// chosen from `input`.
  std::shared_ptr<const schlieren::MediumSource> makeSourceOfCells(Source source,
    vtkDataObject* input, vtkDataObject* bodies, std::string& warning, bool withFields);
  /// Makes the piece of an image, or of a rank's piece of it, on whose grid `refractivity` has been
  /// made of `source`. `bodies`: see ImagePiece. `ranges`: see forFieldImages().
  std::unique_ptr<ImagePiece> makePieceOfImage(vtkImageData* refractivity,
    const ImagePiece::Extents& extents, vtkDataObject* bodies, vtkDataObject* input,
    const Source& source, bool withFields, const std::vector<FieldMean::Range>& ranges = {});

  std::shared_ptr<KeptMesh> mesh() const { return this->Mesh; }
  void setMesh(std::shared_ptr<KeptMesh> mesh) { this->Mesh = std::move(mesh); }
  /// Drops the state of the last data, for a medium that is made elsewhere.
  void forgetLast();

  /// Returns a warning about a medium of `source` with these values; `bodiesMissed`: no body is in
  /// the data. Does not repeat the last notes.
  std::string warningOf(const Source& source, const Tally& tally, bool bodiesMissed);

private:
  /// The grid for data that are not one image, chosen again after changes only.
  struct GridPlan
  {
    std::vector<double> input; // empty: none yet
    MediumSettings settings;
    std::optional<Amr> amr;
    Resampling resampling; // unless it is Amr
    vtkTypeInt64 count = 0;
  };
  const GridPlan& planGrid(const Source& source, vtkDataObject* input);

  WorkProgress progressOf(double from, double to) const;
  bool hasDimensions() const;
  bool wantsGrid() const;
  std::string convert(const Source& source, vtkDataObject* input, vtkImageData* output,
    vtkDataObject* bodies, Numbers numbers);
  void fillFromImage(Source source, Numbers numbers, vtkDataObject* bodies, vtkImageData* output,
    std::string& warning);
  void fillFromSource(const Source& source, vtkDataObject* input, Numbers numbers,
    vtkDataObject* bodies, vtkImageData* output, std::string& warning, std::string& note);
  std::shared_ptr<const schlieren::MediumSource> makeSourceOfImage(const Source& source,
    vtkDataObject* input, vtkDataObject* bodies, std::string& warning, bool withFields);
  std::shared_ptr<const PieceSource> makeOf(
    Source source, std::vector<Source> fields, vtkDataObject* bodies, double depth, Tally& tally);
  std::shared_ptr<const PieceSource> makeOfMesh(
    const Source& source, const std::vector<Source>& fields, vtkDataObject* bodies, Tally& tally);
  /// Frees what is kept of a mesh, or leaves it to others that have it.
  void leaveMesh();

  Progress Report;
  KnownArrays Known;
  GridPlan Plan;
  std::shared_ptr<KeptMesh> Mesh = std::make_shared<KeptMesh>();
  std::string Grid;
  int FlatAxis = -1;
  std::string ToldOfGases, ToldOfValues; // the last notes, not repeated for every time step
};

/// Appends a sentence.
void addText(std::string& text, const std::string& more);

std::string noGas(const std::string& label); // of the arrays

} // namespace filters
