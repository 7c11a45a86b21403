// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Displays the image of a Schlieren filter in grey, like film, or in its own colours.
#pragma once

class vtkPVArrayInformation;
class vtkSMProxy;

namespace ImageDisplay
{

/// Shows Intensity in grey, from 0 to 1 (for a shadowgraph to 2), with a separate colour map, or
/// Color as it is, depending on the cutoff.
void apply(vtkSMProxy* representation, vtkSMProxy* filter);

/// Shows the values of a photograph, or of a comparison with it, as they are, of more than 8 bits in grey over their range.
void applyToPhotograph(vtkSMProxy* representation, vtkPVArrayInformation* values);

/// Returns the intensity that apply() maps to white; 0: the image has its own colours.
double white(vtkSMProxy* filter);

/// Returns whether the display still is one of apply().
bool isApplied(vtkSMProxy* representation);

} // namespace ImageDisplay
