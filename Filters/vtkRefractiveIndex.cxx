// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRefractiveIndex.h"

#include "RefractivityByResampling.h"
#include "RefractivityOfImage.h"
#include "RefractivitySource.h"

#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <new>
#include <stdexcept>

using namespace refractivity;

vtkStandardNewMacro(vtkRefractiveIndex);

namespace
{

void tellGrid(vtkImageData* grid, vtkInformation* outInfo)
{
  outInfo->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), grid->GetExtent(), 6);
  outInfo->Set(vtkDataObject::ORIGIN(), grid->GetOrigin(), 3);
  outInfo->Set(vtkDataObject::SPACING(), grid->GetSpacing(), 3);
  outInfo->Set(vtkDataObject::DIRECTION(), grid->GetDirectionMatrix()->GetData(), 9);
}

} // namespace

//------------------------------------------------------------------------------
vtkRefractiveIndex::vtkRefractiveIndex() = default;

//------------------------------------------------------------------------------
void vtkRefractiveIndex::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "IndexModel: " << this->IndexModel << "\n";
  os << indent << "GladstoneDaleConstant: " << this->GladstoneDaleConstant << "\n";
  os << indent << "DensityScale: " << this->DensityScale << "\n";
  os << indent << "SamplingDimensions: " << this->SamplingDimensions[0] << " "
     << this->SamplingDimensions[1] << " " << this->SamplingDimensions[2] << "\n";
  os << indent << "DoublePrecision: " << this->DoublePrecision << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}

//------------------------------------------------------------------------------
int vtkRefractiveIndex::FillInputPortInformation(int vtkNotUsed(port), vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ComputeGrid(vtkDataObject* input, vtkImageData* structure)
{
  const Source source = chooseSource(this, input);
  if (source.image)
  {
    gridOfImage(source.image, source.leaves[0].ofCells, structure);
  }
  else
  {
    gridOf(planResampling(source, this->SamplingDimensions), structure);
  }
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::Convert(vtkDataObject* input, vtkImageData* output)
{
  output->Initialize();
  const Source source = chooseSource(this, input);
  this->UpdateProgress(0.05);
  if (this->GetAbortExecute())
  {
    return;
  }

  // Most builds of ParaView run VTK's threaded loops on one core unless told otherwise.
  const vtkSMPTools::Config threads(this->NumberOfThreads, "STDThread", false);
  vtkSMPTools::LocalScope(threads,
    [&]()
    {
      if (source.image)
      {
        convertImage(source, this->DoublePrecision, output);
      }
      else
      {
        const Resampling plan = planResampling(source, this->SamplingDimensions);
        resample(plan, source, this->DoublePrecision, output);
      }
    });

  const unsigned char* valid =
    vtkUnsignedCharArray::SafeDownCast(output->GetPointData()->GetArray(maskName))->GetPointer(0);
  if (std::none_of(
        valid, valid + output->GetNumberOfPoints(), [](unsigned char v) { return v != 0; }))
  {
    throw std::runtime_error("The array '" + source.label +
      "' has no valid value (all are NaN, infinite, hidden or masked), so there is no gas for "
      "light to cross. Choose another array or check the data.");
  }

  int dimensions[3];
  output->GetDimensions(dimensions);
  vtkDebugMacro(<< "Refractivity from '" << source.label << "' on " << dimensions[0] << " x "
                << dimensions[1] << " x " << dimensions[2] << " points.");
  vtkNew<vtkIntArray> used;
  used->SetName("SamplingDimensions");
  used->SetNumberOfComponents(3);
  used->InsertNextTypedTuple(dimensions);
  output->GetFieldData()->AddArray(used);
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
  vtkInformation* inInfo = inputVector[0]->GetInformationObject(0);
  if (inInfo->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
  {
    inInfo->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(),
      inInfo->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()), 6);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkRefractiveIndex::RequestData(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  vtkImageData* output = vtkImageData::GetData(outInfo);
  try
  {
    this->SetAbortExecute(0); // it stays set after an abort
    this->Convert(vtkDataObject::GetData(inputVector[0]), output);
    if (!this->GetAbortExecute())
    {
      // Where RequestInformation could not tell it. Without the second, VTK would crop the output.
      tellGrid(output, outInfo);
      outInfo->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), output->GetExtent(), 6);
    }
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro(<< "There is not enough memory for the refractivity grid. Use a coarser input or "
                     "smaller SamplingDimensions.");
    output->Initialize();
  }
  catch (const std::exception& problem)
  {
    vtkErrorMacro(<< problem.what());
    output->Initialize();
  }
  return 1;
}
