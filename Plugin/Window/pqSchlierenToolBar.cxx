// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqSchlierenToolBar.h"

#include "FlowDefaults.h"
#include "MenuActions.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqHelpReaction.h"
#include "pqImageStatus.h"
#include "pqInterfaceTracker.h"
#include "pqMultiViewWidget.h"
#include "pqObjectBuilder.h"
#include "pqOutputPort.h"
#include "pqServerManagerModel.h"
#include "pqSettings.h"
#include "pqViewFrame.h"
#include "vtkOutputWindow.h"

#include <QAction>
#include <QApplication>
#include <QBoxLayout>
#include <QIcon>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QPushButton>
#include <QStatusBar>
#include <QTimer>

#include <utility>

pqSchlierenToolBar::pqSchlierenToolBar(QWidget* parentObject)
  : QToolBar("Schlieren", parentObject)
{
  using SchlierenViews::Arrangement;
  this->setObjectName("SchlierenToolBar");

  QAction* one = this->addArrangement("OneImage", "&Add Schlieren View",
    "Show the selected flow as a schlieren image beside its 3-D view", Arrangement::OneImage);
  one->setShortcut(QKeySequence("Ctrl+Shift+L"));
  this->addArrangement("ThreeImages", "&Three Images",
    "Show the selected flow behind a knife edge, as a shadowgraph and as an interferogram",
    Arrangement::ThreeImages);
  this->addMenu();
  pqApplicationCore::instance()->interfaceTracker()->addInterface(this);
  for (QWidget* widget : QApplication::allWidgets())
  {
    if (qobject_cast<pqViewFrame*>(widget))
    {
      this->addToEmpty(widget); // cells from before the plugin was loaded
    }
  }
  QObject::connect(&pqActiveObjects::instance(), &pqActiveObjects::sourceChanged, this,
    &pqSchlierenToolBar::updateActions);
  // A session that is being reset handles events, but its views and layouts come and go.
  pqApplicationCore* core = pqApplicationCore::instance();
  const auto enable = [this](bool isSession)
  {
    this->HasSession = isSession;
    this->updateActions();
  };
  QObject::connect(core->getServerManagerModel(), &pqServerManagerModel::aboutToRemoveServer, this,
    [enable]() { enable(false); });
  QObject::connect(core->getObjectBuilder(), &pqObjectBuilder::finishedAddingServer, this,
    [enable]() { enable(true); });
  this->updateActions();
  // Waits until ParaView has placed it.
  QTimer::singleShot(0, this, [this]() { this->makeRoom(); });
}

pqSchlierenToolBar::~pqSchlierenToolBar()
{
  if (pqApplicationCore* core = pqApplicationCore::instance())
  {
    core->interfaceTracker()->removeInterface(this);
  }
}

void pqSchlierenToolBar::frameConnected(pqViewFrame* frame, pqView* view)
{
  if (!view)
  {
    this->addToEmpty(frame);
  }
}

void pqSchlierenToolBar::addToEmpty(QWidget* frame)
{
  // Inserts the button by its text among ParaView's.
  auto* list = frame->findChild<QWidget*>("ConvertActionsFrame");
  auto* layout = list ? qobject_cast<QBoxLayout*>(list->layout()) : nullptr;
  if (!layout)
  {
    return;
  }
  auto* button = new QPushButton("Schlieren View", list);
  button->setObjectName("SchlierenView");
  button->setToolTip(this->Arrangements.first()->toolTip());
  int place = 0;
  for (int item = 0; item < layout->count(); ++item)
  {
    auto* other = qobject_cast<QPushButton*>(layout->itemAt(item)->widget());
    const bool isBefore = !other || other->text() < button->text();
    place = isBefore && layout->itemAt(item)->widget() ? item + 1 : place;
  }
  layout->insertWidget(place, button);
  QObject::connect(
    button, &QPushButton::clicked, this,
    [this, cell = QPointer<QWidget>(frame)]()
    {
      QWidget* views = cell;
      while (views && !qobject_cast<pqMultiViewWidget*>(views))
      {
        views = views->parentWidget();
      }
      if (views)
      {
        this->add(SchlierenViews::Arrangement::OneImage,
          { qobject_cast<pqMultiViewWidget*>(views)->layoutManager(),
            cell->property("FRAME_INDEX").toInt() });
      }
    },
    Qt::QueuedConnection); // the button is deleted with the empty cell
}

