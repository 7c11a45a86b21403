// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class pqRenderView;

/// Links the cameras of two views, as Tools > Add Camera Link does. Unlike that it can be undone, as the last
/// part of the undo set that is being made.
void linkCameras(pqRenderView* first, pqRenderView* second);
