// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class vtkDataArray;

namespace filters
{

/// Finds the ranges of an array's components and of their norm and leaves them where vtkDataArray keeps those
/// that it has found: ParaView requests all of them after each update, and VTK's own search takes several times
/// as long as an image. For arrays that hold their values one after the other (vtkAOSDataArrayTemplate); leaves others
/// alone, and those with values that are not finite. To be called when nothing changes the array any more.
void setRanges(vtkDataArray* array);

} // namespace filters
