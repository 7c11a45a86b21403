// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqLiveEdit.h"
#include "pqPropertyWidget.h"

#include "vtkNew.h"

#include <QMap>
#include <QVariant>

#include <memory>

class pqCutoffLightFetcher;
class pqCutoffView;
class QLabel;
class vtkSMPropertyGroup;
class vtkEventQtSlotConnect;

/// Edits the cutoff on its plane, over the light there. Dragging the knife edge, its angle or the
/// sensitivity changes the image at once.
class pqCutoffWidget : public pqPropertyWidget
{
  Q_OBJECT

public:
  pqCutoffWidget(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);
  ~pqCutoffWidget() override;

private Q_SLOTS:
  void readCutoff();
  void grabbed();
  void dragged();
  void released(bool keep);

private:
  QMap<QString, QVariant> changes() const;
  void showNumbers();

  pqCutoffView* View;
  QLabel* Numbers;
  pqCutoffLightFetcher* Fetcher;
  std::unique_ptr<pqLiveEdit> Edit;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
