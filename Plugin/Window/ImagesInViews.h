// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QList>
#include <QPointer>

class pqPipelineSource;
class pqRenderView;
class pqServer;
class pqView;

/// Which views show the images of which filters.
namespace imagesInViews
{

bool isSchlieren(pqPipelineSource* source);

/// The Schlieren filter whose image this is made from: itself, or one upstream; null where there is none.
pqPipelineSource* filterOf(pqPipelineSource* source);

/// The 3-D view that is meant: the active one, or another one beside it. Null where all show images of filters.
pqRenderView* scene(pqServer* server);

/// All filters that make images, of all servers.
QList<pqPipelineSource*> filters();

/// The visible views that show something of a filter, or something made from it.
QList<QPointer<pqView>> showing(pqPipelineSource* filter);

/// The filters whose images are visible in a view.
QList<pqPipelineSource*> imagesIn(pqView* view);

/// Whether a view looks straight onto a plane.
bool isFlat(pqView* view);

} // namespace imagesInViews
