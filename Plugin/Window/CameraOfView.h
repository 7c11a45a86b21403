// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// From the camera of a 3-D view to the view of a Schlieren filter, and to that of its picture.
#pragma once

class vtkSMProxy;
class vtkSMRenderViewProxy;

/// Lets a Schlieren filter look as the view does: its properties ViewDirection, ViewUp, FocalPoint and
/// ParallelScale. Light is parallel; of a perspective view, what is as far away as its focal point has the
/// same size. Nothing is pushed (UpdateVTKObjects). Returns whether the filter's view is another one now.
bool takeCameraOfView(vtkSMProxy* filter, vtkSMRenderViewProxy* view);

/// Fits the picture of a filter, by its properties, to a 2-D view, and pushes that. False where the
/// filter leaves its place to the data (ParallelScale 0 or no FocalPoint).
bool fitViewToPicture(vtkSMRenderViewProxy* view, vtkSMProxy* filter);
