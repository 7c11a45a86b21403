// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QList>
#include <QObject>

class pqRepresentation;
class pqView;
class vtkSMProxy;

/// Lets images of data that are drawn as Schlieren appear coarse and improve while the window waits for the user: it
/// limits what one rendering traces, and requests streaming updates of their views until all images are complete.
/// ParaView's own pqViewStreamingBehavior serves the active view alone, and only with a global switch.
class pqRepresentationRefiner : public QObject
{
  Q_OBJECT

public:
  explicit pqRepresentationRefiner(QObject* parent);

  /// Whether a representation is visible and draws its data as Schlieren.
  static bool isSchlieren(pqRepresentation* representation);

  /// The proxies of the filters inside of the representations that a view draws as Schlieren.
  static QList<vtkSMProxy*> benchesIn(pqView* view);

  /// Whether the user turns or moves what a render view shows.
  static bool isAnyBeingTurned();

  /// Shows what has changed of the proxy of the filter inside of a representation; of no effect for others.
  static void renderViewsOf(vtkSMProxy* bench);

private Q_SLOTS:
  void watch(pqView* view);

private:
  void limit(pqRepresentation* representation);
  void refineLater(pqView* view);
  void refine(pqView* view);
};
