// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class pqOutputPort;
class pqRenderView;
class vtkSMProxy;
struct FlowDefaults;

/// Shows a flow, if hidden or an outline, as a volume coloured by the array of its index and
/// transparent at the ambient value. `bench`: a Schlieren filter that has made an image of it.
/// Ignores data other than images.
void showAsVolume(
  pqOutputPort* flow, pqRenderView* view, const FlowDefaults& defaults, vtkSMProxy* bench);
