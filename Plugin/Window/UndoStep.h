// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Adds steps that ParaView's undo stack lacks: cameras, links between them, and layouts after an undo.
#pragma once

#include "vtkSMSession.h"
#include "vtkWeakPointer.h"

#include <functional>

class pqRenderView;
class vtkSMProxy;
class vtkSMRenderViewProxy;
class vtkSMViewLayoutProxy;

/// Adds a step to the current undo set. Its functions must find proxies by ProxyById.
void addUndoStep(std::function<void()> undo, std::function<void()> redo);

/// Adds the step of an undo that activates the view which is active now, as the undo set's first step.
void keepActiveView();

/// Lets an undo of what is done to a layout next end in what it is like now, and not in what it was like before an
/// earlier undo, which ParaView does not note. `cell`: one that is not split.
void noteLayout(vtkSMViewLayoutProxy* layout, int cell);

/// A reference to a proxy that undo may delete and redo may make again.
class ProxyById
{
public:
  explicit ProxyById(vtkSMProxy* proxy);
  vtkSMProxy* get() const; ///< null while it does not exist

private:
  vtkWeakPointer<vtkSMSession> Session;
  vtkTypeUInt32 Id;
};

/// Returns a function that sets the present camera of a view in another one.
std::function<void()> cameraSetter(vtkSMRenderViewProxy* from, vtkSMProxy* to);

/// Links the cameras of two views, like Tools > Add Camera Link, as the undo set's last step.
void linkCameras(pqRenderView* first, pqRenderView* second);
