// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class pqPipelineSource;

/// Shows the image of a Schlieren filter in grey in a flat view beside the 3-D view. Shows a comparison with a photograph in
/// three flat views: itself, the image and the photograph, in which two points can be clicked.
void showInFlatViews(pqPipelineSource* filter);
