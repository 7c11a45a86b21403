// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QList>
#include <QString>

class pqPipelineSource;
class pqRenderView;
class pqView;

/// Which views show which pictures, and which one a picture follows.
namespace picturesInViews
{

bool isSchlieren(pqPipelineSource* source);

/// All filters that make pictures, of all servers.
QList<pqPipelineSource*> filters();

/// The visible views that show something of a filter, or something made from it.
QList<pqView*> showing(pqPipelineSource* filter);

/// The filters whose pictures are visible in a view.
QList<pqPipelineSource*> picturesIn(pqView* view);

/// Whether a view looks straight onto a plane.
bool isFlat(pqView* view);

/// Name of the view that a filter follows, there or not; empty: none.
QString followedName(pqPipelineSource* filter);

/// The view with that name, best in a layout that shows the picture; null where there is none.
pqRenderView* followed(pqPipelineSource* filter);

} // namespace picturesInViews
