// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkNew.h"

#include <QHash>
#include <QList>
#include <QObject>
#include <QPointer>
#include <QTimer>

class pqPipelineSource;
class pqRenderView;
class pqServerManagerModelItem;
class pqView;
class vtkEventQtSlotConnect;
class vtkObject;

/// Gives each Schlieren filter the view of the camera that it follows (FollowedView).
///
/// While the mouse turns that camera, the filter's view is set now and then, for hurried pictures; otherwise
/// at once, so that whoever sets a camera and renders next (animations, scripts) gets the picture of it.
class pqCameraFollower : public QObject
{
  Q_OBJECT

public:
  pqCameraFollower();
  ~pqCameraFollower() override;

  /// Called when the plugin is loaded and when the program ends.
  void startup();
  void shutdown();

private Q_SLOTS:
  void watchView(pqView* view);
  void watchSource(pqPipelineSource* source);
  void onCamera(vtkObject* camera, unsigned long event, void* view);
  void onFilter(vtkObject* filter);
  void onName(pqServerManagerModelItem* item);
  void onReleased();
  void catchUp();

private:
  void catchUpSoon();
  bool push(pqPipelineSource* filter, pqRenderView* view);

  // Filters whose cameras have changed: not to be told until the mouse rests, or told and to be refined.
  QList<QPointer<pqPipelineSource>> Changed;
  QHash<QObject*, QPointer<pqRenderView>> Followed; // to notice that a view gets another name
  QTimer Timer;
  bool IsPushing = false;
  bool IsCatchingUp = false;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
