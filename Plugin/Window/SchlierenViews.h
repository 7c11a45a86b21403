// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Draws the selected flow as Schlieren beside its 3-D view, in one step.
#pragma once

#include "FlowOfPort.h"

#include <QString>

class vtkSMViewLayoutProxy;

namespace SchlierenViews
{

enum class Arrangement
{
  OneImage,
  ThreeImages ///< knife edge, shadowgraph and interferogram
};

/// An empty cell of a layout; none: beside the 3-D view.
struct Cell
{
  vtkSMViewLayoutProxy* layout = nullptr;
  int number = 0;
};

/// The views that were made, or the reason why not.
struct Result
{
  bool isMade;
  bool isSure; ///< whether the choice needs no check by the user
  QString message;
  Completion offer{}; ///< none were made, but with this they can be
};

/// Adds views, linked to the 3-D view's camera, as one undo step. Uses the flow and settings of the
/// selected Schlieren filter (or that of a selected image), or the settings of the active view's
/// representation. `cell`: for one image.
Result add(Arrangement arrangement, const Cell& cell = {}, const Completion& completion = {});

} // namespace SchlierenViews
