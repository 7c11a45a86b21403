// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRefractiveIndex.h"

#include "AmrSource.h"
#include "ChannelRanks.h"
#include "FieldTints.h"
#include "FlatData.h"
#include "GasChoices.h"
#include "InputDescription.h"
#include "MeshSearch.h"
#include "MeshSource.h"
#include "Ranks.h"
#include "RefractivityByResampling.h"
#include "RefractivityOfAmr.h"
#include "RefractivityOfBodies.h"
#include "RefractivityOfImage.h"
#include "RefractivityOutside.h"
#include "RefractivitySource.h"
#include "SamplingBox.h"

#include "vtkFieldData.h"
#include "vtkGasTable.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"

#include "Rays/RayWorker.h"
#include "Schlieren.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

using namespace refractivity;

struct refractivity::GridPlan
{
  std::vector<double> key; // the input, and the filter's time; empty: not chosen yet
  std::optional<Amr> amr;
  Resampling resampling; // where it is no Amr
  vtkTypeInt64 count = 0;
};

/// Of the last MakeSource().
struct refractivity::KeptMesh
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

vtkStandardNewMacro(vtkRefractiveIndex);

namespace
{

std::string noGas(const Source& source)
{
  return "There is no valid value in the " + source.label +
    " (all are NaN, infinite, hidden, masked or no state of a gas), so there is no gas for light "
    "to cross. Choose another array or check the data.";
}

bool isZero(int count) { return count == 0; }

void addText(std::string& text, const std::string& more)
{
  text += (text.empty() || more.empty() ? "" : " ") + more;
}

void tellGrid(vtkImageData* grid, vtkInformation* outInfo)
{
  outInfo->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), grid->GetExtent(), 6);
  outInfo->Set(vtkDataObject::ORIGIN(), grid->GetOrigin(), 3);
  outInfo->Set(vtkDataObject::SPACING(), grid->GetSpacing(), 3);
  outInfo->Set(vtkDataObject::DIRECTION(), grid->GetDirectionMatrix()->GetData(), 9);
}

/// Most builds of ParaView run VTK's threaded loops on one core by default, and else on all of the machine.
vtkSMPTools::Config threadsOfLoops(vtkRefractiveIndex* self)
{
  const int given = self->GetNumberOfThreads();
  const int limit =
    given > 0 || std::getenv("VTK_SMP_MAX_THREADS") ? given : schlieren::coresOfProcess();
  return vtkSMPTools::Config(limit, "STDThread", false);
}

void printList(
  ostream& os, vtkIndent indent, const char* name, const std::vector<std::string>& texts)
{
  os << indent << name << ":";
  for (const std::string& text : texts)
  {
    os << " '" << text << "'";
  }
  os << "\n";
}

void printList(ostream& os, vtkIndent indent, const char* name, const std::vector<double>& values)
{
  os << indent << name << ":";
  for (const double value : values)
  {
    os << " " << value;
  }
  os << "\n";
}

} // namespace

//------------------------------------------------------------------------------
vtkRefractiveIndex::vtkRefractiveIndex()
  : Plan(std::make_shared<GridPlan>())
  , Mesh(std::make_shared<KeptMesh>())
  , Search(std::make_shared<MeshSearch>())
  , Ranks(std::make_shared<FilterRanks>())
  , Pieces(std::make_shared<ChannelRanks>(this))
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::KeepMeshSearch() { this->Search->isNeededAgain = true; }

