// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

#include "vtkNew.h"

class pqPipelineSource;
class vtkEventQtSlotConnect;
class vtkObject;
class vtkPVXMLElement;
class vtkSMProxyLocator;

/// Adapts the display of images to changes of their filters' cutoffs: grey, with twice the range
/// for a shadowgraph, or colour, unless the user has coloured them. Restores FXAA of such views
/// from state files, where ParaView uses its settings.
class pqImageDisplayKeeper : public QObject
{
  Q_OBJECT

public:
  explicit pqImageDisplayKeeper(QObject* parent);
  ~pqImageDisplayKeeper() override;

private Q_SLOTS:
  void watch(pqPipelineSource* source);
  void onFilterChanged(vtkObject* filter);
  void onStateLoaded(vtkPVXMLElement* root, vtkSMProxyLocator* locator);

private:
  vtkNew<vtkEventQtSlotConnect> Events;
};
