// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "HeldInput.h"

#include "pqCoreUtilities.h"
#include "pqProgressWidget.h"

#include <QAction>
#include <QCoreApplication>
#include <QEvent>
#include <QKeyEvent>
#include <QTimer>
#include <QToolButton>

#include <algorithm>

namespace
{

HeldInput* held = nullptr; // the outermost

bool isAbortButton(QObject* receiver)
{
  QWidget* window = pqCoreUtilities::mainWidget();
  auto* bar = window ? window->findChild<pqProgressWidget*>() : nullptr;
  return bar && receiver == bar->abortButton();
}

/// Triggers what a key stands for in ParaView's window.
void press(const QKeySequence& key)
{
  QWidget* window = pqCoreUtilities::mainWidget();
  const auto actions = window ? window->findChildren<QAction*>() : QList<QAction*>();
  const auto found = std::find_if(actions.begin(), actions.end(),
    [&](QAction* action) { return action->isEnabled() && action->shortcuts().contains(key); });
  if (found != actions.end())
  {
    (*found)->trigger();
  }
}

} // namespace

HeldInput::HeldInput()
{
  if (!held)
  {
    held = this;
    QCoreApplication::instance()->installEventFilter(this);
  }
}

HeldInput::~HeldInput()
{
  if (held == this)
  {
    held = nullptr;
    for (const QKeySequence& key : this->Keys)
    {
      QTimer::singleShot(0, pqCoreUtilities::mainWidget(), [key]() { press(key); });
    }
  }
}

bool HeldInput::isInput(QObject* receiver, QEvent* event)
{
  switch (event->type())
  {
    case QEvent::Shortcut:
      return true;
    case QEvent::Close:
    case QEvent::ContextMenu:
    case QEvent::DragEnter:
    case QEvent::Drop:
    case QEvent::KeyPress:
    case QEvent::KeyRelease:
    case QEvent::MouseButtonDblClick:
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonRelease:
    case QEvent::MouseMove:
    case QEvent::ShortcutOverride:
    case QEvent::TouchBegin:
    case QEvent::Wheel:
      return receiver->isWidgetType() && !isAbortButton(receiver); // windows pass events to widgets
    default:
      return false;
  }
}

bool HeldInput::note(QEvent* event)
{
  if (!held || event->type() != QEvent::ShortcutOverride)
  {
    return false;
  }
  auto* key = static_cast<QKeyEvent*>(event);
  if (!key->isAutoRepeat())
  {
    held->Keys << QKeySequence(key->key() | static_cast<int>(key->modifiers()));
  }
  event->accept(); // no shortcut is looked for
  return true;
}

bool HeldInput::eventFilter(QObject* receiver, QEvent* event)
{
  if (!isInput(receiver, event))
  {
    return QObject::eventFilter(receiver, event);
  }
  if (!note(event))
  {
    event->ignore();
  }
  return true;
}
