// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "CameraOfView.h"

#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSourceProxy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace
{

/// Sets a property where that makes a difference: what is set is traced and undone.
bool setIfOther(vtkSMProxy* proxy, const char* name, const std::vector<double>& values)
{
  vtkSMPropertyHelper property(proxy, name);
  if (property.GetDoubleArray() == values)
  {
    return false;
  }
  property.Set(values.data(), static_cast<unsigned int>(values.size()));
  return true;
}

/// How far the middle of the filter's data is in front of a camera; how far the focal point is where that is
/// not known, or behind. ParaView's zoom takes the focal point along.
double distanceOfData(vtkSMProxy* filter, vtkCamera* camera)
{
  vtkSMPropertyHelper input(filter, "Input");
  auto* flow = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  double bounds[6];
  if (flow)
  {
    flow->GetDataInformation(input.GetOutputPort())->GetBounds(bounds);
    if (vtkMath::AreBoundsInitialized(bounds))
    {
      const double* eye = camera->GetPosition();
      const double* direction = camera->GetDirectionOfProjection();
      double distance = 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double center = 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
        distance += (center - eye[axis]) * direction[axis];
      }
      if (distance > 0)
      {
        return distance;
      }
    }
  }
  return camera->GetDistance();
}

/// As placeOfPicture, of the image that the filter has made.
bool placeOfOutput(vtkSMProxy* filter, double center[2], double& halfHeight)
{
  auto* source = vtkSMSourceProxy::SafeDownCast(filter);
  vtkPVDataInformation* picture = source->GetDataInformation(0);
  const int* extent = picture->GetExtent();
  const double* bounds = picture->GetBounds();
  const int rows = extent[3] - extent[2] + 1;
  if (picture->GetNumberOfPoints() < 1 || rows < 2)
  {
    return false;
  }
  center[0] = 0.5 * (bounds[0] + bounds[1]);
  center[1] = 0.5 * (bounds[2] + bounds[3]);
  halfHeight = 0.5 * (bounds[3] - bounds[2]) * rows / (rows - 1);
  return true;
}

} // namespace

//------------------------------------------------------------------------------
bool takeCameraOfView(vtkSMProxy* filter, vtkSMRenderViewProxy* view)
{
  vtkCamera* camera = view->GetActiveCamera();
  std::array<double, 3> direction;
  std::array<double, 3> up;
  std::array<double, 3> focus;
  camera->GetDirectionOfProjection(direction.data());
  camera->GetViewUp(up.data());
  camera->GetFocalPoint(focus.data());
  const double scale = camera->GetParallelProjection() ? camera->GetParallelScale()
                                                       : distanceOfData(filter, camera) *
      std::tan(vtkMath::RadiansFromDegrees(camera->GetViewAngle() / 2));

  std::array<double, 3> right;
  vtkMath::Cross(direction.data(), up.data(), right.data());
  const double sine = vtkMath::Norm(right.data()) / vtkMath::Norm(up.data());
  if (!(sine > 1e-6 && scale > 0 && std::isfinite(scale + focus[0] + focus[1] + focus[2])))
  {
    return false;
  }

  bool isOther = setIfOther(filter, "ViewDirection", { direction.begin(), direction.end() });
  isOther |= setIfOther(filter, "ViewUp", { up.begin(), up.end() });
  isOther |= setIfOther(filter, "FocalPoint", { focus.begin(), focus.end() });
  isOther |= setIfOther(filter, "ParallelScale", { scale });
  return isOther;
}

//------------------------------------------------------------------------------
bool placeOfPicture(vtkSMProxy* filter, double center[2], double& halfHeight)
{
  const auto direction = vtkSMPropertyHelper(filter, "ViewDirection").GetDoubleArray();
  const auto up = vtkSMPropertyHelper(filter, "ViewUp").GetDoubleArray();
  const auto focus = vtkSMPropertyHelper(filter, "FocalPoint").GetDoubleArray();
  halfHeight = vtkSMPropertyHelper(filter, "ParallelScale").GetAsDouble();
  if (focus.size() != 3 || !(halfHeight > 0))
  {
    return false;
  }
  // The picture lies in z = 0, in coordinates along its right and its up.
  std::array<double, 3> right;
  std::array<double, 3> upright;
  vtkMath::Cross(direction.data(), up.data(), right.data());
  vtkMath::Normalize(right.data());
  vtkMath::Cross(right.data(), direction.data(), upright.data());
  vtkMath::Normalize(upright.data());
  center[0] = vtkMath::Dot(focus.data(), right.data());
  center[1] = vtkMath::Dot(focus.data(), upright.data());
  return true;
}

//------------------------------------------------------------------------------
bool fitViewToPicture(vtkSMRenderViewProxy* view, vtkSMProxy* filter)
{
  double center[2];
  double scale = 0;
  if (!placeOfPicture(filter, center, scale) && !placeOfOutput(filter, center, scale))
  {
    return false;
  }
  const auto pixels = vtkSMPropertyHelper(filter, "ImageSize").GetIntArray();
  const auto window = vtkSMPropertyHelper(view, "ViewSize").GetIntArray();
  const double wide = double(pixels[0]) / pixels[1];
  const double room = double(window[0]) / window[1];

  setIfOther(view, "CameraFocalPoint", { center[0], center[1], 0 });
  setIfOther(view, "CameraPosition", { center[0], center[1], 10 * scale });
  setIfOther(view, "CameraViewUp", { 0, 1, 0 });
  setIfOther(view, "CameraParallelScale", { scale * std::max(1.0, wide / room) });
  view->UpdateVTKObjects();
  return true;
}
