// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqSchlierenStart.h"

#include "pqFlowOfView.h"
#include "pqImageDisplayKeeper.h"
#include "pqImageProbe.h"
#include "pqImageProgress.h"
#include "pqImageStatus.h"
#include "pqPhotographMouse.h"

#include "pqApplicationCore.h"

#include <QPointer>

pqSchlierenStart::pqSchlierenStart() = default;

pqSchlierenStart::~pqSchlierenStart() = default;

void pqSchlierenStart::startup()
{
  // Starts only one instance, even if the plugin is loaded again.
  static QPointer<pqSchlierenStart> first;
  if (first || !pqApplicationCore::instance())
  {
    return;
  }
  first = this;
  new pqImageStatus(this);
  new pqImageDisplayKeeper(this);
  new pqImageProgress(this);
  new pqImageProbe(this);
  new pqPhotographMouse(this);
  new pqFlowOfView(this);
}
