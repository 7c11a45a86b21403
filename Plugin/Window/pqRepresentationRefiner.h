// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QElapsedTimer>
#include <QHash>
#include <QObject>

class pqRepresentation;
class pqView;
class vtkSMProxy;

/// Refines images of representations while the window is idle: limits the tracing of a rendering,
/// and requests streaming updates of views until images are complete. ParaView's
/// pqViewStreamingBehavior serves only the active view, and depends on a global setting.
class pqRepresentationRefiner : public QObject
{
  Q_OBJECT

public:
  /// Returns the only instance; the first call makes it.
  static pqRepresentationRefiner* instance();

  /// Stops refining all images until something else changes them.
  void stop();

Q_SIGNALS:
  /// The image of a filter inside of a representation is complete.
  void imageChanged(vtkSMProxy* bench);

  /// Reports what is refined for some time, in words, and its completed fraction; empty: nothing is.
  void progressed(const QString& what, int percent);

private Q_SLOTS:
  void watch(pqView* view);

private:
  explicit pqRepresentationRefiner(QObject* parent);
  void limit(pqRepresentation* representation);
  void refineLater(pqView* view);
  void refine(pqView* view);
  /// Notes whether a view has unfinished images.
  void note(pqView* view, bool isUnfinished);
  void report();

  QHash<pqView*, QElapsedTimer> Since; // of views with unfinished images
  bool IsReported = false;
};
