// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageDisplay.h"

#include "vtkDataObject.h"
#include "vtkPVArrayInformation.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMTrace.h"
#include "vtkSMTransferFunctionProxy.h"
#include "vtkSchlierenFilter.h"

#include <string>

namespace
{

using Filter = vtkSchlierenFilter;

int valueOf(vtkSMProxy* proxy, const char* name)
{
  return vtkSMPropertyHelper(proxy, name).GetAsInt();
}

void setValue(vtkSMProxy* proxy, const char* name, int value)
{
  vtkSMPropertyHelper property(proxy, name);
  if (property.GetAsInt() != value)
  {
    property.Set(value);
  }
}

/// Sets MapScalars without colouring by an array: an open editor of colour maps would else fit the
/// map to the data and warn if these lack the array. Undo restores it in the same order, because
/// each step is an update of its own.
void setMapScalars(vtkSMProxy* representation, int value)
{
  if (valueOf(representation, "MapScalars") == value)
  {
    return;
  }
  vtkSMPropertyHelper(representation, "ColorArrayName")
    .SetInputArrayToProcess(vtkDataObject::POINT, "");
  representation->UpdateVTKObjects();
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", representation);
  vtkSMPropertyHelper(representation, "MapScalars").Set(value);
  representation->UpdateVTKObjects();
}

/// Colours by an array of points, by a map of its own or as the values are. Returns the map.
vtkSMProxy* colorBy(vtkSMProxy* representation, const char* array, bool isMapped)
{
  setValue(representation, "UseSeparateColorMap", 1);
  setMapScalars(representation, isMapped ? 1 : 0);
  if (auto* colored = vtkSMPVRepresentationProxy::SafeDownCast(representation))
  {
    colored->SetScalarColoring(array, vtkDataObject::POINT);
  }
  representation->UpdateVTKObjects();
  return vtkSMPropertyHelper(representation, "LookupTable").GetAsProxy();
}

} // namespace

void ImageDisplay::apply(vtkSMProxy* representation, vtkSMProxy* filter)
{
  const bool isColored = white(filter) == 0;
  vtkSMProxy* map = colorBy(representation, isColored ? "Color" : "Intensity", !isColored);
  if (!isColored && map)
  {
    vtkSMTransferFunctionProxy::ApplyPreset(map, "Grayscale", false);
    vtkSMTransferFunctionProxy::RescaleTransferFunction(map, 0, white(filter));
    // Disables rescaling, whose range for converging light would darken all else.
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", map);
    vtkSMPropertyHelper(map, "AutomaticRescaleRangeMode").Set(-1);
    map->UpdateVTKObjects();
  }
}

void ImageDisplay::applyToPhotograph(vtkSMProxy* representation, vtkPVArrayInformation* values)
{
  const bool areBytes = values->GetDataType() == VTK_UNSIGNED_CHAR;
  vtkSMProxy* map = colorBy(representation, values->GetName(), !areBytes);
  if (!areBytes && map)
  {
    vtkSMTransferFunctionProxy::ApplyPreset(map, "Grayscale", true);
  }
}

double ImageDisplay::white(vtkSMProxy* filter)
{
  const int cutoff = valueOf(filter, "Cutoff");
  const bool isColored = Filter::CutoffHasColor(cutoff, valueOf(filter, "BackgroundPattern"));
  return isColored ? 0 : Filter::CutoffWhite(cutoff);
}

bool ImageDisplay::isApplied(vtkSMProxy* representation)
{
  if (!representation->GetProperty("ColorArrayName") ||
    !representation->GetProperty("UseSeparateColorMap"))
  {
    return false;
  }
  const char* name =
    vtkSMPropertyHelper(representation, "ColorArrayName").GetInputArrayNameToProcess();
  const std::string array = name ? name : "";
  return valueOf(representation, "UseSeparateColorMap") != 0 &&
    (array == "Color" || array == "Intensity");
}
