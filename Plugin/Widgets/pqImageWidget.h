// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqColorFilterImage.h"
#include "pqPropertyWidget.h"

#include <QString>
#include <QTimer>

#include <memory>

class pqCutoffLightFetcher;
class pqLiveEdit;
class pqImagePainter;
class pqImageView;
class QAbstractButton;
class QGridLayout;
class QLabel;

/// Shows the image that a text property names or holds, loads another one into it, or has the user
/// paint one. What is loaded is read where the window runs, and the property then holds all of it as a PNG
/// ("data:image/png;base64,..."): state files keep it, and servers need not find a file.
///
/// A hint in the XML names what the image is laid out over:
///
///     <SchlierenImage plane="deflection"/>
///
/// is a colour filter on the cutoff plane, drawn as a square with the axes k eps_u and k eps_v from -1 to
/// 1; the colour wheel stands there where the property is empty. It can be painted on, here or through the
/// image in a view, and each stroke is in the image at once and undone at once. The eraser brings back
/// what was there before the first stroke, which is kept in the PNG. Without the hint, the image is
/// shown as is.
class pqImageWidget : public pqPropertyWidget
{
  Q_OBJECT
  Q_PROPERTY(QString image READ image WRITE setImage NOTIFY imageChanged)

public:
  pqImageWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);
  ~pqImageWidget() override;

  /// A file name, a data URI, or nothing.
  const QString& image() const { return this->Image; }
  void setImage(const QString& image);

Q_SIGNALS:
  void imageChanged();

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
  void paintOnImage(bool on);
  void showLight();

private:
  QAbstractButton* newButton(const char* name, const QString& text, const QString& tip);
  void addPainting(QGridLayout* grid);
  void showImage();

  QString Image;
  pqImageView* View;
  QLabel* Note;
  QAbstractButton *Clear, *Save = nullptr, *Light = nullptr, *OnImage = nullptr;

  // Of a colour filter.
  pqColorFilterImage::Brush Brush;
  QImage Canvas, Underneath;
  bool IsPainting = false;
  QTimer Pause; ///< until what has been painted is shown
  std::unique_ptr<pqLiveEdit> Edit;
  pqCutoffLightFetcher* Fetcher = nullptr;
  pqImagePainter* Painter = nullptr;
};
