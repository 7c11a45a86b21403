// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <QObject>
#include <QPointF>
#include <QPointer>
#include <QVector>

class pqView;
class vtkCommand;
class vtkEventQtSlotConnect;
class vtkImageData;
class vtkObject;
class vtkRenderWindowInteractor;
class vtkSMProxy;

/// Paints a colour filter by brushing over its image in render views: paints the filter where rays
/// of the brushed pixels meet the cutoff plane (Brownlee et al. 2011, fig. 9).
class pqImagePainter : public QObject
{
  Q_OBJECT

public:
  explicit pqImagePainter(vtkSMProxy* filter, QObject* parent = nullptr);
  ~pqImagePainter() override;

  /// Captures the left mouse button in the views. Returns false if no view shows the image.
  bool start();
  void stop();
  bool isOn() const { return !this->Views.isEmpty(); }

public Q_SLOTS:
  /// Sets the radius as a fraction of the image's shorter side.
  void setBrushRadius(double radius) { this->BrushRadius = radius; }

Q_SIGNALS:
  void strokeBegan();
  /// Sends points of the filter, each coordinate from -1 to 1, v upwards; the first is where the mouse is.
  void brushed(const QVector<QPointF>& places);
  void strokeEnded();
  /// Painting has ended, by Escape or with the views.
  void stopped();

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private Q_SLOTS:
  void mouseEvent(
    vtkObject* caller, unsigned long event, void* client, void* data, vtkCommand* command);
  void viewRemoved(pqView* view);

private:
  bool fetchDeflection();
  void brush(vtkRenderWindowInteractor* interactor);
  QVector<QPointF> placesAround(const QPointF& position) const;

  vtkWeakPointer<vtkSMProxy> Filter;
  QVector<QPointer<pqView>> Views;
  pqView* Pressed = nullptr;
  double BrushRadius = 0.04;
  double K = 0;
  int FetchedImage = 0; ///< its ImageCount
  vtkSmartPointer<vtkImageData> Deflection;
  QPointF Last; ///< mouse position in the image
  bool HasLast = false;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
