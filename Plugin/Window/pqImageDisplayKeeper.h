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

/// Keeps images displayed as their filters' cutoffs want it, whoever changes a cutoff: grey, twice as
/// wide for a shadowgraph, or in colour. Lets alone what has been coloured by something else. Views of images get
/// their FXAA back from state files: ParaView itself takes that of its settings then.
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
