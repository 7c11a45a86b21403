// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class pqOutputPort;
class pqRenderView;
class vtkSMProxy;
struct FlowDefaults;

/// Shows a flow as a volume, coloured by what its index is made of, where it was not shown or was an
/// outline. What is like the surroundings is clear: `bench` is a Schlieren filter that has made an image of it.
/// Does nothing to other data than images.
void showAsVolume(
  pqOutputPort* flow, pqRenderView* view, const FlowDefaults& defaults, vtkSMProxy* bench);