QAction* pqSchlierenToolBar::addArrangement(const char* name, const QString& text,
  const QString& hint, SchlierenViews::Arrangement arrangement)
{
  auto* action = new QAction(QIcon(QString(":/Schlieren/%1.svg").arg(name)), text, this);
  action->setObjectName(QString("action%1").arg(name));
  action->setToolTip(hint); // a status tip would clear the message below the window
  this->addAction(action);
  QWidget* button = this->widgetForAction(action);
  button->setObjectName(name);
  button->setAccessibleName(action->iconText());
  button->setAccessibleDescription(hint);
  this->Arrangements.append(action);
  QObject::connect(
    action, &QAction::triggered, this, [this, arrangement]() { this->add(arrangement); });
  return action;
}

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
  menu->addSeparator();
  QAction* figure = menu->addAction("Save Schlieren &Figure...",
    [this]() {
      this->showResult({ false, true, menuActions::saveFigure() });
    });
  figure->setObjectName("actionSaveFigure");
  figure->setToolTip(
    "Save the image of the active view with axes, legend and title as PNG, PDF or SVG");
  QObject::connect(
    menu, &QMenu::aboutToShow, figure, [figure]() { figure->setEnabled(menuActions::hasImage()); });
  QAction* photograph = menu->addAction("Beside a &Photograph...",
    [this]() {
      this->showResult({ false, true, menuActions::compareWithPhotograph() });
    });
  photograph->setObjectName("actionPhotograph");
  photograph->setToolTip(
    "Compare the image of a filter Schlieren with a photograph of the experiment");
  QAction* copyK = menu->addAction("Copy &k of Photograph", &menuActions::copyK);
  copyK->setObjectName("actionCopyK");
  copyK->setToolTip("Give the k that was found in the photograph to the image");
  QObject::connect(menu, &QMenu::aboutToShow, copyK,
    [copyK]() { copyK->setEnabled(menuActions::kOfPhotograph() > 0); });
  static const char* const examples[][3] = { // function of schlieren_examples, text, tool tip
    { "jet", "Under-Expanded &Jet", "Air from a nozzle: knife edge" },
    { "bow_shock", "&Bow Shock", "A sphere at Mach 2: shadowgraph" },
    { "aerofoil", "Transonic &Aerofoil", "NACA 0012 at Mach 0.8: knife edge" },
    { "plume", "&Plume", "Warm air before stripes: background-oriented schlieren" },
    { "shock_bubble", "&Shock Meets a Bubble", "Helium in air, over time: knife edge" },
    { "interferogram", "&Interferogram", "The jet before a tilted reference beam" },
    { "mirage", "&Mirage", "A car on a hot road" },
    { "tank", "&Tank of Salt Water", "Stripes behind salt that diffuses" }
  };
  this->Examples = menu->addMenu("&Examples");
  this->Examples->setObjectName("menuExamples");
  this->Examples->setToolTipsVisible(true);
  for (const auto& [name, text, hint] : examples)
  {
    QAction* example =
      this->Examples->addAction(text, [this, name = name]() { this->showExample(name); });
    example->setObjectName(name);
    example->setToolTip(hint);
  }
  menu->addSeparator();
  QAction* status = menu->addAction("Show &Status in Views");
  status->setObjectName("actionStatus");
  status->setCheckable(true);
  status->setChecked(pqImageStatus::isShown());
  QObject::connect(status, &QAction::toggled, &pqImageStatus::setShown);
  QAction* guide =
    menu->addAction("&Guide", []() { pqHelpReaction::showProxyHelp("filters", "Schlieren"); });
  guide->setObjectName("actionGuide");
  guide->setToolTip("Show what the settings mean in ParaView's help");
  guide->setVisible(SCHLIEREN_HAS_HELP); // ParaView would show its own first page
  const QList<QAction*> menus = window->menuBar()->actions();
  window->menuBar()->insertMenu(menus.empty() ? nullptr : menus.last(), menu);
}

