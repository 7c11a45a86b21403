// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/MediumMaker.h"

#include "Common/AvailableMemory.h"
#include "Common/FieldFromImage.h"
#include "Common/Sentences.h"
#include "Common/Threads.h"
#include "Input/FlatBodies.h"
#include "Input/FlatData.h"
#include "Input/RefractivityOfImage.h"
#include "NumberText.h"
#include "Sources/AmrPiece.h"
#include "Sources/Mirrored.h"
#include "Sources/PreparedLeaves.h"
#include "Sources/RevolvedSource.h"
#include "Walls/BodyTriangles.h"

#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkTimeStamp.h"
#include "vtkUnsignedCharArray.h"

#include "Schlieren.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace filters
{

namespace
{

/// Throws if memory does not suffice for the arrays of an image.
void requireMemoryFor(vtkImageData* grid, bool isDouble)
{
  int points[3];
  grid->GetDimensions(points);
  const std::size_t bytes = 1 + (isDouble ? sizeof(double) : sizeof(float));
  requireMemory(static_cast<double>(bytes) * points[0] * points[1] * points[2],
    "The refractivity on a grid of " + std::to_string(points[0]) + " x " +
      std::to_string(points[1]) + " x " + std::to_string(points[2]) + " points",
    "Use a coarser input.");
}

bool hasGas(vtkImageData* refractivity)
{
  const unsigned char* valid =
    vtkUnsignedCharArray::SafeDownCast(refractivity->GetPointData()->GetArray(maskName))
      ->GetPointer(0);
  return std::any_of(
    valid, valid + refractivity->GetNumberOfPoints(), [](unsigned char v) { return v != 0; });
}

/// Makes the source of an image. `bodies`: in its axes; may be null.
std::shared_ptr<const PieceSource> sourceOf(
  std::unique_ptr<const ImagePiece> piece, vtkDataObject* bodies)
{
  const double ambient = ImagePiece::ambientOf(piece->outer());
  auto boundary = std::make_shared<const GasBoundary>(piece->faces(), bodies, Outside::Passes);
  return std::make_shared<PieceSource>(std::move(piece), std::move(boundary), ambient);
}

/// Makes the source of adaptive meshes, with walls at the edges of solid cells.
std::shared_ptr<const PieceSource> sourceOf(
  std::unique_ptr<const AmrPiece> piece, vtkDataObject* bodies, Outside outside)
{
  const double ambient = schlieren::ambientOf(piece->refractivity().outerValues());
  BoundaryFaces faces = piece->refractivity().faces();
  sortTriangles(faces.surface, faces.hidesBehind);
  auto boundary = std::make_shared<const GasBoundary>(std::move(faces), bodies, outside);
  return std::make_shared<PieceSource>(std::move(piece), std::move(boundary), ambient);
}

/// Returns what is revolved if that is a wedge; else an empty text.
std::string wedgeInWords(const Flow& flow)
{
  return flow.axisOfWedge < 0 ? ""
                              : "a wedge of " + textOf(flow.degreesOfWedge, 3) +
      " degrees is revolved around the " + "xyz"[flow.axisOfWedge] + " axis (Symmetry)";
}

} // namespace

MediumMaker::MediumMaker(Progress progress)
  : Report(std::move(progress))
{
}

int MediumMaker::threads() const
{
  const int given = threadsFrom(this->numberOfThreads);
  return given > 0 ? given : schlieren::coresOfProcess();
}

std::string noGas(const std::string& label)
{
  return "There is no valid value in the " + label +
    " (all are NaN, infinite, hidden, masked or no state of a gas), so there is no gas for light "
    "to cross. Choose another array or check the data.";
}

MediumChoice MediumMaker::choice() const { return choiceOf(this->settings, this->Known.Get()); }

MediumChoice MediumMaker::choiceFor(vtkDataObject* input)
{
  return filters::choiceFor(this->settings, this->Known, dataSetsOf(input));
}

WorkProgress MediumMaker::progressOf(double from, double to) const
{
  return WorkProgress(this->Report).part(from, to);
}

Choice MediumMaker::choose(vtkDataObject* input)
{
  Choice choice{ input, chooseFlow(this->settings, this->Known, input), {} };
  Flow& flow = choice.flow;
  if (auto* mean = std::get_if<FieldMean>(&flow.model))
  {
    mean->findRanges(flow.leaves);
  }
  if (this->settings.isAxisymmetric() || flow.axisOfWedge >= 0)
  {
    choice.revolution = revolutionOf(flow); // throws if there is none
  }
  const int flat = flatAxisOf(flow); // throws without volume and plane
  const bool isTurned = flow.image && !flow.image->GetDirectionMatrix()->IsIdentity();
  choice.flatAxis = isTurned ? -1 : flat;
  choice.isDepthFound = flat >= 0 && !choice.revolution && !(flow.depth > 0);
  if (choice.isDepthFound)
  {
    chooseDepth(flow, flat);
  }
  return choice;
}

void MediumMaker::forgetLast() { leave(this->Mesh); }

std::string MediumMaker::warningOf(
  const Flow& flow, const Tally& tally, bool bodiesMissed, const std::string& ofShape)
{
  const MediumSettings& used = flow.choice.settings;
  const std::string gas =
    flow.choice.message + " " + used.Gas + " " + textOf(used.GladstoneDaleConstant);
  if (gas != this->Said.Gas)
  {
    this->Said = {};
  }
  std::string warning;
  Implausible found;
  if (!flow.leaves.empty())
  {
    found = implausibleIn(flow);
  }
  if (found.kind != this->Said.Values)
  {
    addText(warning, found.text);
  }
  const std::string doubtful = warningFrom(flow.model, tally);
  if (this->Said.Doubtful.empty())
  {
    addText(warning, doubtful);
  }
  if (bodiesMissed)
  {
    addText(warning, bodiesAreOutside);
  }
  if (ofShape != this->Said.Shape)
  {
    addText(warning, ofShape);
  }
  if (flow.notes != this->Said.Notes)
  {
    addText(warning, flow.notes);
  }
  this->Said = { gas, found.kind, doubtful, ofShape, flow.notes, used.IndexModel,
    noteOnContinued(flow.model, tally) };
  return warning;
}

std::shared_ptr<MadeRefractivity> MediumMaker::make(
  const Choice& choice, vtkDataObject* bodies, bool isLarge)
{
  auto made = std::make_shared<MadeRefractivity>();
  made->FlatAxis = choice.flatAxis;
  made->Wedge = wedgeInWords(choice.flow);
  made->Depth = choice.isDepthFound ? choice.flow.depth : 0;
  const auto work = [&]
  {
    if (!choice.keepsGrid())
    {
      made->Source = this->sourceOfCells(choice, bodies, made->Warning);
      return;
    }
    this->makeImage(choice, *made);
    if (bodies || isLarge)
    {
      made->Source = this->sourceOfImage(made->Image, bodies, made->Warning);
      made->Image->Initialize();
      made->Grid.clear();
    }
  };
  vtkSMPTools::LocalScope(loopsWith(this->threads()), work);
  made->Mesh = this->Mesh;
  made->Said = this->Said;
  vtkTimeStamp now;
  now.Modified();
  made->SourceTime = now.GetMTime();
  return made;
}

void MediumMaker::makeImage(const Choice& choice, MadeRefractivity& made)
{
  this->progressOf(0, 1).reach(0.05);
  leave(this->Mesh);
  const Flow& flow = choice.flow;
  vtkImageData* image = made.Image;
  gridOfImage(flow.image, flow.leaves[0].ofCells, flow.depth, image);
  requireMemoryFor(image, this->settings.DoublePrecision);
  const Tally tally = convertImage(
    flow, this->settings.DoublePrecision ? Numbers::Doubles : Numbers::Differences, image);
  const int flat = flatAxisOf(flow);
  made.Warning =
    this->warningOf(flow, tally, false, flat < 0 ? "" : warningOfExtrusion(flow, flat));
  if (!hasGas(image))
  {
    throw std::runtime_error(noGas(flow.label));
  }
  mergeMasks(image);
  const int* points = image->GetDimensions();
  made.Grid = std::to_string(points[0]) + " x " + std::to_string(points[1]) + " x " +
    std::to_string(points[2]) + " points: the data's own";
}

std::shared_ptr<const schlieren::MediumSource> MediumMaker::sourceOfImage(
  vtkImageData* refractivity, vtkDataObject* bodies, std::string& warning)
{
  const auto own = turnedBack(bodies, gridFrom(refractivity).direction);
  auto made = sourceOf(std::make_unique<ImagePiece>(
                         refractivity, ImagePiece::extentsOf(refractivity), own, this->threads()),
    own);
  this->progressOf(0, 1).reach(1);
  if (!made->hasGas())
  {
    throw std::runtime_error(bodiesCoverAll);
  }
  if (bodies && !made->meetsBodies())
  {
    addText(warning, bodiesAreOutside);
  }
  return made;
}

std::shared_ptr<const PieceSource> MediumMaker::makeOf(
  Flow flow, int flat, double depth, vtkDataObject* bodies, Tally& tally)
{
  const vtkSmartPointer<vtkDataObject> ownBodies = turnedBodies(bodies, flat, depth);
  const auto outside = static_cast<Outside>(this->settings.Outside);
  std::optional<AmrLevels> levels = findLevels(flow.leaves);
  if (!levels)
  {
    if (flat >= 0)
    {
      flow = extruded(flow, flat, depth);
    }
    const MeshLeaves leaves = preparedLeaves(flow, tally);
    this->progressOf(0, 1).reach(0.1);
    return sourceOfMeshes(
      leaves, { outside, flat }, ownBodies, this->progressOf(0.1, 1), this->Mesh);
  }
  if (flat >= 0)
  {
    setDepth(*levels, depth);
    levels = turnedAcrossZ(std::move(*levels));
  }
  return sourceOf(std::make_unique<AmrPiece>(*levels, flow, tally, this->progressOf(0.02, 1)),
    ownBodies, outside);
}

std::shared_ptr<const schlieren::MediumSource> MediumMaker::sourceOfCells(
  const Choice& choice, vtkDataObject* bodies, std::string& warning)
{
  Flow flow = choice.flow;
  const int flat = choice.flatAxis;
  const double depth = flat < 0 ? 0 : depthOf(flow, flat);
  const std::string ofShape = choice.revolution && this->settings.isAxisymmetric()
    ? choice.revolution->note
    : choice.revolution || flat < 0 ? ""
                                    : warningOfExtrusion(flow, flat);
  if (choice.revolution)
  {
    flow = mirrored(flow, *choice.revolution);
  }
  this->progressOf(0, 1).reach(0.02);
  Tally tally;
  const auto made = this->makeOf(flow, flat, depth, bodies, tally);
  if (!made->hasGas())
  {
    throw std::runtime_error(noGas(flow.label));
  }
  warning = this->warningOf(flow, tally, bodies && !made->meetsBodies(), ofShape);
  if (choice.revolution)
  {
    return std::make_shared<RevolvedSource>(made, *choice.revolution);
  }
  return made;
}

} // namespace filters
