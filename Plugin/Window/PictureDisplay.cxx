// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PictureDisplay.h"

#include "pqUndoStack.h"
#include "pqView.h"
#include "vtkDataObject.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"
#include "vtkSMTransferFunctionProxy.h"
#include "vtkSchlierenFilter.h"

#include <QVariant>

#include <algorithm>
#include <string>

namespace
{

using Filter = vtkSchlierenFilter;

/// A property of a view whose image is still to come.
constexpr const char* isToBeFilled = "SchlierenIsToBeFilled";

int valueOf(vtkSMProxy* proxy, const char* name)
{
  return vtkSMPropertyHelper(proxy, name).GetAsInt();
}

bool hasColors(vtkSMProxy* filter)
{
  return valueOf(filter, "ColorByField") != 0 ||
    Filter::CutoffHasColor(valueOf(filter, "Cutoff"), valueOf(filter, "WhiteLight") != 0,
      valueOf(filter, "BackgroundPattern"));
}

double white(vtkSMProxy* filter)
{
  return Filter::CutoffHasScreen(valueOf(filter, "Cutoff")) ? 2 : 1;
}

std::string shownArray(vtkSMProxy* representation)
{
  const char* name =
    vtkSMPropertyHelper(representation, "ColorArrayName").GetInputArrayNameToProcess();
  return name ? name : "";
}

/// What is white, where the colour map goes from 0 up to one of the values of white(); else 0.
double shownWhite(vtkSMProxy* representation)
{
  vtkSMProxy* colors = vtkSMPropertyHelper(representation, "LookupTable").GetAsProxy();
  if (!colors)
  {
    return 0;
  }
  // Nodes of four values; the first is the place.
  const auto nodes = vtkSMPropertyHelper(colors, "RGBPoints").GetDoubleArray();
  if (nodes.size() < 8 || nodes.front() != 0)
  {
    return 0;
  }
  const double last = nodes[nodes.size() - 4];
  return last == 1 || last == 2 ? last : 0;
}

void setValue(vtkSMProxy* proxy, const char* name, int value)
{
  vtkSMPropertyHelper property(proxy, name);
  if (property.GetAsInt() != value)
  {
    property.Set(value);
  }
}

/// ParaView's editor of colour maps, where it is open, fits the map to the data whenever MapScalars changes, and
/// warns where these do not have the array yet. Coloured by no array, it finds nothing to do; also when this is
/// undone, because each step is an update of its own.
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

} // namespace

//------------------------------------------------------------------------------
void PictureDisplay::apply(vtkSMProxy* representation, vtkSMProxy* filter)
{
  const bool isColored = hasColors(filter);
  setValue(representation, "UseSeparateColorMap", 1);
  setMapScalars(representation, isColored ? 0 : 1);
  if (auto* colored = vtkSMPVRepresentationProxy::SafeDownCast(representation))
  {
    colored->SetScalarColoring(isColored ? "Color" : "Intensity", vtkDataObject::POINT);
  }
  representation->UpdateVTKObjects();
  vtkSMProxy* colors = vtkSMPropertyHelper(representation, "LookupTable").GetAsProxy();
  if (!isColored && colors)
  {
    vtkSMTransferFunctionProxy::ApplyPreset(colors, "Grayscale", false);
    vtkSMTransferFunctionProxy::RescaleTransferFunction(colors, 0, white(filter));
    // The default makes room for light that gathers, and all else would darken.
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", colors);
    vtkSMPropertyHelper(colors, "AutomaticRescaleRangeMode").Set(-1);
    colors->UpdateVTKObjects();
  }
}

//------------------------------------------------------------------------------
void PictureDisplay::fill(pqView* view, vtkSMSourceProxy* filter)
{
  vtkSMProxy* proxy = view->getProxy();
  vtkPVDataInformation* image = filter->GetDataInformation(0);
  const int* extent = image->GetExtent();
  const double* bounds = image->GetBounds();
  const bool hasImage =
    image->GetNumberOfPoints() > 0 && extent[0] < extent[1] && extent[2] < extent[3];
  view->setProperty(isToBeFilled, !hasImage);
  if (!hasImage)
  {
    return;
  }
  double focus[3] = { 0, 0, 0 };
  double half[2]; // pixels are around points
  for (int axis = 0; axis < 2; ++axis)
  {
    const double points = extent[2 * axis + 1] - extent[2 * axis] + 1;
    focus[axis] = 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
    half[axis] =
      0.5 * (bounds[2 * axis + 1] - bounds[2 * axis]) * points / (points - 1);
  }
  const auto window = vtkSMPropertyHelper(proxy, "ViewSize").GetIntArray();
  const double scale = std::max(half[1], half[0] * window[1] / std::max(1, window[0]));
  const double position[3] = { focus[0], focus[1], 10 * scale };
  const double up[3] = { 0, 1, 0 };
  vtkSMPropertyHelper(proxy, "CameraFocalPoint").Set(focus, 3);
  vtkSMPropertyHelper(proxy, "CameraPosition").Set(position, 3);
  vtkSMPropertyHelper(proxy, "CameraViewUp").Set(up, 3);
  vtkSMPropertyHelper(proxy, "CameraParallelScale").Set(scale);
  proxy->UpdateVTKObjects();
}

//------------------------------------------------------------------------------
void PictureDisplay::fillOnce(pqView* view, vtkSMSourceProxy* filter)
{
  if (view->property(isToBeFilled).toBool())
  {
    SCOPED_UNDO_EXCLUDE();
    PictureDisplay::fill(view, filter);
  }
}

//------------------------------------------------------------------------------
bool PictureDisplay::isApplied(vtkSMProxy* representation)
{
  if (!representation->GetProperty("ColorArrayName") ||
    !representation->GetProperty("MapScalars") ||
    !representation->GetProperty("UseSeparateColorMap"))
  {
    return false;
  }
  const std::string array = shownArray(representation);
  const bool isMapped = valueOf(representation, "MapScalars") != 0;
  return (array == "Color" && !isMapped) ||
    (array == "Intensity" && isMapped && valueOf(representation, "UseSeparateColorMap") != 0 &&
      shownWhite(representation) > 0);
}

//------------------------------------------------------------------------------
bool PictureDisplay::suits(vtkSMProxy* representation, vtkSMProxy* filter)
{
  return hasColors(filter)
    ? shownArray(representation) == "Color"
    : shownArray(representation) == "Intensity" && shownWhite(representation) == white(filter);
}
