// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqViewNames.h"

#include "pqRepresentationRefiner.h"

#include "pqApplicationCore.h"
#include "pqRenderView.h"
#include "pqRepresentation.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkSMEnumerationDomain.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSessionProxyManager.h"

#include <QRegularExpression>

namespace
{

pqServerManagerModel* model() { return pqApplicationCore::instance()->getServerManagerModel(); }

/// Returns whether a view's name is that of a technique, perhaps with a number.
bool isOfTechnique(QString name, vtkSMProperty* cutoff)
{
  static const QRegularExpression number("[0-9]+$");
  name.remove(number);
  auto* names = cutoff->FindDomain<vtkSMEnumerationDomain>();
  for (unsigned int i = 0; names && i < names->GetNumberOfEntries(); ++i)
  {
    if (name == names->GetEntryText(i))
    {
      return true;
    }
  }
  return false;
}

} // namespace

//------------------------------------------------------------------------------
pqViewNames::pqViewNames(QObject* parentObject)
  : QObject(parentObject)
{
  QObject::connect(model(), &pqServerManagerModel::representationAdded, this, &pqViewNames::watch);
  for (pqRepresentation* representation : model()->findItems<pqRepresentation*>())
  {
    this->watch(representation);
  }
}

//------------------------------------------------------------------------------
pqViewNames::~pqViewNames() = default;

//------------------------------------------------------------------------------
void pqViewNames::watch(pqRepresentation* representation)
{
  vtkSMProperty* bench = representation->getProxy()->GetProperty("SchlierenBench");
  vtkSMProxy* filter = bench ? vtkSMPropertyHelper(bench).GetAsProxy() : nullptr;
  if (filter)
  {
    this->Connection->Connect(filter->GetProperty("Cutoff"), vtkCommand::ModifiedEvent, this,
      SLOT(onCutoffChanged(vtkObject*)));
  }
}

//------------------------------------------------------------------------------
void pqViewNames::onCutoffChanged(vtkObject* object)
{
  auto* cutoff = static_cast<vtkSMProperty*>(object);
  const QString technique = vtkSMPropertyHelper(cutoff).GetAsString();
  for (pqRenderView* view : model()->findItems<pqRenderView*>())
  {
    const QString name = view->getSMName();
    if (pqRepresentationRefiner::benchesIn(view).contains(cutoff->GetParent()) &&
      isOfTechnique(name, cutoff) && !name.startsWith(technique))
    {
      SCOPED_UNDO_EXCLUDE();
      const std::string unique = view->getServer()->proxyManager()->GetUniqueProxyName(
        "views", qUtf8Printable(technique), false);
      view->rename(QString::fromStdString(unique));
    }
  }
}
