// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Schlieren filters among what the window holds.
#pragma once

class pqPipelineSource;
class pqRenderView;
class pqServer;
class pqView;
class vtkSMProxy;

bool isSchlierenFilter(vtkSMProxy* proxy);

/// The Schlieren filter whose picture this is made from: itself, or one upstream; null where there is none.
pqPipelineSource* schlierenFilterOf(pqPipelineSource* source);

/// A Schlieren filter whose picture the view shows, or null.
pqPipelineSource* pictureIn(pqView* view);

/// The 3-D view that the user means: the active one; the one that the active picture follows; another
/// one that is seen beside them. Null where all show pictures.
pqRenderView* sceneView(pqServer* server);

/// The view that the filter follows, or null.
pqRenderView* followedView(vtkSMProxy* filter);

/// Lets the filter follow the view from now on, or, where it is null, none. Pushed, traced; not an undo
/// set of its own.
void follow(vtkSMProxy* filter, pqRenderView* view);
