// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkNew.h"
#include "vtkType.h" // for vtkIdType
#include "vtkWeakPointer.h"

#include <QElapsedTimer>
#include <QHash>
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

/// Refines the images of Schlieren filters in the window, in turns that are short enough for it to
/// respond.
/// A turn is an update of a filter, limited by TimeLimit, and a rendering of its views; filters
/// take turns. Updates by a rendering are limited, too. At all other times unfinished filters have
/// no limit, so that screenshots, animations, scripts and saved data have complete images.
class pqImageRefiner : public QObject
{
  Q_OBJECT

public:
  /// Returns the only instance; the first call makes it.
  static pqImageRefiner* instance();

  /// Shows a filter's image, also in a representation, in all its views after UpdateVTKObjects().
  void refine(vtkSMProxy* filter);

  /// Stops refining all images, those that views draw, too, until something else changes them.
  void stop();

  /// Reports a step of pqRepresentationRefiner in a view, and whether its images need more of them.
  void onRefinedInView(pqView* view, bool isUnfinished);

  /// Returns whether there are ShortUpdates.
  bool isShort() const { return this->NumberOfShortUpdates > 0; }

  /// Returns whether an animation plays, whose frames, perhaps saved, are complete.
  bool isPlaying() const { return this->IsPlaying; }

  /// Limits updates of all filters to a turn during its lifetime; unfinished images are refined
  /// afterwards. Do not push properties meanwhile, or the undo stack would have the limit.
  class ShortUpdates
  {
  public:
    ShortUpdates();
    ~ShortUpdates();
    ShortUpdates(const ShortUpdates&) = delete;
    ShortUpdates& operator=(const ShortUpdates&) = delete;
  };

Q_SIGNALS:
  /// Views show another image of the filter.
  void imageChanged(vtkSMProxy* filter);

  /// Reports what is refined for some time, in words, and its completed fraction; empty: nothing is.
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
    vtkIdType ShownCount = -1; ///< PictureCount of the image in views
    bool IsAnnounced = false;  ///< panels have been notified of it
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
  QList<vtkSMProxy*> reported() const; ///< images that are refined for some time

  QList<Job> Jobs;                            // in the order of turns
  QHash<pqView*, QElapsedTimer> SinceInViews; // of views that draw unfinished images
  QTimer Timer;
  bool IsBusy = false;
  bool IsPlaying = false;
  QList<vtkWeakPointer<vtkSMSourceProxy>> Limited; // during renderings and ShortUpdates
  int NumberOfShortUpdates = 0;
  QElapsedTimer SinceReport; // valid during reports
  vtkNew<vtkEventQtSlotConnect> Connection;
};
