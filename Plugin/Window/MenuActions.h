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

/// Opens the jet that comes with the plugin, shows it, and selects it. Returns why it cannot; else empty.
QString openExample();

} // namespace menuActions
