// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkBoundingBox.h"

#include <vector>

class pqRenderView;
class pqView;

/// Returns a view's width over its height.
double aspectOf(pqView* view);

/// Returns whether all of a box is within a view of this aspect.
bool isWhole(pqRenderView* view, double aspect, const vtkBoundingBox& box);

/// Moves the camera of the 3-D view, as a step of Undo, where what new views draw would else be small in them, or
/// partly outside though `wasWhole`: to where all of it is seen in each of them, in the same direction. They have its
/// camera and have been updated. Returns whether it has moved.
bool frameFlow(pqRenderView* scene, const std::vector<pqRenderView*>& views, bool wasWhole);
