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

/// Shows the image of a text property, loads another one into it, or lets the user paint one. The
/// window reads loaded files, and the property then contains a PNG ("data:image/png;base64,..."),
/// so that state files keep it, and servers need not find a file.
///
/// The hint `<SchlierenImage plane="deflection"/>` in the XML marks a colour filter on the cutoff
/// plane: a square with the axes k eps_u and k eps_v from -1 to 1, or the colour wheel if the
/// property is empty. The user paints on it here or through the image in a view; each stroke
/// changes the image at once and is one undo step. The eraser restores what was there before the
/// first stroke, which the PNG keeps.
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
  void paintOnImage(bool on);
  void showLight();

private:
  QAbstractButton* newButton(const char* name, const QString& text, const QString& tip);
  void addPainting(QGridLayout* grid);
  void followStrokes();
  void showImage();

  QString Image;
  pqImageView* View;
  QLabel* Note;
  QAbstractButton *Clear, *Save = nullptr, *Light = nullptr, *OnImage = nullptr;

  pqColorFilterImage::Brush Brush;
  QImage Canvas, Underneath;
  bool IsPainting = false;
  bool IsNewStroke = false; ///< before its first dab
  QTimer Pause;             ///< until a stroke is applied
  std::unique_ptr<pqLiveEdit> Edit;
  pqCutoffLightFetcher* Fetcher = nullptr;
  pqImagePainter* Painter = nullptr;
};
