// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the user means by what is selected.
#pragma once

class pqPipelineSource;
class pqRenderView;
class pqServer;

/// The Schlieren filter whose image this is made from: itself, or one upstream; null where there is none.
pqPipelineSource* schlierenFilterOf(pqPipelineSource* source);

/// The 3-D view that is meant: the active one, or another one beside it. Null where all show images of filters.
pqRenderView* sceneView(pqServer* server);
