// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>

#include <vector>

class pqOutputPort;
class pqRenderView;
class pqServer;
class vtkSMViewLayoutProxy;

/// Finds the 3-D view that images of a flow belong to, or makes one that shows the flow.
pqRenderView* sceneBeside(pqOutputPort* flow);

/// Adds a render view in a cell of a layout. Returns null if the session has ended meanwhile.
pqRenderView* addViewIn(
  pqServer* server, vtkSMViewLayoutProxy* layout, int cell, const QString& name);

/// Adds views beside the 3-D view: one to its right, or three that form a square with it. Three
/// get a layout of their own if the 3-D view has company already, beside which they would be tiny.
/// Returns none if the session has ended meanwhile.
std::vector<pqRenderView*> addViewsBeside(pqRenderView* scene, const std::vector<QString>& names);
