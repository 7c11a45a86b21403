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
#include <QSet>
#include <QTimer>

class pqPipelineSource;
class pqProxy;
class pqView;
class vtkEventQtSlotConnect;
class vtkObject;
class vtkSMProxy;
class vtkSMSourceProxy;

/// Brings the pictures of Schlieren filters up to date in the window, in pieces so short that it always
/// answers.
///
/// A turn is one update of one filter, ended by its TimeLimit, and a rendering of the views that show it;
/// between turns the window does whatever else there is to do, and filters take turns in a circle. Outside
/// its turns a filter that is not finished is ready to go on, without a limit: whatever else updates it
/// (Apply, a screenshot, a script) gets the whole picture.
class pqPictureRefiner : public QObject
{
  Q_OBJECT

public:
  /// The one of this program; made when first asked for.
  static pqPictureRefiner* instance();

  enum class Pace
  {
    Hurried, ///< while the mouse is down: a rough picture, and more of them follow
    Shading, ///< like Thorough, where only optics have changed: rays are held, and no picture is rough
    Thorough ///< a first picture soon, then better ones up to the set quality
  };

  /// Shows the picture of a filter whose properties have changed and been pushed (UpdateVTKObjects), in all
  /// views that show it. What has been begun for this filter before is given up.
  void refine(vtkSMProxy* filter, Pace pace);

  /// Leaves all images as they are that are being refined.
  void stop();

  /// Whether a filter's image has been left unfinished by the user, and going on with it.
  bool isStopped(vtkSMProxy* filter) const;
  void resume(vtkSMProxy* filter);

  /// Whether there are ShortUpdates.
  bool isShort() const { return this->NumberOfShortUpdates > 0; }

  /// Whether this is an event loop within a step of an animation: what updates a filter now updates it to the new
  /// time, and the frame that is then rendered, and perhaps saved, has nothing else.
  bool isAnimationStep() const { return this->IsAnimationStep; }

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
  /// Views now show another picture of the filter.
  void pictureChanged(vtkSMProxy* filter);

  /// What is being refined for some time now, and how much of it is there; nothing any more: empty.
  void progressed(const QString& what, int percent);

  /// isStopped() has changed.
  void stoppedChanged(vtkSMProxy* filter);

private Q_SLOTS:
  void takeTurn();
  void wakeUp();
  void watch(pqView* view);
  void watchAnimation(pqProxy* item);
  void onAnimationStep();
  void onAnimationStepOver();
  void forget(pqPipelineSource* source);
  void onStartRender(vtkObject* view, unsigned long event, void* client, void* isInteractive);
  void onEndRender(vtkObject* view);

private:
  struct Job;
  struct Speed;

  explicit pqPictureRefiner(QObject* parent);
  ~pqPictureRefiner() override;

  /// All return whether there is more to do.
  bool takeTurn(Job& job);
  bool hurry(Job& job, const QList<QPointer<pqView>>& views);
  bool goOn(Job& job, const QList<QPointer<pqView>>& views);

  void limit(vtkSMSourceProxy* filter);
  void unlimit();
  void report();
  void setStopped(vtkSMProxy* filter, bool isStopped);
  void show(vtkSMSourceProxy* filter, vtkIdType& shownCount, const QList<QPointer<pqView>>& views);
  void keep(vtkSMProxy* filter, const Speed& speed);
  void tellUpdate(pqPipelineSource* source);
  QList<Job>::iterator nextJob();
  bool hasJob(vtkSMSourceProxy* filter) const;

  QList<Job> Jobs; // the next one first
  QHash<vtkSMProxy*, Speed> Speeds;
  QList<vtkWeakPointer<vtkSMSourceProxy>> Untold; // updated, and panels do not know it yet
  QTimer Timer;
  bool IsBusy = false;
  bool IsAnimationStep = false;
  QList<vtkWeakPointer<vtkSMSourceProxy>>
    Limited; // while a view answers the user, and by ShortUpdates
  int NumberOfShortUpdates = 0;
  QSet<vtkSMProxy*> Stopped;
  QElapsedTimer SinceReport; // valid while something is reported
  vtkNew<vtkEventQtSlotConnect> Connection;
};
