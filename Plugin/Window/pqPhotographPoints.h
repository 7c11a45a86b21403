// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>
#include <QPointer>

#include "vtkNew.h"

#include <array>
#include <vector>

class pqPipelineSource;
class pqRenderView;
class vtkEventQtSlotConnect;
class vtkSeedWidget;

/// Two points in a view of an image and in one of a photograph, which place the photograph of a comparison: the user clicks them, and
/// drags them afterwards, each time as one undo step. It deletes itself with the comparison or one of the views.
class pqPhotographPoints : public QObject
{
  Q_OBJECT

public:
  pqPhotographPoints(pqPipelineSource* comparison, pqRenderView* image, pqRenderView* photograph);
  ~pqPhotographPoints() override;

private Q_SLOTS:
  /// Places the photograph once all points are there.
  void place();
  /// Moves the points to where the properties of the comparison have them.
  void follow();

private:
  /// Returns the point with the index 0 or 1, x and y.
  static std::vector<double> pointOf(vtkSeedWidget* seeds, int index);

  pqPipelineSource* Comparison;
  std::array<QPointer<pqRenderView>, 2> Views; // of the image, of the photograph
  std::array<vtkNew<vtkSeedWidget>, 2> Seeds;  // in each of them
  vtkNew<vtkEventQtSlotConnect> Events;
};
