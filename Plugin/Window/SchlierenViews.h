// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The selected flow drawn as Schlieren beside its 3-D view, in one step.
#pragma once

#include <QString>

class pqPipelineSource;
class vtkSMViewLayoutProxy;

namespace SchlierenViews
{

enum class Arrangement
{
  OneImage,
  ThreeImages, ///< knife edge, shadowgraph and interferogram
  Comparison   ///< straight and refracted rays, and their difference, at one k
};

/// An empty cell of a layout; none: beside the 3-D view.
struct Cell
{
  vtkSMViewLayoutProxy* layout = nullptr;
  int number = 0;
};

/// What was made of the data, or, where nothing could be made, why.
struct Result
{
  bool isMade;
  bool isSure; ///< whether the user need not look after what was chosen
  QString message;
};

/// Makes views whose cameras are linked with that of the 3-D view, and what they show: one undo step. Where a Schlieren
/// filter or what is made from its image is selected, it is that filter's flow and settings that are used; where the
/// active view draws the flow as Schlieren, those settings. `cell`: where one image is to be.
Result add(Arrangement arrangement, const Cell& cell = {});

/// Shows the image of a Schlieren filter in a flat view of its own beside the 3-D view, in grey.
void show(pqPipelineSource* filter);

} // namespace SchlierenViews