//------------------------------------------------------------------------------
void vtkRefractiveIndex::DropMeshSearch()
{
  this->Search->isNeededAgain = false;
  if (!this->Search->isSeries)
  {
    this->Search->release();
  }
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ShareMeshSearch(vtkRefractiveIndex* owner)
{
  this->Search = owner->Search;
  this->IsSearchShared = true;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractiveIndex::GetMeshSearches() { return this->Search->count; }

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractiveIndex::GetMeshBuilds() { return this->Mesh->builds; }

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractiveIndex::GetGridPlans() { return this->Plan->count; }

//------------------------------------------------------------------------------
void vtkRefractiveIndex::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "IndexModel: " << this->IndexModel << "\n";
  os << indent << "Gas: " << this->Gas << "\n";
  os << indent << "GladstoneDaleConstant: " << this->GladstoneDaleConstant << "\n";
  os << indent << "DensityScale: " << this->DensityScale << "\n";
  printList(os, indent, "MixtureArrays", this->MixtureArrays);
  printList(os, indent, "MixtureGases", this->MixtureGases);
  printList(os, indent, "MixtureConstants", this->MixtureConstants);
  printList(os, indent, "MixtureMolarMasses", this->MixtureMolarMasses);
  os << indent << "BackgroundGas: " << this->BackgroundGas << "\n";
  os << indent << "BackgroundConstant: " << this->BackgroundConstant << "\n";
  os << indent << "BackgroundMolarMass: " << this->BackgroundMolarMass << "\n";
  os << indent << "FractionType: " << this->FractionType << "\n";
  os << indent << "TemperatureScale: " << this->TemperatureScale << "\n";
  os << indent << "PressureScale: " << this->PressureScale << "\n";
  os << indent << "RelativeHumidity: " << this->RelativeHumidity << "\n";
  os << indent << "CO2: " << this->CO2 << "\n";
  os << indent << "Wavelength: " << this->Wavelength << "\n";
  printList(os, indent, "Fields", this->Fields);
  os << indent << "TransferFunctions: " << this->TransferFunctions.size() << "\n";
  printList(os, indent, "FieldRanges", this->FieldRanges);
  os << indent << "RefractivityScale: " << this->RefractivityScale << "\n";
  os << indent << "SamplingDimensions: " << this->SamplingDimensions[0] << " "
     << this->SamplingDimensions[1] << " " << this->SamplingDimensions[2] << "\n";
  printList(os, indent, "SamplingBounds",
    std::vector<double>(this->SamplingBounds, this->SamplingBounds + 6));
  os << indent << "MaskThreshold: " << this->MaskThreshold << "\n";
  os << indent << "MaskedSide: " << this->MaskedSide << "\n";
  os << indent << "Outside: " << this->Outside << "\n";
  os << indent << "Reconstruction: " << this->Reconstruction << "\n";
  os << indent << "Grid: " << this->Grid << "\n";
  os << indent << "DoublePrecision: " << this->DoublePrecision << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::AddMixtureArray(const char* name)
{
  this->MixtureArrays.emplace_back(name ? name : "");
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ClearMixtureArrays()
{
  this->MixtureArrays.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::AddMixtureGas(const char* name)
{
  this->MixtureGases.emplace_back(name ? name : "");
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ClearMixtureGases()
{
  this->MixtureGases.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
double vtkRefractiveIndex::GetGladstoneDaleConstantUsed()
{
  return isCustom(this->Gas) ? this->GladstoneDaleConstant
                             : vtkGasTable::GetConstant(this->Gas, this->Wavelength);
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::AddMixtureConstant(double constant)
{
  this->MixtureConstants.push_back(constant);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ClearMixtureConstants()
{
  this->MixtureConstants.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::AddMixtureMolarMass(double molarMass)
{
  this->MixtureMolarMasses.push_back(molarMass);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ClearMixtureMolarMasses()
{
  this->MixtureMolarMasses.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::AddField(const char* name)
{
  this->Fields.emplace_back(name ? name : "");
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ClearFields()
{
  this->Fields.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::AddTransferFunction(vtkPiecewiseFunction* function)
{
  this->TransferFunctions.emplace_back(function);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ClearTransferFunctions()
{
  this->TransferFunctions.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::AddFieldRange(double value)
{
  this->FieldRanges.push_back(value);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ClearFieldRanges()
{
  this->FieldRanges.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
vtkMTimeType vtkRefractiveIndex::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (vtkPiecewiseFunction* function : this->TransferFunctions)
  {
    time = std::max(time, function ? function->GetMTime() : 0);
  }
  return time;
}

//------------------------------------------------------------------------------
bool vtkRefractiveIndex::HasArray(int index)
{
  const char* name = this->GetInputArrayInformation(index)->Get(vtkDataObject::FIELD_NAME());
  return name && *name && std::string(name) != "None";
}

//------------------------------------------------------------------------------
vtkTypeBool vtkRefractiveIndex::ProcessRequest(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    this->Ranks->CountChanges(this);
  }
  return this->Superclass::ProcessRequest(request, input, output);
}

//------------------------------------------------------------------------------
int vtkRefractiveIndex::FillInputPortInformation(int port, vtkInformation* info)
{
  // Of bodies, too, so that Convert can say what is wrong with other types than vtkPolyData.
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  if (port == BODIES)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ComputeGrid(vtkDataObject* input, vtkImageData* structure)
{
  const Source source = chooseSource(this, input);
  if (source.image)
  {
    gridOfImage(source.image, source.leaves[0].ofCells, structure);
    SamplingBox(this->SamplingBounds).crop(structure);
  }
  else
  {
    const GridPlan& plan = this->PlanGrid(source, input);
    plan.amr ? gridOf(*plan.amr, structure) : gridOf(plan.resampling, structure);
  }
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ComputeBox(vtkDataObject* input, vtkImageData* structure)
{
  gridOf(boxOf(chooseSource(this, input)), structure);
}

//------------------------------------------------------------------------------
const GridPlan& vtkRefractiveIndex::PlanGrid(const Source& source, vtkDataObject* input)
{
  GridPlan& plan = *this->Plan;
  std::vector<double> key = describeInput(input, this->GetMTime());
  if (plan.key != key)
  {
    plan.key.clear();
    ++plan.count;
    const SamplingBox box(this->SamplingBounds);
    plan.amr = planAmr(source, this->SamplingDimensions, box);
    if (!plan.amr)
    {
      plan.resampling = planResampling(source, this->SamplingDimensions, box);
    }
    plan.key = std::move(key);
  }
  return plan;
}

//------------------------------------------------------------------------------
std::string vtkRefractiveIndex::NewNoteOnGases(const Source& source)
{
  if (source.noteOnGases == this->ToldOfGases)
  {
    return "";
  }
  this->ToldOfGases = source.noteOnGases;
  return source.noteOnGases;
}

//------------------------------------------------------------------------------
bool vtkRefractiveIndex::CanMakeSource(vtkDataObject* input)
{
  const Source source = chooseSource(this, input);
  const int* given = this->SamplingDimensions;
  if (source.image || SamplingBox(this->SamplingBounds).isGiven() ||
    !std::all_of(given, given + 3, isZero))
  {
    return false;
  }
  flatAxisOf(source); // throws where there is no volume and no plane
  return true;
}

//------------------------------------------------------------------------------
std::shared_ptr<const schlieren::MediumSource> vtkRefractiveIndex::MakeSource(
  vtkDataObject* input, vtkDataObject* bodies, std::string& warning, SourceContents contents)
{
  Source source = chooseSource(this, input);
  const int flat = flatAxisOf(source);
  this->Grid.clear();
  this->Search->release();
  Tally tally;
  bool hasGas = false, meetsBodies = false;
  std::string ofMesh;
  std::shared_ptr<const schlieren::MediumSource> result;
  const auto take = [&](const auto& made)
  {
    hasGas = made->hasGas();
    meetsBodies = made->meetsBodies();
    result = made;
  };
  const WorkProgress progress(
    [this](double done)
    {
      this->UpdateProgress(done);
      return !this->GetAbortExecute();
    });
  const auto make = [&]
  {
    if (auto* mean = std::get_if<FieldMean>(&source.model))
    {
      mean->findRanges(source.leaves);
    }
    std::vector<FieldValues> fields;
    if (contents == WITH_FIELDS)
    {
      fields = fieldValues(this, input, source);
    }
    progress.reach(0.02);
    const auto outside = static_cast<refractivity::Outside>(this->Outside);
    const vtkSmartPointer<vtkDataObject> ownBodies = turnedBodies(bodies, flat);
    if (std::optional<AmrLevels> levels = findLevels(source.leaves))
    {
      levels = turnedAcrossZ(std::move(*levels));
      const auto made = std::make_shared<AmrSource>(
        *levels, source, ownBodies, outside, tally, progress.part(0.02, 1));
      for (FieldValues& field : fields)
      {
        bringToCells(field);
        made->addField(*levels, field.source);
      }
      take(made);
      return;
    }
    if (flat >= 0)
    {
      source = extruded(source, flat);
      for (FieldValues& field : fields)
      {
        field.source = extruded(field.source, flat);
      }
    }
    const bool isSmooth = this->Reconstruction != LINEAR_IN_CELLS;
    const auto cellValues = isSmooth ? CellValues::Known : CellValues::Averaged;
    const auto leaves = preparedLeaves(source, cellValues, tally);
    progress.reach(0.1);
    const auto reconstruction =
      isSmooth ? CellTree::Reconstruction::Smooth : CellTree::Reconstruction::Linear;
    const std::uint64_t key = MeshSource::keyOf(leaves, ownBodies, outside, reconstruction);
    KeptMesh& kept = *this->Mesh;
    const WorkProgress ofMedium = progress.part(0.1, fields.empty() ? 1 : 0.8);
    std::shared_ptr<MeshSource> made;
    if (kept.key == key)
    {
      made = std::make_shared<MeshSource>(leaves, kept.mesh, ofMedium, flat);
    }
    else
    {
      kept.release();
      ++kept.builds;
      made =
        std::make_shared<MeshSource>(leaves, ownBodies, outside, reconstruction, ofMedium, flat);
      kept.key = key;
    }
    kept.mesh = made->mesh();
    ofMesh = kept.mesh.warning;
    const auto begunAt = [&](std::size_t number)
    { return 0.8 + 0.2 * static_cast<double>(number) / static_cast<double>(fields.size()); };
    for (std::size_t number = 0; number < fields.size(); ++number)
    {
      Tally notReported;
      made->addField(preparedLeaves(fields[number].source, cellValues, notReported),
        progress.part(begunAt(number), begunAt(number + 1)));
    }
    take(made);
  };
  try
  {
    vtkSMPTools::LocalScope(threadsOfLoops(this), make);
  }
  catch (const Stopped&)
  {
    return nullptr;
  }
  if (!hasGas)
  {
    throw std::runtime_error(noGas(source));
  }
  warning = warningFrom(source.model, tally);
  addText(warning, ofMesh);
  if (bodies && !meetsBodies)
  {
    addText(warning, bodiesAreOutside);
  }
  addText(warning, this->NewNoteOnGases(source));
  if (flat >= 0)
  {
    addText(warning, warningOfExtrusion(flat));
  }
  return result;
}

//------------------------------------------------------------------------------
bool vtkRefractiveIndex::CanUsePieces()
{
  const int* given = this->SamplingDimensions;
  return this->IndexModel != TRANSFER_FUNCTIONS && std::all_of(given, given + 3, isZero) &&
    !SamplingBox(this->SamplingBounds).isGiven();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::SetPieceChannels(std::vector<schlieren::Channel*> channels)
{
  this->Pieces->SetChannels(std::move(channels));
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ReleasePieces()
{
  if (std::exchange(this->HasPieces, false))
  {
    try
    {
      this->Pieces->Ask(
        std::vector<std::vector<char>>(this->Pieces->Count(), pieceRequest(PieceWorker::Forget)));
    }
    catch (const std::runtime_error&)
    {
      // A rank has not come. It forgets its piece when the next one is made.
    }
  }
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::SetPieceData(vtkDataObject* data) { this->Pieces->GetOwn().SetData(data); }

//------------------------------------------------------------------------------
std::vector<char> vtkRefractiveIndex::RespondForPiece(const std::vector<char>& message)
{
  if (!PieceWorker::IsFor(schlieren::RayWorker::kindOf(message)))
  {
    return {};
  }
  this->Pieces->SetThreads(threadsOfLoops(this));
  return this->Pieces->Respond(message);
}

//------------------------------------------------------------------------------
std::shared_ptr<const schlieren::MediumSource> vtkRefractiveIndex::MakeSourceOfPieces(
  vtkDataObject* input, vtkDataObject* bodies, std::string& warning)
{
  this->Grid.clear();
  this->Search->release();
  this->Mesh->release();
  this->Pieces->SetThreads(threadsOfLoops(this));
  this->SetPieceData(input);
  this->HasPieces = true;
  std::shared_ptr<PiecesSource> made;
  try
  {
    vtkSMPTools::LocalScope(threadsOfLoops(this),
      [&]
      {
        made = std::make_shared<PiecesSource>(this->Pieces, bodies,
          static_cast<refractivity::Outside>(this->Outside),
          WorkProgress(
            [this](double done)
            {
              this->UpdateProgress(done);
              return !this->GetAbortExecute();
            }));
      });
  }
  catch (const Stopped&)
  {
    this->SetPieceData(nullptr);
    return nullptr;
  }
  this->SetPieceData(nullptr);
  Source source;
  source.model = modelFrom(this);
  source.noteOnGases = noteOnGases(this);
  source.label = made->label();
  if (!made->hasGas())
  {
    throw std::runtime_error(noGas(source));
  }
  warning = warningFrom(source.model, made->tally());
  addText(warning, made->warning());
  if (bodies && !made->meetsBodies())
  {
    addText(warning, bodiesAreOutside);
  }
  addText(warning, this->NewNoteOnGases(source));
  return made;
}

//------------------------------------------------------------------------------
std::string vtkRefractiveIndex::Convert(
  vtkDataObject* input, vtkImageData* output, vtkDataObject* bodies)
{
  output->Initialize();
  this->Grid.clear();
  this->Mesh->release();
  Source source = chooseSource(this, input);
  this->UpdateProgress(0.05);
  if (this->GetAbortExecute())
  {
    return "";
  }

  const vtkSMPTools::Config threads = threadsOfLoops(this);
  Tally tally;
  std::string note = "the data's own";
  vtkSMPTools::LocalScope(threads,
    [&]()
    {
      if (auto* fields = std::get_if<FieldMean>(&source.model))
      {
        fields->findRanges(source.leaves);
      }
      if (source.image)
      {
        this->Search->release();
        tally = convertImage(source, this->DoublePrecision, output);
        SamplingBox(this->SamplingBounds).crop(output);
      }
      else if (const GridPlan& plan = this->PlanGrid(source, input); plan.amr)
      {
        this->Search->release();
        note = plan.amr->note;
        tally = convertAmr(*plan.amr, source, this->DoublePrecision, output);
        if (!this->GetOutsideBlocksLight())
        {
          setOutside(outsideOfBoxes(source.leaves, output), output);
        }
      }
      else
      {
        note = plan.resampling.note;
        const bool wasSeries = this->Search->isSeries;
        tally = resample(
          plan.resampling, source, this->DoublePrecision, this->GetOutsideBlocksLight(),
          *this->Search,
          [this](double done)
          {
            this->UpdateProgress(0.05 + 0.95 * done);
            return !this->GetAbortExecute();
          },
          output);
        if (this->IsSearchShared)
        {
          this->Search->isSeries = wasSeries;
        }
      }
    });

  if (this->GetAbortExecute())
  {
    output->Initialize();
    return "";
  }
  const unsigned char* valid =
    vtkUnsignedCharArray::SafeDownCast(output->GetPointData()->GetArray(maskName))->GetPointer(0);
  const auto hasGas = [&]
  {
    return std::any_of(
      valid, valid + output->GetNumberOfPoints(), [](unsigned char v) { return v != 0; });
  };
  if (!hasGas())
  {
    throw std::runtime_error(noGas(source));
  }
  std::string warning = warningFrom(source.model, tally);
  if (bodies)
  {
    addText(warning, placeBodies(bodies, output));
    if (!hasGas())
    {
      throw std::runtime_error("The Bodies cover all of the gas, so there is none for light to "
                               "cross. Leave out what encloses the flow.");
    }
  }

  int dimensions[3];
  output->GetDimensions(dimensions);
  this->Grid = std::to_string(dimensions[0]) + " x " + std::to_string(dimensions[1]) + " x " +
    std::to_string(dimensions[2]) + " points: " + note;
  vtkDebugMacro(<< "Refractivity from the " << source.label << " on " << this->Grid);
  vtkNew<vtkIntArray> used;
  used->SetName("SamplingDimensions");
  used->SetNumberOfComponents(3);
  used->InsertNextTypedTuple(dimensions);
  output->GetFieldData()->AddArray(used);
  addText(warning, this->NewNoteOnGases(source));
  if (const int flat = flatAxisOf(source); flat >= 0)
  {
    addText(warning, warningOfExtrusion(flat));
  }
  return warning;
}

//------------------------------------------------------------------------------
int vtkRefractiveIndex::RequestInformation(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* inInfo = inputVector[0]->GetInformationObject(0);
  vtkInformation* outInfo = outputVector->GetInformationObject(0);

  vtkNew<vtkImageData> grid;
  try
  {
    vtkDataObject* input = vtkDataObject::GetData(inInfo);
    if (vtkImageData::SafeDownCast(input) &&
      inInfo->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()) &&
      inInfo->Has(vtkDataObject::ORIGIN()) && inInfo->Has(vtkDataObject::SPACING()))
    {
      // Not the input's own grid: it may be older, or be a part of the whole.
      vtkNew<vtkImageData> whole;
      whole->SetExtent(inInfo->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()));
      whole->SetOrigin(inInfo->Get(vtkDataObject::ORIGIN()));
      whole->SetSpacing(inInfo->Get(vtkDataObject::SPACING()));
      if (inInfo->Has(vtkDataObject::DIRECTION()))
      {
        whole->SetDirectionMatrix(inInfo->Get(vtkDataObject::DIRECTION()));
      }
      gridOfImage(whole, willReadCells(this, input), grid);
      SamplingBox(this->SamplingBounds).crop(grid);
    }
    else
    {
      this->ComputeGrid(input, grid);
    }
  }
  catch (const std::exception&)
  {
    // Nobody can tell before the input's points and arrays are there; RequestData will. Every grid that
    // is resampled to holds this one, so that nobody asks for more than there will be.
    grid->SetDimensions(2, 2, 2);
    if (*std::min_element(this->SamplingDimensions, this->SamplingDimensions + 3) > 1)
    {
      grid->SetDimensions(this->SamplingDimensions);
    }
  }
  tellGrid(grid, outInfo);
  vtkDataObject::SetActiveAttribute(
    outInfo, vtkDataObject::FIELD_ASSOCIATION_POINTS, arrayName, vtkDataSetAttributes::SCALARS);
  vtkDataObject::SetPointDataActiveScalarInfo(
    outInfo, this->DoublePrecision ? VTK_DOUBLE : VTK_FLOAT, 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkRefractiveIndex::RequestUpdateExtent(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* vtkNotUsed(outputVector))
{
  if (this->Ranks->Request(this, inputVector))
  {
    this->FailedAt = 0; // of another time step, perhaps
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkRefractiveIndex::RequestData(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  vtkImageData* output = vtkImageData::GetData(outInfo);

  output->Initialize();
  setComplete(outputVector);

  // An empty output lets the pipeline ask again and again, on rank 0 alone: one message is enough.
  const auto latestChange = [this]() {
    return std::max({ this->GetMTime(), upstreamTime(this, 0), upstreamTime(this, BODIES) });
  };
  const vtkMTimeType now = latestChange();
  if (this->FailedAt == now)
  {
    return 1;
  }
  FilterRanks::Meeting meeting(*this->Ranks,
    FilterRanks::Inputs{ vtkDataObject::GetData(inputVector[0]),
      vtkDataObject::GetData(inputVector[BODIES]), refractivity::arraysOf(this) });
  if (!isRank0())
  {
    meeting.Serve(this->NumberOfThreads);
    return 1;
  }

  try
  {
    const FilterRanks::Inputs inputs = meeting.Gather();
    this->SetAbortExecute(0); // it stays set after an abort
    const std::string warning = this->Convert(inputs.data, output, inputs.bodies);
    if (!warning.empty())
    {
      vtkWarningMacro(<< warning);
    }
    if (this->GetAbortExecute())
    {
      this->FailedAt = latestChange(); // whoever asks again need not wait again
      return 1;
    }
    // Where RequestInformation could not tell it. Without the second, VTK would crop the output.
    tellGrid(output, outInfo);
    outInfo->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), output->GetExtent(), 6);
    setComplete(outputVector);
    return 1;
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro(<< "There is not enough memory for the refractivity grid. Use a coarser input or "
                     "smaller SamplingDimensions.");
  }
  catch (const std::exception& problem)
  {
    vtkErrorMacro(<< problem.what());
  }
  output->Initialize();
  this->FailedAt = now;
  return 1;
}
