// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqPictureWidget.h"

#include "pqCoreUtilities.h"
#include "pqFileDialog.h"

#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"

#include <QBuffer>
#include <QColor>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QImageReader>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace
{

const QString pngHeader = "data:image/png;base64,";
const QString nameKey = "Title";  // of the text in a PNG that keeps its file's name
constexpr int largestSide = 2048; // pixels: the picture goes into every state file
constexpr int shownSide = 128;    // pixels

/// A filter that has no picture: the direction of deflection is the hue, its size the saturation.
QImage colorWheel()
{
  QImage wheel(shownSide, shownSide, QImage::Format_RGB32);
  for (int row = 0; row < shownSide; ++row)
  {
    for (int column = 0; column < shownSide; ++column)
    {
      const double u = 2 * (column + 0.5) / shownSide - 1, v = 1 - 2 * (row + 0.5) / shownSide;
      const double turn = std::atan2(v, u) / (2 * std::acos(-1));
      wheel.setPixelColor(column, row,
        QColor::fromHsvF(turn < 0 ? turn + 1 : turn, std::min(1., std::hypot(u, v)), 1));
    }
  }
  return wheel;
}

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

} // namespace

//------------------------------------------------------------------------------
class pqPictureWidget::Preview : public QWidget
{
public:
  Preview(bool hasAxes, QWidget* parentWidget)
    : QWidget(parentWidget)
    , HasAxes(hasAxes)
    , Margin(hasAxes ? this->fontMetrics().height() : 0)
  {
    this->setFixedSize(shownSide + 3 * this->Margin, shownSide + 2 * this->Margin);
  }

  bool hasAxes() const { return this->HasAxes; }

  void show(const QImage& image)
  {
    this->Shown = image.isNull()
      ? QImage()
      : image.scaled(shownSide, shownSide,
          this->HasAxes ? Qt::IgnoreAspectRatio : Qt::KeepAspectRatio, Qt::SmoothTransformation);
    if (!this->HasAxes)
    {
      this->setFixedSize(this->Shown.size().expandedTo(QSize(1, 1)));
    }
    this->update();
  }

protected:
  void paintEvent(QPaintEvent*) override
  {
    QPainter painter(this);
    const QRect place(QPoint(this->Margin, this->Margin), this->Shown.size());
    painter.drawImage(place, this->Shown);
    if (!this->HasAxes)
    {
      return;
    }
    painter.setPen(QPen(QColor(0, 0, 0, 128), 1, Qt::DashLine));
    const QPoint middle = place.center();
    painter.drawLine(place.left(), middle.y(), place.right(), middle.y());
    painter.drawLine(middle.x(), place.top(), middle.x(), place.bottom());
    painter.setPen(this->palette().color(QPalette::WindowText));
    const int line = this->Margin;
    const auto write = [&](int x, int y, const QString& text)
    { painter.drawText(QRect(x - 30, y - line / 2, 60, line), Qt::AlignCenter, text); };
    write(middle.x(), line / 2, QString::fromUtf8("k ε\u1D65 = 1"));
    write(middle.x(), place.bottom() + line / 2 + 1, QString::fromUtf8("\u22121"));
    write(line / 2, middle.y(), QString::fromUtf8("\u22121"));
    painter.drawText(QRect(place.right() + 3, middle.y() - line, 2 * line, 2 * line),
      Qt::AlignLeft | Qt::AlignVCenter, QString::fromUtf8("k ε\u1D64\n= 1"));
  }

private:
  const bool HasAxes;
  const int Margin;
  QImage Shown;
};

//------------------------------------------------------------------------------
pqPictureWidget::pqPictureWidget(
  vtkSMProxy* smProxy, vtkSMProperty* smProperty, QWidget* parentObject)
  : pqPropertyWidget(smProxy, parentObject)
{
  this->setProperty(smProperty);
  vtkPVXMLElement* hints = smProperty->GetHints();
  vtkPVXMLElement* hint = hints ? hints->FindNestedElementByName("SchlierenPicture") : nullptr;
  const bool isFilter = hint && QString(hint->GetAttribute("plane")) == "deflection";

  this->View = new Preview(isFilter, this);
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
  this->View->show(isEmpty && this->View->hasAxes() ? colorWheel() : image);
  this->Clear->setEnabled(!isEmpty);
  if (isEmpty)
  {
    this->Note->setText(this->View->hasAxes() ? tr("the colour wheel") : tr("no picture"));
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
  QImage image = opaque(read);
  image.setText(nameKey, QFileInfo(file).fileName());
  QBuffer png;
  image.save(&png, "PNG");
  this->setPicture(pngHeader + QString::fromLatin1(png.data().toBase64()));
}

//------------------------------------------------------------------------------
void pqPictureWidget::clear() { this->setPicture(QString("")); } // a null one would not be sent
