// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqPictureWidget.h"

#include "pqColorChooserButton.h"
#include "pqCoreUtilities.h"
#include "pqFileDialog.h"
#include "pqPictureView.h"

#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"

#include <QBuffer>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QImageReader>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>

namespace
{

const QString nameKey = "Title";  // of the text in a PNG that keeps its file's name
constexpr int largestSide = 2048; // pixels: the picture goes into every state file

/// What a property holds, or a null image.
QImage decoded(const QString& picture)
{
  if (picture.startsWith("data:"))
  {
    const int comma = picture.indexOf(',');
    return QImage::fromData(QByteArray::fromBase64(picture.mid(comma + 1).toLatin1()));
  }
  return picture.isEmpty() ? QImage() : QImage(picture);
}

/// An image without transparency and not too large, for a PNG. What is transparent lets all light pass.
QImage opaque(const QImage& read)
{
  QImage image(read.size(), QImage::Format_RGB888);
  image.fill(Qt::white);
  QPainter(&image).drawImage(0, 0, read);
  if (std::max(image.width(), image.height()) > largestSide)
  {
    image = image.scaled(largestSide, largestSide, Qt::KeepAspectRatio, Qt::SmoothTransformation);
  }
  return image;
}

/// What a property is to hold; `name` is kept in the PNG.
QString encoded(QImage image, const QString& name)
{
  image.setText(nameKey, name);
  QBuffer png;
  image.save(&png, "PNG");
  return "data:image/png;base64," + QString::fromLatin1(png.data().toBase64());
}

} // namespace

//------------------------------------------------------------------------------
pqPictureWidget::pqPictureWidget(
  vtkSMProxy* smProxy, vtkSMProperty* smProperty, QWidget* parentObject)
  : pqPropertyWidget(smProxy, parentObject)
{
  this->setProperty(smProperty);
  vtkPVXMLElement* hints = smProperty->GetHints();
  vtkPVXMLElement* hint = hints ? hints->FindNestedElementByName("SchlierenPicture") : nullptr;
  const bool isFilter = hint && QString(hint->GetAttribute("plane")) == "deflection";

  this->View = new pqPictureView(isFilter, this);
  this->View->setObjectName("Preview");
  this->Note = new QLabel(this);
  this->Note->setObjectName("Note");
  this->Note->setTextFormat(Qt::PlainText);
  this->Note->setWordWrap(true);
  auto* load = new QPushButton(tr("&Load..."), this);
  load->setObjectName("Load");
  load->setToolTip(
    tr("Reads a PNG, or any picture, into this property: state files keep it. At most %1 pixels "
       "along a side; larger ones are scaled down.")
      .arg(largestSide));
  this->Clear = new QPushButton(tr("&Clear"), this);
  this->Clear->setObjectName("Clear");
  this->Clear->setToolTip(tr("Takes the picture out."));

  auto* buttons = new QHBoxLayout;
  buttons->addWidget(load);
  buttons->addWidget(this->Clear);
  if (isFilter)
  {
    auto* brush = new pqColorChooserButton(this);
    brush->setObjectName("Brush");
    brush->setToolTip(tr("The colour to paint with on the filter"));
    brush->setAccessibleName(brush->toolTip());
    brush->setChosenColor(Qt::black);
    buttons->addWidget(brush);
    QObject::connect(
      brush, &pqColorChooserButton::chosenColorChanged, this->View, &pqPictureView::setBrush);
    QObject::connect(this->View, &pqPictureView::painted, this,
      [this]() { this->setPicture(encoded(this->View->picture(), tr("painted"))); });
  }
  buttons->addStretch();
  auto* column = new QVBoxLayout(this);
  column->setMargin(0);
  column->addWidget(this->View);
  column->addWidget(this->Note);
  column->addLayout(buttons);

  QObject::connect(load, &QPushButton::clicked, this, &pqPictureWidget::load);
  QObject::connect(this->Clear, &QPushButton::clicked, this, &pqPictureWidget::clear);
  this->showPicture();
  this->addPropertyLink(this, "picture", SIGNAL(pictureChanged()), smProperty);
}

//------------------------------------------------------------------------------
pqPictureWidget::~pqPictureWidget() = default;

//------------------------------------------------------------------------------
void pqPictureWidget::setPicture(const QString& picture)
{
  if (this->Picture != picture)
  {
    this->Picture = picture;
    this->showPicture();
    Q_EMIT this->pictureChanged();
  }
}

//------------------------------------------------------------------------------
void pqPictureWidget::showPicture()
{
  const bool isEmpty = this->Picture.isEmpty();
  const QImage image = decoded(this->Picture);
  this->View->setPicture(image);
  this->Clear->setEnabled(!isEmpty);
  if (isEmpty)
  {
    this->Note->setText(this->View->isColorFilter() ? tr("the colour wheel") : tr("no picture"));
    return;
  }
  const bool isName = !this->Picture.startsWith("data:");
  const QString name = isName ? this->Picture : image.text(nameKey);
  QString size = tr("%1 x %2 pixels").arg(image.width()).arg(image.height());
  if (image.isNull())
  {
    size = isName ? tr("a file on the server") : tr("no picture that can be read");
  }
  this->Note->setText(name.isEmpty() ? size : tr("%1: %2").arg(name, size));
}

//------------------------------------------------------------------------------
void pqPictureWidget::load()
{
  pqFileDialog dialog(nullptr, pqCoreUtilities::mainWidget(), tr("Load Picture"), QString(),
    tr("Pictures (*.png *.jpg *.jpeg *.bmp *.ppm);;All files (*)"), false);
  dialog.setObjectName("LoadPictureDialog");
  dialog.setFileMode(pqFileDialog::ExistingFile);
  if (dialog.exec() != QDialog::Accepted || dialog.getSelectedFiles().isEmpty())
  {
    return;
  }
  const QString file = dialog.getSelectedFiles().first();
  QImageReader reader(file);
  reader.setAutoTransform(true);
  const QImage read = reader.read();
  if (read.isNull())
  {
    this->Note->setText(tr("Cannot read '%1': %2. The picture is the one from before.")
                          .arg(file, reader.errorString()));
    return;
  }
  this->setPicture(encoded(opaque(read), QFileInfo(file).fileName()));
}

//------------------------------------------------------------------------------
void pqPictureWidget::clear() { this->setPicture(QString("")); } // a null one would not be sent
