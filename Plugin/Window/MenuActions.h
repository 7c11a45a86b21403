// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>

/// What the menu Schlieren does besides making views.
namespace menuActions
{

/// Returns whether there is an image that saveFigure() saves.
bool hasImage();

/// Requests a name, a title, a size and the like, and saves a figure of what the active view shows. Returns why there is none; empty: there is, or the
/// user has cancelled.
QString saveFigure();

/// Requests the file of a photograph, and compares the selected image, or that of the active view, with it, as one undo step. Returns why it
/// cannot; empty: it does, or the user has cancelled.
QString compareWithPhotograph();

/// Returns k of the photograph that the selected comparison, or that of the active view, has found; 0: none.
double kOfPhotograph();

/// Gives that k to the comparison's image.
void copyK();

/// Opens an example of schlieren_examples, shows its flow, and selects its filter. Returns why it cannot; else empty.
QString openExample(const QString& name);

} // namespace menuActions
