// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>

class pqServer;

/// Returns the file that the plugin was loaded from; empty: it is a part of the program.
QString pluginFile();

/// Traces what a script has to load before what follows: ParaView traces no plugins that it loads when it starts.
void traceLoading(pqServer* server);
