// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Pictures of the selected flow beside its 3-D view, made in one step.
#pragma once

#include <QString>

class pqPipelineSource;

namespace SchlierenViews
{

enum class Arrangement
{
  OnePicture,
  ThreePictures, ///< knife edge, shadowgraph and interferogram of one medium
  Comparison     ///< straight and bent light, with linked cameras
};

/// What was made of the data, or, where nothing could be made, why.
struct Result
{
  bool isMade;
  bool isSure; ///< whether the user need not look after what was chosen
  QString message;
};

/// Makes filters, views and what they show: one undo step. Where a Schlieren filter or what is made from
/// its picture is selected, it is that filter's flow and settings that are used.
Result add(Arrangement arrangement);

/// Shows the image of a Schlieren filter as add() does, in a view of its own beside the 3-D view.
void show(pqPipelineSource* filter);

} // namespace SchlierenViews
