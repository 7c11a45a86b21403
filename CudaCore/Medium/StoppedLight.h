// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/BrickRays.h"

namespace schlieren
{

/// Whether walls stop all straight rays of a dense lattice over the view.
template <class Real>
bool isLightStopped(const LeavesView<Real>& medium, const Column& column, int threads);

} // namespace schlieren
