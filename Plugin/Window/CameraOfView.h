// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// From the camera of a 3-D view to the view of a Schlieren filter, and to that of its picture.
#pragma once

class vtkSMProxy;
class vtkSMRenderViewProxy;

/// Lets a Schlieren filter look as the view does: its properties ViewDirection, ViewUp, FocalPoint and
/// ParallelScale. Light is parallel; of a perspective view, what is as far away as the middle of the data
/// has the same size. Nothing is pushed (UpdateVTKObjects). Returns whether the filter's view is another one now. A
/// camera that has no direction, up or size, as in the middle of a change, changes nothing.
bool takeCameraOfView(vtkSMProxy* filter, vtkSMRenderViewProxy* view);

/// Where the filter's properties put its picture, in its plane, data units; false where they leave that to
/// the data (ParallelScale 0 or no FocalPoint).
bool placeOfPicture(vtkSMProxy* filter, double center[2], double& halfHeight);

/// Fits the picture of a filter, by its properties, to a 2-D view, and pushes that. False where
/// placeOfPicture is.
bool fitViewToPicture(vtkSMRenderViewProxy* view, vtkSMProxy* filter);
