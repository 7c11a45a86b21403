// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QList>
#include <QString>

#include <array>

class pqOutputPort;
class pqPipelineSource;
class pqRenderView;
class pqRepresentation;
class pqView;
class vtkSMProxy;

/// Finds images of filters, and flows that are drawn as Schlieren, in views.
namespace imagesInViews
{

bool isSchlieren(pqPipelineSource* source);

/// Returns whether a source compares an image with a photograph.
bool isComparison(pqPipelineSource* source);

/// Returns the Schlieren filter of an image, the source or one upstream; null if there is none.
pqPipelineSource* filterOf(pqPipelineSource* source);

/// Returns the 3-D view of a flow, which its images go beside: the active one, or another one in its
/// layout, and rather one that draws no other flow as Schlieren. Null if all show images of filters.
pqRenderView* scene(pqOutputPort* flow);

/// Returns the proxy of the filter inside of a representation; null if it has none.
vtkSMProxy* benchOf(pqRepresentation* representation);

/// Returns whether a representation is visible and draws its data as Schlieren.
bool isDrawn(pqRepresentation* representation);

/// Returns whether the image of such a filter has an automatic k, or distance of a screen, that is kept, but has not been given it.
bool lacksKeptK(vtkSMProxy* bench);

/// Returns the automatic k, or distance of a screen, of the image that a representation has drawn; 0: none, or one that was made without a view.
double shownK(pqRepresentation* representation);

/// Lists the filters inside of the representations that a view draws as Schlieren.
QList<vtkSMProxy*> benchesIn(pqView* view);

/// Lists the filters, comparisons among them, whose images are visible in a view.
QList<pqPipelineSource*> imagesIn(pqView* view);

/// Returns which place of a filter's image, which is in the plane z = 0, is under a place of a view. Places are fractions of
/// width and height from the lower left; one that is not there is below 0.
std::array<double, 2> placeInImage(
  pqPipelineSource* filter, pqRenderView* view, double right, double up);

/// Returns what the image of a filter has at a place, in words.
QString placeInWords(vtkSMProxy* filter, double right, double up);

/// Returns whether a view looks onto a plane.
bool isFlat(pqView* view);

} // namespace imagesInViews