void pqSchlierenToolBar::add(SchlierenViews::Arrangement arrangement,
  const SchlierenViews::Cell& cell, const Completion& completion)
{
  if (!this->HasSession)
  {
    return;
  }
  const SchlierenViews::Result result = SchlierenViews::add(arrangement, cell, completion);
  for (QPushButton* before : std::exchange(this->Offers, {}))
  {
    delete before;
  }
  // Queued, because buttons are deleted.
  const auto takes = [this, arrangement, cell](const Completion& chosen)
  { return [this, arrangement, cell, chosen]() { this->add(arrangement, cell, chosen); }; };
  const auto offers = [&](const char* name, Completion::Kind kind)
  {
    QObject::connect(this->offer(name, inWords(kind)), &QPushButton::clicked, this, takes({ kind }),
      Qt::QueuedConnection);
  };
  if (result.offer.kind == Completion::UniformPressure)
  {
    offers("UniformPressure", Completion::UniformPressure);
    offers("Water", Completion::Water);
  }
  pqOutputPort* port = pqActiveObjects::instance().activePort();
  if (!result.isMade && port && problemOfServer(port->getServer()).isEmpty() &&
    problemOfFlow(port).isEmpty())
  {
    auto* menu = new QMenu;
    menu->setObjectName("Arrays");
    for (const FlowArray& array : arraysOfFlow(port))
    {
      if (array.components == 1)
      {
        QAction* action = menu->addAction(QString::fromStdString(array.name));
        QObject::connect(action, &QAction::triggered, this->message(), &QMessageBox::hide);
        QObject::connect(action, &QAction::triggered, this,
          takes({ Completion::Density, array.name }), Qt::QueuedConnection);
      }
    }
    if (!menu->isEmpty())
    {
      QPushButton* arrays = this->offer("Density", inWords(Completion::Density));
      arrays->setMenu(menu);
      menu->setParent(arrays, menu->windowFlags());
    }
    else
    {
      delete menu;
    }
  }
  this->showResult(result);
}

QPushButton* pqSchlierenToolBar::offer(const char* name, const QString& text)
{
  auto* button = new QPushButton(text);
  button->setObjectName(name);
  this->message()->addButton(button, QMessageBox::AcceptRole);
  this->Offers << button;
  return button;
}

QMessageBox* pqSchlierenToolBar::message()
{
  if (!this->Message)
  {
    this->Message = new QMessageBox(QMessageBox::Information, "Schlieren", QString(),
      QMessageBox::Ok, pqCoreUtilities::mainWidget());
    this->Message->setObjectName("SchlierenMessage");
  }
  return this->Message;
}

void pqSchlierenToolBar::showExample(const char* name)
{
  if (!this->HasSession)
  {
    return;
  }
  const QString problem = menuActions::openExample(name);
  if (!problem.isEmpty())
  {
    this->showResult({ false, true, problem });
    return;
  }
  const QPointer<pqPipelineSource> filter = pqActiveObjects::instance().activeSource();
  this->add(SchlierenViews::Arrangement::OneImage);
  if (filter)
  {
    pqApplicationCore::instance()->getObjectBuilder()->destroy(filter); // the view has its settings
  }
}

void pqSchlierenToolBar::makeRoom()
{
  auto* window = qobject_cast<QMainWindow*>(this->parentWidget());
  const QByteArray places =
    pqApplicationCore::instance()->settings()->value("MainWindow/Layout").toByteArray();
  QByteArray name; // the format of QMainWindow::saveState()
  for (const QChar letter : this->objectName())
  {
    name.append(static_cast<char>(letter.row())).append(static_cast<char>(letter.cell()));
  }
  if (window && !places.contains(name))
  {
    window->addToolBar(Qt::TopToolBarArea, this);
  }
}

void pqSchlierenToolBar::showResult(const SchlierenViews::Result& result)
{
  if (!result.isMade && result.message.isEmpty())
  {
    return; // cancelled
  }
  if (!result.isMade)
  {
    this->message()->setText(result.message);
    this->message()->open();
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
    // Waits, because the button's remaining work would clear it.
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

void pqSchlierenToolBar::updateActions()
{
  const bool hasSource = pqActiveObjects::instance().activeSource() != nullptr;
  for (QAction* action : this->Arrangements)
  {
    action->setEnabled(hasSource && this->HasSession);
  }
  if (this->Examples)
  {
    this->Examples->setEnabled(this->HasSession);
  }
}
