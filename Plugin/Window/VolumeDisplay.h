// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class pqOutputPort;
class pqPipelineSource;
class pqRenderView;
class vtkSMProxy;
struct FlowDefaults;

bool isImage(pqOutputPort* port);

/// Shows a flow as a volume, coloured by what its index is made of, where it was not shown or was an
/// outline. What is like the surroundings is clear: `picture` tells their refractivity, `model` how
/// the filter that the flow goes into finds it. Does nothing to other data than images.
void showAsVolume(pqOutputPort* flow, pqRenderView* view, const FlowDefaults& defaults,
  vtkSMProxy* model, pqPipelineSource* picture);
