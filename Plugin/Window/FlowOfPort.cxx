// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "FlowOfPort.h"

#include "FlowArrays.h"

#include "pqActiveObjects.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqServer.h"
#include "pqServerResource.h"
#include "vtkAlgorithm.h"
#include "vtkCellType.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPolyData.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

namespace
{

/// Sets a property that repeats its command for each value.
void setStrings(vtkSMProxy* filter, const char* name, const std::vector<std::string>& values)
{
  vtkSMPropertyHelper property(filter, name);
  property.SetNumberOfElements(static_cast<unsigned int>(values.size()));
  for (unsigned int i = 0; i < values.size(); ++i)
  {
    property.Set(i, values[i].c_str());
  }
}

/// Returns whether data have no surface and no volume, where this client has them.
bool isOfPointsAndLines(vtkDataObject* data)
{
  if (auto* blocks = vtkCompositeDataSet::SafeDownCast(data))
  {
    const auto leaf = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      if (!isOfPointsAndLines(leaf->GetCurrentDataObject()))
      {
        return false;
      }
    }
    return true;
  }
  auto* mesh = vtkPointSet::SafeDownCast(data);
  if (!vtkPolyData::SafeDownCast(data) && !vtkUnstructuredGrid::SafeDownCast(data))
  {
    return false;
  }
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    const int type = mesh->GetCellType(i);
    if (type != VTK_VERTEX && type != VTK_POLY_VERTEX && type != VTK_LINE && type != VTK_POLY_LINE)
    {
      return false;
    }
  }
  return true;
}

} // namespace

bool isApplied(pqPipelineSource* source)
{
  return source->modifiedState() != pqProxy::UNINITIALIZED;
}

QString notApplied(pqPipelineSource* source)
{
  return "'" + source->getSMName() + "' has not been applied yet. Press Apply first.";
}

QString problemOfServer(pqServer* server)
{
  if (server->proxyManager()->HasDefinition("filters", "Schlieren"))
  {
    return QString();
  }
  const pqServerResource resource = server->getResource();
  return "The server " + resource.host() + ":" + QString::number(resource.port()) +
    " has not loaded the plugin Schlieren, so no image can be made there. Choose Tools > Manage "
    "Plugins, and load Schlieren.so under Remote Plugins.";
}

QString problemOfFlow(pqOutputPort* port)
{
  if (!port)
  {
    return "There is no flow to make an image of. Open data, press Apply, and select them in the "
           "Pipeline Browser.";
  }
  const QString name = "'" + port->getSource()->getSMName() + "'";
  if (!isApplied(port->getSource()))
  {
    return notApplied(port->getSource());
  }
  port->getSourceProxy()->UpdatePipeline(); // data of a script may not be up to date
  vtkPVDataInformation* info = port->getDataInformation();
  if (info->IsNull() || info->GetNumberOfCells() < 1)
  {
    return name + " has no cells to send light through. Select data that fill a volume.";
  }
  if (!info->HasDataSetType("vtkDataSet"))
  {
    return name + " is no data set in space. Select data that fill a volume.";
  }
  auto* algorithm = vtkAlgorithm::SafeDownCast(port->getSourceProxy()->GetClientSideObject());
  if (algorithm && isOfPointsAndLines(algorithm->GetOutputDataObject(port->getPortNumber())))
  {
    return name +
      " has nothing but points or lines, so there is no volume for light to cross. Make a "
      "volume of particles with Point Volume Interpolator, SPH Volume Interpolator or "
      "Gaussian Resampling.";
  }
  return QString();
}

std::vector<FlowArray> arraysOfFlow(pqOutputPort* port)
{
  return arraysOf(port->getDataInformation());
}

void selectFlow(pqOutputPort* port)
{
  pqPipelineSource* source = port->getSource();
  if (source->getNumberOfOutputPorts() > 1)
  {
    pqActiveObjects::instance().setActivePort(port);
  }
  else
  {
    pqActiveObjects::instance().setActiveSource(source);
  }
}

std::array<double, 2> rangeOfArray(pqOutputPort* port, int association, const char* name)
{
  vtkPVArrayInformation* array = port->getDataInformation()->GetArrayInformation(name, association);
  if (!array)
  {
    return { 0, -1 };
  }
  const double* range = array->GetComponentFiniteRange(0);
  return { range[0], range[1] };
}

QString inWords(Completion::Kind kind)
{
  switch (kind)
  {
    case Completion::UniformPressure:
      return QString("Air at %1 Pa").arg(pressureOfRoom);
    case Completion::Water:
      return "Water";
    case Completion::Density:
      return "Density";
    case Completion::None:
      break;
  }
  return QString();
}

FlowDefaults completed(const std::vector<FlowArray>& arrays, const Completion& completion)
{
  switch (completion.kind)
  {
    case Completion::Water:
      return flowDefaults(arrays, MediumSettings::WATER);
    case Completion::Density:
    {
      FlowDefaults defaults;
      for (const FlowArray& array : arrays)
      {
        if (array.name == completion.array && defaults.arrays.empty())
        {
          defaults.arrays = { { "Density", array.name } };
          defaults.association = array.association;
          defaults.message = "Density: '" + array.name + "', as chosen.";
        }
      }
      return defaults;
    }
    case Completion::UniformPressure:
      return flowDefaultsAt(arrays, pressureOfRoom);
    case Completion::None:
      break;
  }
  return flowDefaults(arrays);
}

Completion offerFor(const std::vector<FlowArray>& arrays)
{
  const Completion air{ Completion::UniformPressure };
  return completed(arrays, air).arrays.empty() ? Completion() : air;
}

void setFlowDefaults(vtkSMProxy* filter, const FlowDefaults& defaults)
{
  vtkSMPropertyHelper(filter, "IndexModel").Set(defaults.indexModel);
  for (const auto& [property, array] : defaults.arrays)
  {
    vtkSMPropertyHelper(filter, property.c_str())
      .SetInputArrayToProcess(defaults.association, array.c_str());
  }
  for (const auto& [property, scale] : defaults.scales)
  {
    // Leaves units in names to the filter, which then also applies them to arrays chosen later.
    const std::string quantity = property.substr(0, property.find("Scale"));
    if (scaleByUnit(quantity, defaults.arrayOf(quantity)) != 0)
    {
      continue;
    }
    vtkSMPropertyHelper(filter, property.c_str()).Set(scale);
  }
  if (defaults.uniformPressure > 0)
  {
    vtkSMPropertyHelper(filter, "UniformPressure").Set(defaults.uniformPressure);
  }
  if (!defaults.fractions.empty())
  {
    setStrings(filter, "MixtureArrays", defaults.fractions);
    setStrings(filter, "MixtureGases", defaults.gases);
    vtkSMPropertyHelper(filter, "FractionType").Set(defaults.ofVolume ? 1 : 0);
  }
}
