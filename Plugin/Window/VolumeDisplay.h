// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class pqOutputPort;
class pqPipelineSource;
class pqRenderView;
struct FlowDefaults;

bool isImage(pqOutputPort* port);

/// Shows a flow as a volume, coloured by what its index is made of, where it was not shown or was an
/// outline. Light that is like the surroundings' is clear: what the picture tells about the ambient
/// refractivity is asked for. Does nothing to other data than images.
void showAsVolume(
  pqOutputPort* flow, pqRenderView* view, const FlowDefaults& defaults, pqPipelineSource* picture);
