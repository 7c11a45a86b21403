// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What ParaView's undo stack leaves out: cameras, and links between them.
#pragma once

#include "vtkSMSession.h"
#include "vtkWeakPointer.h"

#include <functional>

class pqRenderView;
class vtkSMProxy;
class vtkSMRenderViewProxy;

/// Adds a step to the undo set that is being made. What it takes must be there then: see ProxyById.
void addUndoStep(std::function<void()> undo, std::function<void()> redo);

/// A proxy that undoing may delete and redoing may make anew.
class ProxyById
{
public:
  explicit ProxyById(vtkSMProxy* proxy);
  vtkSMProxy* get() const; ///< null while it is not there

private:
  vtkWeakPointer<vtkSMSession> Session;
  vtkTypeUInt32 Id;
};

/// The camera that a view has, to be set in a view.
std::function<void()> cameraSetter(vtkSMRenderViewProxy* from, vtkSMProxy* to);

/// Links the cameras of two views, as Tools > Add Camera Link does. Unlike that it can be undone, as the last
/// part of the undo set that is being made.
void linkCameras(pqRenderView* first, pqRenderView* second);
