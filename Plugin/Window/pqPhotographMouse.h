// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>
#include <QPointer>

#include "vtkNew.h"

class pqPipelineSource;
class pqView;
class vtkCommand;
class vtkEventQtSlotConnect;
class vtkObject;

/// The mouse over a comparison with a photograph: drags the line between both, and has the window's status line say how far the
/// feature under it lies from where it is simulated.
class pqPhotographMouse : public QObject
{
  Q_OBJECT

public:
  explicit pqPhotographMouse(QObject* parent);
  ~pqPhotographMouse() override;

private Q_SLOTS:
  void onMouse(vtkObject* interactor, unsigned long event, void*, void*, vtkCommand* command);

private:
  void watch(pqView* view);

  vtkNew<vtkEventQtSlotConnect> Events;
  QPointer<pqPipelineSource> Swiped; // while the line is dragged
};
