// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the user means by what is selected.
#pragma once

class pqPipelineSource;
class pqRenderView;
class pqServer;
class vtkSMProxy;

/// The Schlieren filter whose picture this is made from: itself, or one upstream; null where there is none.
pqPipelineSource* schlierenFilterOf(pqPipelineSource* source);

/// The 3-D view that is meant: the active one; the one that the active picture follows; another one that
/// is seen beside them. Null where all show pictures.
pqRenderView* sceneView(pqServer* server);

/// Lets the filter follow the view from now on, or, where it is null, none. Pushed, traced; not an undo
/// set of its own.
void follow(vtkSMProxy* filter, pqRenderView* view);
