// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QList>
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
  explicit pqRepresentationRefiner(QObject* parent);

  /// Returns whether a representation is visible and draws its data as Schlieren.
  static bool isSchlieren(pqRepresentation* representation);

  /// Lists the proxies of the filters inside of the representations that a view draws as Schlieren.
  static QList<vtkSMProxy*> benchesIn(pqView* view);

  /// Returns whether the user turns or moves a render view.
  static bool isAnyBeingTurned();

  /// Renders the views of a filter inside of a representation after changes; ignores others.
  static void renderViewsOf(vtkSMProxy* bench);

private Q_SLOTS:
  void watch(pqView* view);

private:
  void limit(pqRepresentation* representation);
  void refineLater(pqView* view);
  void refine(pqView* view);
};
