// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QList>
#include <QPointer>

class pqOutputPort;
class pqPipelineSource;
class pqRenderView;
class pqView;

/// Finds the views that show images of filters.
namespace imagesInViews
{

bool isSchlieren(pqPipelineSource* source);

/// Returns the Schlieren filter of an image, the source or one upstream; null if there is none.
pqPipelineSource* filterOf(pqPipelineSource* source);

/// Returns the 3-D view of a flow, which its images go beside: the active one, or another one in its
/// layout, and rather one that draws no other flow as Schlieren. Null if all show images of filters.
pqRenderView* scene(pqOutputPort* flow);

/// Lists the filters that make images, of all servers.
QList<pqPipelineSource*> filters();

/// Lists the visible views of a filter's outputs and of what is made from them.
QList<QPointer<pqView>> showing(pqPipelineSource* filter);

/// Lists the filters whose images are visible in a view.
QList<pqPipelineSource*> imagesIn(pqView* view);

/// Returns whether a view looks onto a plane.
bool isFlat(pqView* view);

} // namespace imagesInViews
