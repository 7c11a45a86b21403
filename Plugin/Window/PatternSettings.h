// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class vtkSMProxy;

/// Copies the settings of a filter, or of one in a representation, except flow, camera and size.
void copySettings(vtkSMProxy* from, vtkSMProxy* to);

/// Gives an image the automatic k of another one of the same technique, if it locks k for any camera.
void useKOf(vtkSMProxy* from, vtkSMProxy* to);
