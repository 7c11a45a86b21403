// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeDisplay.h"

#include "FlowDefaults.h"
#include "FlowOfPort.h"

#include "pqDataRepresentation.h"
#include "pqOutputPort.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "vtkDataObject.h"
#include "vtkGasTable.h"
#include "vtkNew.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace
{

/// Returns the array's value at the ambient refractivity; NaN if that depends on several arrays.
double ambientValue(vtkSMProxy* model, const FlowDefaults& defaults)
{
  vtkPVArrayInformation* array =
    vtkSMSourceProxy::SafeDownCast(model)->GetDataInformation(0)->GetArrayInformation(
      "AmbientRefractivity", vtkDataObject::FIELD);
  if (array)
  {
    const double* ambient = array->GetComponentFiniteRange(0);
    const auto given =
      static_cast<MediumSettings::IndexModels>(vtkSMPropertyHelper(model, "IndexModel").GetAsInt());
    const double scale = vtkSMPropertyHelper(model, "DensityScale").GetAsDouble();
    const double byUnit = scaleByUnit("Density", defaults.arrayOf("Density"));
    switch (given < 0 ? defaults.indexModel : given)
    {
      case MediumSettings::GLADSTONE_DALE:
      {
        const double given = vtkSMPropertyHelper(model, "GladstoneDaleConstant").GetAsDouble();
        const double constant = given != 0
          ? given
          : vtkGasTable::GetConstant(vtkSMPropertyHelper(model, "Gas").GetAsString(),
              vtkSMPropertyHelper(model, "Wavelength").GetAsDouble());
        return ambient[0] / (constant * (scale != 0 ? scale : byUnit != 0 ? byUnit : 1));
      }
      case MediumSettings::REFRACTIVE_INDEX:
        return 1 + ambient[0];
      case MediumSettings::REFRACTIVITY:
        return ambient[0];
      case MediumSettings::AUTO:
      case MediumSettings::GLADSTONE_DALE_MIXTURE:
      case MediumSettings::CIDDOR:
      case MediumSettings::TRANSFER_FUNCTIONS:
      case MediumSettings::ELECTRON_DENSITY:
        break; // the scale of a density that is no longer alone, or of no density, is not known
    }
  }
  return std::nan("");
}

/// Clamps to the range, and to the nearer end if equal up to rounding, because tables do not
/// separate nodes that close.
double withinRange(double value, const std::array<double, 2>& range)
{
  const double margin = 1e-3 * (range[1] - range[0]);
  if (std::abs(value - range[1]) < margin)
  {
    return range[1];
  }
  return value > range[0] + margin && value < range[1] ? value : range[0];
}

/// Makes the ambient value transparent and the values most different from it dim.
void setOpacity(vtkSMProxy* opacity, const std::array<double, 2>& range, double ambient)
{
  constexpr double most = 0.5;
  const double largest = std::max(range[1] - ambient, ambient - range[0]);
  const auto opacityAt = [&](double value)
  { return largest > 0 ? most * std::abs(value - ambient) / largest : 0; };
  std::vector<double> nodes;
  for (const double value : { range[0], ambient, range[1] })
  {
    if (nodes.empty() || value > nodes[nodes.size() - 4])
    {
      const double node[4] = { value, opacityAt(value), 0.5, 0 };
      nodes.insert(nodes.end(), node, node + 4);
    }
  }
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", opacity);
  vtkSMPropertyHelper(opacity, "Points").Set(nodes.data(), static_cast<unsigned int>(nodes.size()));
  opacity->UpdateVTKObjects();
}

} // namespace

void showAsVolume(
  pqOutputPort* flow, pqRenderView* view, const FlowDefaults& defaults, vtkSMProxy* bench)
{
  const bool isImage = flow->getDataInformation()->DataSetTypeIsA("vtkImageData");
  const int* extent = flow->getDataInformation()->GetExtent();
  const bool isFlat = extent[0] == extent[1] || extent[2] == extent[3] || extent[4] == extent[5];
  if (!isImage || isFlat || defaults.arrays.empty())
  {
    return;
  }
  pqDataRepresentation* before = flow->getRepresentation(view);
  if (before && before->isVisible() &&
    std::strcmp(vtkSMPropertyHelper(before->getProxy(), "Representation").GetAsString(), "Outline"))
  {
    return;
  }
  // Keeps the user's colours and opacities of this array.
  const std::string& array = defaults.arrays.front().second;
  const std::string name = array + ".PiecewiseFunction";
  vtkSMSessionProxyManager* manager = flow->getServer()->proxyManager();
  const bool isNew = !manager->GetProxy("piecewise_functions", name.c_str());

  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  auto* shown = vtkSMPVRepresentationProxy::SafeDownCast(
    controller->Show(flow->getSourceProxy(), flow->getPortNumber(), view->getRenderViewProxy()));
  const std::array<double, 2> range = rangeOfArray(flow, defaults.association, array.c_str());
  if (!shown || !(range[0] < range[1]))
  {
    return;
  }
  shown->SetScalarColoring(array.c_str(), defaults.association);
  if (isNew)
  {
    shown->RescaleTransferFunctionToDataRange(false, true);
    vtkSMProxy* opacity = vtkSMPropertyHelper(shown, "ScalarOpacityFunction").GetAsProxy();
    if (opacity)
    {
      setOpacity(opacity, range, withinRange(ambientValue(bench, defaults), range));
    }
  }
  vtkSMRepresentationProxy::SetRepresentationType(shown, "Volume");
  shown->UpdateVTKObjects();
}
