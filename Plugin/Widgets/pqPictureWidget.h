// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqColorFilterPicture.h"
#include "pqPropertyWidget.h"

#include <QString>
#include <QTimer>

#include <memory>

class pqCutoffLightFetcher;
class pqLiveEdit;
class pqPicturePainter;
class pqPictureView;
class QAbstractButton;
class QGridLayout;
class QLabel;

/// Shows the picture that a text property names or holds, loads another one into it, or has the user
/// paint one. What is loaded is read where the window runs, and the property then holds all of it as a PNG
/// ("data:image/png;base64,..."): state files keep it, and servers need not find a file.
///
/// A hint in the XML tells what the picture is laid out over:
///
///     <SchlierenPicture plane="deflection"/>
///
/// is a colour filter on the cutoff plane, drawn as a square with the axes k eps_u and k eps_v from -1 to
/// 1; the colour wheel stands there where the property is empty. It can be painted on, here or through the
/// picture in a view, and each stroke is in the picture at once and undone at once. The eraser brings back
/// what was there before the first stroke, which is kept in the PNG. Without the hint, the picture is
/// shown as is.
class pqPictureWidget : public pqPropertyWidget
{
  Q_OBJECT
  Q_PROPERTY(QString picture READ picture WRITE setPicture NOTIFY pictureChanged)

public:
  pqPictureWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);
  ~pqPictureWidget() override;

  /// A file name, a data URI, or nothing.
  const QString& picture() const { return this->Picture; }
  void setPicture(const QString& picture);

Q_SIGNALS:
  void pictureChanged();

protected:
  void hideEvent(QHideEvent* event) override;

private Q_SLOTS:
  void load();
  void save();
  void clear();
  void beginStroke();
  void brush(const QVector<QPointF>& places);
  void showStroke();
  void endStroke();
  void fill();
  void paintOnPicture(bool on);
  void showLight();

private:
  QAbstractButton* newButton(const char* name, const QString& text, const QString& tip);
  void addPainting(QGridLayout* grid);
  void showPicture();

  QString Picture;
  pqPictureView* View;
  QLabel* Note;
  QAbstractButton *Clear, *Save = nullptr, *Light = nullptr, *OnPicture = nullptr;

  // Of a colour filter.
  pqColorFilterPicture::Brush Brush;
  QImage Canvas, Underneath;
  bool IsPainting = false;
  QTimer Pause; ///< until what has been painted is shown
  std::unique_ptr<pqLiveEdit> Edit;
  pqCutoffLightFetcher* Fetcher = nullptr;
  pqPicturePainter* Painter = nullptr;
};
