// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/InputDescription.h"

#include "Common/CellTypes.h"

#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSmartPointer.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

namespace filters
{

namespace
{

void describe(vtkDataSet* data, std::vector<double>& description)
{
  const auto addTime = [&description](vtkObject* object)
  { description.push_back(object ? static_cast<double>(object->GetMTime()) : 0); };
  for (int association : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* attributes = data->GetAttributes(association);
    description.push_back(attributes->GetNumberOfArrays());
    addTime(attributes->GetScalars());
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      addTime(attributes->GetAbstractArray(i));
    }
  }
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    const int* extent = image->GetExtent();
    description.insert(description.end(), extent, extent + 6);
    description.insert(description.end(), image->GetOrigin(), image->GetOrigin() + 3);
    description.insert(description.end(), image->GetSpacing(), image->GetSpacing() + 3);
    const double* direction = image->GetDirectionMatrix()->GetData();
    description.insert(description.end(), direction, direction + 9);
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(data))
  {
    addTime(rectilinear->GetXCoordinates());
    addTime(rectilinear->GetYCoordinates());
    addTime(rectilinear->GetZCoordinates());
  }
  else if (auto* structured = vtkStructuredGrid::SafeDownCast(data))
  {
    const int* extent = structured->GetExtent();
    description.insert(description.end(), extent, extent + 6);
    addTime(structured->GetPoints());
  }
  else if (auto* unstructured = vtkUnstructuredGrid::SafeDownCast(data))
  {
    addTime(unstructured->GetPoints());
    addTime(unstructured->GetCells());
    addTime(cellTypesOf(unstructured));
  }
  else if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    addTime(surface->GetPoints());
    addTime(surface->GetPolys());
    addTime(surface->GetStrips());
  }
  else
  {
    addTime(data);
  }
}

} // namespace

vtkMTimeType upstreamTime(vtkAlgorithm* filter, int port)
{
  if (filter->GetNumberOfInputConnections(port) == 0)
  {
    return 0;
  }
  auto* upstream = vtkDemandDrivenPipeline::SafeDownCast(filter->GetInputExecutive(port, 0));
  return upstream ? upstream->GetPipelineMTime() : 0;
}

vtkMTimeType upstreamTime(vtkAlgorithm* filter)
{
  vtkMTimeType time = 0;
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    time = std::max(time, upstreamTime(filter, port));
  }
  return time;
}

std::vector<vtkDataObject*> leavesOf(vtkDataObject* data)
{
  std::vector<vtkDataObject*> leaves;
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      leaves.push_back(iterator->GetCurrentDataObject());
    }
  }
  else if (data)
  {
    leaves.push_back(data);
  }
  return leaves;
}

std::vector<double> describeInput(vtkDataObject* input, vtkMTimeType pipelineTime)
{
  std::vector<double> description{ static_cast<double>(pipelineTime) };
  for (vtkDataObject* leaf : leavesOf(input))
  {
    if (auto* data = vtkDataSet::SafeDownCast(leaf))
    {
      describe(data, description);
    }
  }
  return description;
}

} // namespace filters
