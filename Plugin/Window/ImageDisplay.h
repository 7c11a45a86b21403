// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// How the image of a Schlieren filter is to be seen: in grey as on film, or in its own colours.
#pragma once

class vtkSMProxy;

namespace ImageDisplay
{

/// Shows what the filter's cutoff makes: Intensity in grey, from 0 to 1, of a shadowgraph to 2, with a
/// colour map that no other image shares; or Color as it is.
void apply(vtkSMProxy* representation, vtkSMProxy* filter);

/// What apply() chooses by the filter's cutoff: what is white; 0: the image has its own colours.
double white(vtkSMProxy* filter);

/// Whether it is shown by one of the arrays that apply() chooses, with colours of its own.
bool isApplied(vtkSMProxy* representation);

} // namespace ImageDisplay
