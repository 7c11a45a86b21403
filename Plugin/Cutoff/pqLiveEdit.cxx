// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqLiveEdit.h"

#include "ImagesInViews.h"
#include "pqApplicationCore.h"
#include "pqSMAdaptor.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"
#include "pqView.h"

#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMTrace.h"

namespace
{

/// Draws the views that draw the filter's flow, because the volume beside them takes longer; of a filter in the pipeline all views.
void render(vtkSMProxy* filter)
{
  pqApplicationCore* core = pqApplicationCore::instance();
  bool isDrawn = false;
  for (pqView* view : core->getServerManagerModel()->findItems<pqView*>())
  {
    if (imagesInViews::benchesIn(view).contains(filter))
    {
      view->render();
      isDrawn = true;
    }
  }
  if (!isDrawn)
  {
    core->render();
  }
}

} // namespace

pqLiveEdit::pqLiveEdit(vtkSMProxy* filter, const QString& label)
  : Filter(filter)
  , Label(label)
{
}

bool pqLiveEdit::isPossible(vtkSMProxy* filter)
{
  return vtkSMPropertyHelper(filter, "ImageCount").GetAsInt() > 0;
}

void pqLiveEdit::push(const QMap<QString, QVariant>& values)
{
  for (auto value = values.begin(); value != values.end(); ++value)
  {
    vtkSMProperty* property = this->Filter->GetProperty(value.key().toLatin1());
    if (pqSMAdaptor::getElementProperty(property) != value.value())
    {
      pqSMAdaptor::setElementProperty(property, value.value());
    }
  }
  this->Filter->UpdateVTKObjects();
}

void pqLiveEdit::show(const QMap<QString, QVariant>& values)
{
  if (!this->Filter)
  {
    return;
  }
  for (auto value = values.begin(); value != values.end(); ++value)
  {
    if (!this->Before.contains(value.key()))
    {
      this->Before[value.key()] =
        pqSMAdaptor::getElementProperty(this->Filter->GetProperty(value.key().toLatin1()));
    }
    this->Now[value.key()] = value.value();
  }
  {
    SCOPED_UNDO_EXCLUDE();
    this->push(this->Now);
  }
  render(this->Filter);
}

void pqLiveEdit::finish()
{
  if (!this->Filter || this->Now == this->Before)
  {
    return;
  }
  // Restores the first values, from which the undo step and the trace begin.
  {
    SCOPED_UNDO_EXCLUDE();
    this->push(this->Before);
  }
  {
    SCOPED_UNDO_SET(this->Label);
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", this->Filter);
    this->push(this->Now);
  }
  render(this->Filter);
}

void pqLiveEdit::cancel()
{
  if (this->Filter && !this->Before.isEmpty())
  {
    SCOPED_UNDO_EXCLUDE();
    this->push(this->Before);
    render(this->Filter);
  }
}
