// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidget.h"

#include <QString>

class QLabel;
class QPushButton;
class pqPictureView;

/// Shows the picture that a text property names or holds, loads another one into it, or has the user
/// paint one. What is loaded is read where the window runs, and the property then holds all of it as a PNG
/// ("data:image/png;base64,..."): state files keep it, and servers need not find a file.
///
/// A hint in the XML tells what the picture is laid out over:
///
///     <SchlierenPicture plane="deflection"/>
///
/// is a colour filter on the cutoff plane, drawn as a square with the axes k eps_u and k eps_v from -1 to
/// 1; the colour wheel stands there where the property is empty. Without it, the picture is shown as is.
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

private Q_SLOTS:
  void load();
  void clear();

private:
  void showPicture();

  QString Picture;
  pqPictureView* View;
  QLabel* Note;
  QPushButton* Clear;
};
