// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqPictureRefiner.h"

#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqServerManagerModel.h"
#include "pqView.h"

#include <QPointer>

//------------------------------------------------------------------------------
pqPictureRefiner::pqPictureRefiner(QObject* parentObject)
  : QObject(parentObject)
{
}

//------------------------------------------------------------------------------
pqPictureRefiner* pqPictureRefiner::instance()
{
  static QPointer<pqPictureRefiner> refiner;
  if (!refiner)
  {
    refiner = new pqPictureRefiner(pqApplicationCore::instance());
  }
  return refiner;
}

//------------------------------------------------------------------------------
void pqPictureRefiner::refine(vtkSMProxy* filter, Pace)
{
  auto* source =
    pqApplicationCore::instance()->getServerManagerModel()->findItem<pqPipelineSource*>(filter);
  if (source)
  {
    source->renderAllViews();
    Q_EMIT this->pictureChanged(filter);
  }
}
