// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/WorkProgress.h"
#include "Input/RefractivitySource.h"
#include "Sources/AmrGrid.h"
#include "Sources/FieldTints.h"
#include "Sources/MeshSource.h"
#include "Sources/SamplingGrid.h"

#include "vtkSchlierenFiltersModule.h" // for export macro

#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"

#include <cstdint>
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

/// What is kept of a mesh for the next one. Several makers can have one together.
struct KeptMesh
{
  std::optional<std::uint64_t> key; // unset: there is none
  SourceMesh mesh;
  vtkTypeInt64 builds = 0;

  void release()
  {
    this->key.reset();
    this->mesh = {};
  }
};

/// Makes the medium of data: a source for the tracer, or a grid. Functions throw std::runtime_error with a message for the user,
/// std::bad_alloc, and Stopped where the work is cancelled.
class VTKSCHLIERENFILTERS_EXPORT MediumMaker
{
public:
  /// `progress`: hears of all work.
  explicit MediumMaker(Progress progress = {});

  /// Of the next data.
  MediumSettings settings;
  /// 0: VTK_SMP_MAX_THREADS where that is set, else the cores that this process may use. Nothing depends on it.
  int numberOfThreads = 0;

  /// The arrays of the last data, of which those are chosen that are not given.
  KnownArrays& known() const { return *this->Known; }
  /// The settings with nothing left open: for the last data, or for others.
  MediumChoice choice() const;
  MediumChoice choiceFor(vtkDataObject* input);
  int threads() const;
  const Progress& progress() const { return this->Report; }

  /// Makes `structure` the grid (extent, origin, spacing, direction; no arrays) that convert() would fill.
  void computeGrid(vtkDataObject* input, vtkImageData* structure);
  /// The same with two points along each axis, for data that canMakeSource(): their box.
  void computeBox(vtkDataObject* input, vtkImageData* structure);
  /// The coordinate axis across the plane of the last data; -1: they are in no plane.
  int flatAxis() const { return this->FlatAxis; }
  /// Whether data are an image, whose grid is kept.
  bool keepsGrid(vtkDataObject* input);
  /// Whether the values of an image belong to its cells: as the user chose, unless its data, where they are there already, say
  /// otherwise.
  bool willReadCells(vtkDataObject* image);

  /// Fills `output`, which has Refractivity and the masks, from `input` and, where not null, `bodies`. Differences: Refractivity
  /// is N less RefractivityOffset of the field data, a value near that of the surroundings, so that weak flows keep their digits.
  /// Returns what the user should be warned of, mostly nothing.
  std::string convert(
    vtkDataObject* input, vtkImageData* output, vtkDataObject* bodies, Numbers numbers);
  /// The grid of the last convert() in words, with how it was chosen; empty before the first and after others.
  const std::string& grid() const { return this->Grid; }
  /// How often a grid was chosen for data, images apart: once for each and its settings.
  vtkTypeInt64 gridPlans() const { return this->Plan.count; }

  /// Whether data are for makeSource(). What else there is becomes a grid by convert(): images without bodies (unless
  /// `imagesToo`), flat ones, and where SamplingDimensions or SamplingBounds are given.
  bool canMakeSource(vtkDataObject* input, vtkDataObject* bodies, bool imagesToo);

  /// Whether the settings are for data that stay on several ranks: see InputsOfRanks.
  bool canUsePieces() const;

  /// The refractivity for the tracer, which queries it as finely as a view needs. `withFields`: it has Fields, too; see
  /// FieldTints.h. `warning`: what the user should be warned of.
  ///
  /// Keeps what depends on the mesh alone until the next data: the order of its cells, the points around each point, where the
  /// gas ends. Data have the same mesh if their points, their cells, what hides them, which values are valid, the bodies, Outside
  /// and Reconstruction are the same; that is found from the data themselves, not from their times.
  std::shared_ptr<const schlieren::MediumSource> makeSource(
    vtkDataObject* input, vtkDataObject* bodies, std::string& warning, bool withFields = false);
  /// The same of data whose grid is not kept, whatever grid is wanted.
  std::shared_ptr<const schlieren::MediumSource> makeSourceOfCells(
    vtkDataObject* input, vtkDataObject* bodies, std::string& warning, bool withFields = false);

  std::shared_ptr<KeptMesh> mesh() const { return this->Mesh; }
  void setMesh(std::shared_ptr<KeptMesh> mesh) { this->Mesh = std::move(mesh); }
  /// Forgets what is kept of the last data, for a medium that is made elsewhere.
  void forgetLast();

  /// What to warn of for a medium of `source` with these values; `bodiesMissed`: bodies are given, but none is in the data. Notes
  /// that were the last ones are not repeated.
  std::string warningOf(const Source& source, const Tally& tally, bool bodiesMissed);

private:
  /// The grid of data that are not one image, chosen anew only where something has changed.
  struct GridPlan
  {
    std::vector<double> input; // empty: not chosen yet
    MediumSettings settings;
    std::optional<Amr> amr;
    Resampling resampling; // where it is no Amr
    vtkTypeInt64 count = 0;
  };
  const GridPlan& planGrid(const Source& source, vtkDataObject* input);

  WorkProgress progressOf(double from, double to) const;
  Source choose(vtkDataObject* input, const Source* like = nullptr);
  bool wantsGrid() const;
  void fillFromImage(const Source& source, Numbers numbers, vtkDataObject* bodies,
    vtkImageData* output, std::string& warning);
  void fillFromSource(const Source& source, vtkDataObject* input, Numbers numbers,
    vtkDataObject* bodies, vtkImageData* output, std::string& warning, std::string& note);
  std::shared_ptr<const schlieren::MediumSource> makeSourceOfImage(
    vtkDataObject* input, vtkDataObject* bodies, std::string& warning, bool withFields);
  /// What makeSourceOfCells() has made of a source, and of the fields beside it.
  struct Made
  {
    std::shared_ptr<const schlieren::MediumSource> source;
    bool hasGas = false, meetsBodies = false;
    Tally tally{};
  };
  Made makeOf(Source source, std::vector<FieldValues> fields, vtkDataObject* bodies, double depth);
  Made makeOfMesh(
    const Source& source, const std::vector<FieldValues>& fields, vtkDataObject* bodies, int flat);
  /// Frees what is kept of a mesh, or leaves it to others that have it.
  void leaveMesh();

  Progress Report;
  std::shared_ptr<KnownArrays> Known = std::make_shared<KnownArrays>();
  GridPlan Plan;
  std::shared_ptr<KeptMesh> Mesh = std::make_shared<KeptMesh>();
  std::string Grid;
  int FlatAxis = -1;
  std::string ToldOfGases,
    ToldOfValues; // the last notes: they are not repeated for every time step
};

/// Most builds of ParaView run VTK's threaded loops on one core by default, and else on all of the machine.
vtkSMPTools::Config loopsWith(int threads);

/// Appends a sentence.
void addText(std::string& text, const std::string& more);

std::string noGas(const std::string& label); // of the arrays

} // namespace filters
