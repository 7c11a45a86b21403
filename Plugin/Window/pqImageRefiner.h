// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkNew.h"
#include "vtkType.h" // for vtkIdType
#include "vtkWeakPointer.h"

#include <QElapsedTimer>
#include <QList>
#include <QObject>
#include <QPointer>
#include <QTimer>

class pqPipelineSource;
class pqProxy;
class pqView;
class vtkEventQtSlotConnect;
class vtkObject;
class vtkSMProxy;
class vtkSMSourceProxy;

/// Brings the images of Schlieren filters up to date in the window, in pieces so short that it always
/// answers.
///
/// A turn is one update of one filter, ended by its TimeLimit, and a rendering of the views that show it;
/// between turns the window does whatever else there is to do, and filters take turns in a circle. So are updates by
/// the rendering of a view. Outside these a filter that is not finished is ready for more, without a limit: whatever
/// else updates it (a screenshot, an animation, a script, saving data) gets the complete image.
class pqImageRefiner : public QObject
{
  Q_OBJECT

public:
  /// The one of this program; made by the first call.
  static pqImageRefiner* instance();

  /// Shows the image of a filter, or of one inside of a representation, whose properties have changed and been pushed
  /// (UpdateVTKObjects), in all views that show it.
  void refine(vtkSMProxy* filter);

  /// Leaves all images as they are that are being refined, until something else changes them.
  void stop();

  /// Whether there are ShortUpdates.
  bool isShort() const { return this->NumberOfShortUpdates > 0; }

  /// Whether an animation is played, whose frames may be saved: each image is complete.
  bool isPlaying() const { return this->IsPlaying; }

  /// While there is one, updates of all filters are as short as turns, and what they leave unfinished is
  /// refined afterwards. Filters' properties are not to be pushed meanwhile: the undo stack would keep the limit.
  class ShortUpdates
  {
  public:
    ShortUpdates();
    ~ShortUpdates();
    ShortUpdates(const ShortUpdates&) = delete;
    ShortUpdates& operator=(const ShortUpdates&) = delete;
  };

Q_SIGNALS:
  /// Views now show another image of the filter.
  void imageChanged(vtkSMProxy* filter);

  /// What is being refined for some time now, and how much of it is there; nothing any more: empty.
  void progressed(const QString& what, int percent);

private Q_SLOTS:
  void takeTurn();
  void watch(pqView* view);
  void watchAnimation(pqProxy* item);
  void onBeginPlay() { this->IsPlaying = true; }
  void onEndPlay() { this->IsPlaying = false; }
  void forget(pqPipelineSource* source);
  void onStartRender(vtkObject* view);
  void onEndRender(vtkObject* view);

private:
  struct Job
  {
    vtkWeakPointer<vtkSMSourceProxy> Filter;
    vtkIdType ShownCount = -1; ///< PictureCount of the image that views show
    bool IsAnnounced = false;  ///< panels know that there is one
    QElapsedTimer Since{};
  };

  explicit pqImageRefiner(QObject* parent);
  ~pqImageRefiner() override;

  /// Returns whether there is more to do.
  bool takeTurn(Job& job);

  void wakeUp();
  void limit(vtkSMSourceProxy* filter);
  void unlimit();
  void report();
  void show(vtkSMSourceProxy* filter, const QList<QPointer<pqView>>& views);
  bool hasJob(vtkSMSourceProxy* filter) const;

  QList<Job> Jobs; // the next one first
  QTimer Timer;
  bool IsBusy = false;
  bool IsPlaying = false;
  QList<vtkWeakPointer<vtkSMSourceProxy>> Limited; // while a view renders, and by ShortUpdates
  int NumberOfShortUpdates = 0;
  QElapsedTimer SinceReport; // valid while something is reported
  vtkNew<vtkEventQtSlotConnect> Connection;
};
