// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqFlowOfView.h"

#include "FlowOfPort.h"
#include "ImagesInViews.h"

#include "pqActiveObjects.h"
#include "pqDataRepresentation.h"
#include "pqOutputPort.h"
#include "pqView.h"

#include <QGuiApplication>

#include <algorithm>

pqFlowOfView::pqFlowOfView(QObject* parentObject)
  : QObject(parentObject)
{
  QObject::connect(&pqActiveObjects::instance(),
    QOverload<pqView*>::of(&pqActiveObjects::viewChanged), this, &pqFlowOfView::onViewChanged);
}

pqFlowOfView::~pqFlowOfView() = default;

void pqFlowOfView::onViewChanged(pqView* view)
{
  // Leaves the selection of scripts alone.
  if (!view || QGuiApplication::mouseButtons() == Qt::NoButton)
  {
    return;
  }
  const pqOutputPort* active = pqActiveObjects::instance().activePort();
  const QList<pqRepresentation*> shown = view->getRepresentations();
  const auto portOf = [](pqRepresentation* representation)
  {
    auto* display = qobject_cast<pqDataRepresentation*>(representation);
    return display && display->isVisible() ? display->getOutputPortFromInput() : nullptr;
  };
  if (std::any_of(shown.begin(), shown.end(),
        [&](pqRepresentation* one) { return portOf(one) && portOf(one) == active; }))
  {
    return;
  }
  const auto drawn = std::find_if(shown.begin(), shown.end(), imagesInViews::isDrawn);
  if (drawn != shown.end() && portOf(*drawn))
  {
    selectFlow(portOf(*drawn));
  }
}
