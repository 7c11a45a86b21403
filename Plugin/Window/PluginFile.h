// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class pqServer;

/// Traces what a script has to load before what follows: ParaView traces no plugins that it loads when it starts.
void traceLoading(pqServer* server);
