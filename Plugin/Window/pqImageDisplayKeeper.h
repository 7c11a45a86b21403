// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

#include "vtkNew.h"

class pqPipelineSource;
class vtkEventQtSlotConnect;
class vtkObject;

/// Gives the image of a filter a view of its own when it is applied for the first time, and adapts
/// its display to changes of the cutoff: grey, with twice the range for a shadowgraph, or colour,
/// unless the user has coloured it. A comparison with a photograph gets views for its image and its photograph, too.
class pqImageDisplayKeeper : public QObject
{
  Q_OBJECT

public:
  explicit pqImageDisplayKeeper(QObject* parent);
  ~pqImageDisplayKeeper() override;

private Q_SLOTS:
  void watch(pqPipelineSource* source);
  void onFilterChanged(vtkObject* filter);

private:
  vtkNew<vtkEventQtSlotConnect> Events;
};
