// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>

/// What the menu Schlieren does besides making views.
namespace menuActions
{

/// Requests a name and saves a figure of what the active view shows. Returns why there is none; empty: there is, or the
/// user has cancelled.
QString saveFigure();

/// Opens the jet that comes with the plugin, shows it, and selects it. Returns why it cannot; else empty.
QString openExample();

} // namespace menuActions
