// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqSchlierenToolBar.h"

#include "FlowOfPort.h"
#include "SchlierenFilters.h"
#include "pqPictureDisplayKeeper.h"
#include "pqPictureRefiner.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqSettings.h"
#include "pqUndoStack.h"
#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkOutputWindow.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <QAction>
#include <QIcon>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QSignalBlocker>
#include <QStatusBar>
#include <QTimer>

namespace
{

/// The Schlieren filter that is selected, or from whose picture the selected source is made; one that has
/// been applied.
vtkSMProxy* selectedFilter()
{
  pqPipelineSource* source = schlierenFilterOf(pqActiveObjects::instance().activeSource());
  return source && isApplied(source) ? source->getProxy() : nullptr;
}

} // namespace

//------------------------------------------------------------------------------
pqSchlierenToolBar::pqSchlierenToolBar(QWidget* parentObject)
  : QToolBar("Schlieren", parentObject)
{
  using SchlierenViews::Arrangement;
  this->setObjectName("SchlierenToolBar");

  QAction* one = this->addArrangement("OnePicture", "&Add Schlieren View",
    "Show the selected flow as a schlieren picture beside its 3-D view", Arrangement::OnePicture);
  one->setShortcut(QKeySequence("Ctrl+Shift+L"));
  this->addArrangement("ThreePictures", "&Three Pictures",
    "Show the selected flow behind a knife edge, as a shadowgraph and as an interferogram",
    Arrangement::ThreePictures);
  this->addArrangement("Comparison", "&Compare Straight and Bent Light",
    "Show what bending adds: pictures of the selected flow by straight and by refracted rays, at "
    "one "
    "sensitivity and with linked cameras",
    Arrangement::Comparison);
  this->addSeparator();
  this->Follow = new QAction(QIcon(":/Schlieren/Follow.svg"), "&Follow Camera", this);
  this->Follow->setCheckable(true);
  this->addToolAction(this->Follow, "Follow",
    "Let the picture of the selected Schlieren filter follow the camera of the 3-D view");
  this->connect(this->Follow, SIGNAL(toggled(bool)), SLOT(setFollowing(bool)));
  this->addMenu();

  auto& active = pqActiveObjects::instance();
  this->connect(&active, SIGNAL(sourceChanged(pqPipelineSource*)), SLOT(watchSource()));
  this->connect(&active, SIGNAL(viewChanged(pqView*)), SLOT(updateActions()));
  this->watchSource();
  new pqPictureDisplayKeeper(this);
  // When ParaView has put it somewhere.
  QTimer::singleShot(0, this, [this]() { this->makeRoom(); });
}

//------------------------------------------------------------------------------
pqSchlierenToolBar::~pqSchlierenToolBar() = default;

//------------------------------------------------------------------------------
QAction* pqSchlierenToolBar::addArrangement(const char* name, const QString& text,
  const QString& hint, SchlierenViews::Arrangement arrangement)
{
  auto* action = new QAction(QIcon(QString(":/Schlieren/%1.svg").arg(name)), text, this);
  this->addToolAction(action, name, hint);
  this->Arrangements.append(action);
  QObject::connect(action, &QAction::triggered, this,
    [this, arrangement]() { this->tell(SchlierenViews::add(arrangement)); });
  return action;
}

//------------------------------------------------------------------------------
void pqSchlierenToolBar::addToolAction(QAction* action, const char* name, const QString& hint)
{
  action->setObjectName(QString("action%1").arg(name));
  action->setToolTip(hint); // no status tip: it would clear what is told below the window
  this->addAction(action);
  QWidget* button = this->widgetForAction(action);
  button->setObjectName(name);
  button->setAccessibleName(action->iconText());
  button->setAccessibleDescription(hint);
}

//------------------------------------------------------------------------------
void pqSchlierenToolBar::addMenu()
{
  auto* window = qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget());
  if (!window)
  {
    return;
  }
  auto* menu = new QMenu("Schlie&ren", window->menuBar());
  menu->setObjectName("menuSchlieren");
  menu->addActions(this->actions());
  const QList<QAction*> menus = window->menuBar()->actions();
  window->menuBar()->insertMenu(menus.empty() ? nullptr : menus.last(), menu);
}

