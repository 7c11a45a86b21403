// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqSchlierenStart.h"

#include "pqApplyHooks.h"
#include "pqImageDisplayKeeper.h"
#include "pqImageProbe.h"
#include "pqImageProgress.h"
#include "pqImageStatus.h"
#include "pqRepresentationRefiner.h"
#include "pqViewNames.h"

#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqServerManagerModel.h"

#include <QPointer>

//------------------------------------------------------------------------------
pqSchlierenStart::pqSchlierenStart() = default;

//------------------------------------------------------------------------------
pqSchlierenStart::~pqSchlierenStart() = default;

//------------------------------------------------------------------------------
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
  new pqRepresentationRefiner(this);
  new pqImageProgress(this);
  new pqImageProbe(this);
  new pqViewNames(this);
  // Waits for ParaView's window, which may come after its plugins.
  auto* hooks = new pqApplyHooks(this);
  QObject::connect(pqApplicationCore::instance()->getServerManagerModel(),
    &pqServerManagerModel::sourceAdded, hooks, [hooks](pqPipelineSource*) { hooks->setUp(); });
}
