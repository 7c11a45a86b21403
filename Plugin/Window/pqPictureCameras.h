// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QHash>
#include <QObject>
#include <QPointer>

class pqPipelineSource;
class pqRenderView;
class pqView;

/// Keeps pictures in sight that follow a camera: they lie at the coordinates of what they show, so they move
/// in their 2-D views when the camera does. The camera of such a view moves along, and stays at the same
/// place over the picture.
class pqPictureCameras : public QObject
{
  Q_OBJECT

public:
  explicit pqPictureCameras(QObject* parent);
  ~pqPictureCameras() override;

  /// Fills a view with the image of a filter, as soon as there is one.
  static void fit(pqRenderView* view, pqPipelineSource* filter);

private:
  /// The picture that a view's camera was last arranged for, data units.
  struct Place
  {
    QPointer<pqPipelineSource> Filter;
    double Center[2];
    double HalfHeight;
  };

  void watch(pqView* view);
  void arrange(pqRenderView* view);

  QHash<QObject*, Place> Places; // of views
};