//------------------------------------------------------------------------------
void pqSchlierenToolBar::makeRoom()
{
  auto* window = qobject_cast<QMainWindow*>(this->parentWidget());
  const QByteArray places =
    pqApplicationCore::instance()->settings()->value("MainWindow/Layout").toByteArray();
  QByteArray name; // as QMainWindow::saveState() writes it
  for (const QChar letter : this->objectName())
  {
    name.append(static_cast<char>(letter.row())).append(static_cast<char>(letter.cell()));
  }
  if (window && !places.contains(name))
  {
    window->addToolBar(Qt::TopToolBarArea, this);
  }
}

//------------------------------------------------------------------------------
void pqSchlierenToolBar::tell(const SchlierenViews::Result& result)
{
  if (!result.isMade)
  {
    if (!this->Message)
    {
      this->Message = new QMessageBox(QMessageBox::Information, "Schlieren", QString(),
        QMessageBox::Ok, pqCoreUtilities::mainWidget());
      this->Message->setObjectName("SchlierenMessage");
    }
    this->Message->setText(result.message);
    this->Message->open();
  }
  else if (!result.message.isEmpty())
  {
    const QByteArray line = ("Schlieren: " + result.message).toUtf8();
    if (result.isSure)
    {
      vtkOutputWindowDisplayText(line.constData());
    }
    else
    {
      vtkOutputWindowDisplayWarningText(line.constData());
    }
    // Not at once: what the button still has to do would clear it.
    QTimer::singleShot(1000, this,
      [message = result.message]()
      {
        auto* window = qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget());
        if (window)
        {
          window->statusBar()->showMessage(message);
        }
      });
  }
}

//------------------------------------------------------------------------------
void pqSchlierenToolBar::watchSource()
{
  this->Events->Disconnect();
  if (vtkSMProxy* filter = selectedFilter())
  {
    this->Events->Connect(filter, vtkCommand::UpdateEvent, this, SLOT(updateActions()));
  }
  // A source that is not applied yet will be.
  if (pqPipelineSource* source = pqActiveObjects::instance().activeSource())
  {
    this->connect(source, SIGNAL(modifiedStateChanged(pqServerManagerModelItem*)),
      SLOT(updateActions()), Qt::UniqueConnection);
  }
  this->updateActions();
}

//------------------------------------------------------------------------------
void pqSchlierenToolBar::updateActions()
{
  const bool hasSource = pqActiveObjects::instance().activeSource() != nullptr;
  for (QAction* action : this->Arrangements)
  {
    action->setEnabled(hasSource);
  }
  vtkSMProxy* filter = selectedFilter();
  const QSignalBlocker noFollowing(this->Follow);
  const char* followed =
    filter ? vtkSMPropertyHelper(filter, "FollowedView").GetAsString() : nullptr;
  this->Follow->setEnabled(filter != nullptr);
  this->Follow->setChecked(followed && *followed);
}

//------------------------------------------------------------------------------
void pqSchlierenToolBar::setFollowing(bool isFollowing)
{
  vtkSMProxy* filter = selectedFilter();
  pqServer* server = pqActiveObjects::instance().activeServer();
  if (!filter)
  {
    return;
  }
  pqRenderView* view = isFollowing ? sceneView(server) : nullptr;
  if (isFollowing && !view)
  {
    this->tell({ false, true,
      "There is no 3-D view whose camera the picture could follow. Make one: split the view, "
      "choose "
      "Render View, and show the flow there." });
    this->updateActions();
    return;
  }
  BEGIN_UNDO_SET(isFollowing ? "Follow Camera" : "Do Not Follow Camera");
  follow(filter, view);
  END_UNDO_SET();
  pqPictureRefiner::instance()->refine(filter, pqPictureRefiner::Pace::Thorough);
  this->updateActions();
}
