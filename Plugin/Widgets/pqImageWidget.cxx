// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqImageWidget.h"

#include "pqColorChooserButton.h"
#include "pqCoreUtilities.h"
#include "pqCutoffLightFetcher.h"
#include "pqFileDialog.h"
#include "pqImagePainter.h"
#include "pqImageView.h"
#include "pqLiveEdit.h"

#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSchlierenFilter.h"

#include <QFileInfo>
#include <QGridLayout>
#include <QImageReader>
#include <QImageWriter>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <utility>

namespace
{

// Keys of texts in a PNG: the file's name, and the image underneath the paint.
const QString nameKey = "Title", underneathKey = "Underneath", wheelName = "wheel";
constexpr int pauseOfStroke = 40; // milliseconds
constexpr int usualBrush = 3;     // diameter, per cent of the filter's side

QString strokeLabel() { return pqImageWidget::tr("Paint Color Filter"); }

} // namespace

pqImageWidget::pqImageWidget(vtkSMProxy* smProxy, vtkSMProperty* smProperty, QWidget* parentObject)
  : pqPropertyWidget(smProxy, parentObject)
{
  this->setProperty(smProperty);
  vtkPVXMLElement* hints = smProperty->GetHints();
  vtkPVXMLElement* hint = hints ? hints->FindNestedElementByName("SchlierenImage") : nullptr;
  const bool isFilter = hint && QString(hint->GetAttribute("plane")) == "deflection";

  this->View = new pqImageView(isFilter, this);
  this->View->setObjectName("Preview");
  this->Note = new QLabel(this);
  this->Note->setObjectName("Note");
  this->Note->setTextFormat(Qt::PlainText);
  this->Note->setWordWrap(true);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(this->View);
  column->addWidget(this->Note);
  auto* grid = new QGridLayout;
  column->addLayout(grid);

  QAbstractButton* load = this->newButton("Load", tr("&Load..."),
    tr("Reads a PNG, or any image, into this property: state files keep it. At most %1 pixels "
       "along a side; larger ones are scaled down.")
      .arg(pqColorFilterImage::largestSide));
  this->Clear = this->newButton("Clear", tr("&Clear"), tr("Takes the image out."));
  grid->addWidget(load, 0, 0);
  grid->addWidget(this->Clear, 0, 2);
  if (isFilter)
  {
    this->setShowLabel(false); // the filter fills a narrow panel
    this->addPainting(grid);
  }

  QObject::connect(load, &QAbstractButton::clicked, this, &pqImageWidget::load);
  QObject::connect(this->Clear, &QAbstractButton::clicked, this, &pqImageWidget::clear);
  this->showImage();
  this->addPropertyLink(this, "image", SIGNAL(imageChanged()), smProperty);
}

pqImageWidget::~pqImageWidget() = default;

QAbstractButton* pqImageWidget::newButton(const char* name, const QString& text, const QString& tip)
{
  auto* button = new QPushButton(text, this);
  button->setObjectName(name);
  button->setToolTip(tip);
  button->setMinimumWidth(1); // else three buttons are wider than the panel
  return button;
}

void pqImageWidget::addPainting(QGridLayout* grid)
{
  this->Save = this->newButton("Save", tr("&Save..."), tr("Writes the filter to a PNG file."));
  auto* brush = new pqColorChooserButton(this);
  brush->setObjectName("Brush");
  brush->setToolTip(tr("The colour to paint with on the filter"));
  brush->setAccessibleName(brush->toolTip());
  brush->setChosenColor(this->Brush.Color);
  auto* size = new QSpinBox(this);
  size->setObjectName("BrushSize");
  size->setRange(1, 100);
  size->setSuffix(tr(" %"));
  size->setToolTip(tr("The brush's diameter, of the filter's side"));
  size->setAccessibleName(size->toolTip());
  size->setMinimumWidth(1);
  QAbstractButton* erase = this->newButton("Erase", tr("&Erase"),
    tr("Brushes away what has been painted: the image that was loaded, or the wheel, comes "
       "back."));
  erase->setCheckable(true);
  this->Light = this->newButton(
    "Light", tr("L&ight"), tr("Shows where on the filter light is: the rest is greyed."));
  this->Light->setCheckable(true);
  this->Light->setChecked(true);
  this->OnImage = this->newButton("PaintOnImage", tr("&Paint on Image"),
    tr("While this is on, the left mouse button paints on the schlieren image: where the rays "
       "of the brushed pixels meet the filter, it gets the brush's colour, or is erased. Escape "
       "ends it."));
  this->OnImage->setCheckable(true);

  grid->addWidget(this->Save, 0, 1);
  grid->addWidget(brush, 1, 0);
  grid->addWidget(size, 1, 1);
  grid->addWidget(erase, 1, 2);
  grid->addWidget(this->OnImage, 2, 0, 1, 2);
  grid->addWidget(this->Light, 2, 2);

  this->Painter = new pqImagePainter(this->proxy(), this);
  const auto setBrushSize = [this](int percent)
  {
    this->Brush.Radius = percent / 200.;
    this->View->setBrushRadius(this->Brush.Radius);
    this->Painter->setBrushRadius(this->Brush.Radius);
  };
  QObject::connect(size, QOverload<int>::of(&QSpinBox::valueChanged), this, setBrushSize);
  size->setValue(usualBrush);
  QObject::connect(brush, &pqColorChooserButton::chosenColorChanged, this,
    [this](const QColor& color) { this->Brush.Color = color; });
  QObject::connect(
    erase, &QAbstractButton::toggled, this, [this](bool on) { this->Brush.Erases = on; });
  QObject::connect(this->Save, &QAbstractButton::clicked, this, &pqImageWidget::save);

  this->followStrokes();
  this->Fetcher = new pqCutoffLightFetcher(this->proxy(), this);
  QObject::connect(
    this->Fetcher, &pqCutoffLightFetcher::lightChanged, this, &pqImageWidget::showLight);
  QObject::connect(
    this->Fetcher, &pqCutoffLightFetcher::imageChanged, this, &pqImageWidget::showLight);
  QObject::connect(this->Light, &QAbstractButton::toggled, this, &pqImageWidget::showLight);
}

void pqImageWidget::followStrokes()
{
  this->Pause.setSingleShot(true);
  this->Pause.setInterval(pauseOfStroke);
  QObject::connect(&this->Pause, &QTimer::timeout, this, &pqImageWidget::showStroke);
  QObject::connect(this->View, &pqImageView::strokeBegan, this, &pqImageWidget::beginStroke);
  QObject::connect(this->View, &pqImageView::brushed, this, &pqImageWidget::brush);
  QObject::connect(this->View, &pqImageView::strokeEnded, this, &pqImageWidget::endStroke);
  QObject::connect(this->Painter, &pqImagePainter::strokeBegan, this, &pqImageWidget::beginStroke);
  QObject::connect(this->Painter, &pqImagePainter::brushed, this, &pqImageWidget::brush);
  QObject::connect(this->Painter, &pqImagePainter::strokeEnded, this, &pqImageWidget::endStroke);
  QObject::connect(
    this->Painter, &pqImagePainter::stopped, this, [this]() { this->OnImage->setChecked(false); });
  QObject::connect(this->OnImage, &QAbstractButton::toggled, this, &pqImageWidget::paintOnImage);
}

void pqImageWidget::setImage(const QString& image)
{
  if (this->Image != image)
  {
    this->Image = image;
    this->showImage();
    Q_EMIT this->imageChanged();
  }
}

void pqImageWidget::showImage()
{
  const bool isEmpty = this->Image.isEmpty();
  const QImage image = this->IsPainting ? this->Canvas : pqColorFilterImage::decoded(this->Image);
  this->View->setImage(image);
  this->Clear->setEnabled(!isEmpty);
  const bool isKnown = isEmpty || !image.isNull();
  if (this->View->isColorFilter())
  {
    this->View->setEnabled(isKnown);
    this->Save->setEnabled(isKnown);
  }
  if (isEmpty)
  {
    this->Note->setText(this->View->isColorFilter() ? tr("the colour wheel") : tr("no image"));
    return;
  }
  const bool isName = !this->Image.startsWith("data:");
  const QString name = isName ? this->Image : image.text(nameKey);
  QString size = tr("%1 x %2 pixels").arg(image.width()).arg(image.height());
  if (!isKnown)
  {
    size = isName ? tr("a file on the server; load it to see it here and to paint on it")
                  : tr("no image that can be read");
  }
  this->Note->setText(name.isEmpty() ? size : tr("%1: %2").arg(name, size));
}

void pqImageWidget::showLight()
{
  this->proxy()->UpdatePropertyInformation(this->proxy()->GetProperty("KScaleUsed"));
  const double k = vtkSMPropertyHelper(this->proxy(), "KScaleUsed").GetAsDouble();
  this->View->setLight(this->Light->isChecked() ? this->Fetcher->light() : pqCutoffLight(), k);
}

void pqImageWidget::beginStroke()
{
  const QImage before = pqColorFilterImage::decoded(this->Image);
  if (this->IsPainting || (before.isNull() && !this->Image.isEmpty()))
  {
    return;
  }
  QString underneath = before.text(underneathKey);
  this->Canvas = pqColorFilterImage::paintable(before);
  if (underneath.isEmpty())
  {
    underneath = this->Image.isEmpty() ? wheelName : pqColorFilterImage::encoded(this->Canvas);
  }
  this->Underneath = underneath == wheelName
    ? pqColorFilterImage::paintable(QImage())
    : pqColorFilterImage::decoded(underneath).convertToFormat(QImage::Format_RGB32);
  this->Canvas.setText(nameKey, tr("painted"));
  this->Canvas.setText(underneathKey, underneath);
  this->IsPainting = this->IsNewStroke = true;
  this->Fetcher->setWaiting(true);
  if (pqLiveEdit::isPossible(this->proxy()))
  {
    this->Edit = std::make_unique<pqLiveEdit>(this->proxy(), strokeLabel());
  }
}

void pqImageWidget::brush(const QVector<QPointF>& places)
{
  if (this->IsPainting)
  {
    // A stroke that begins beside the middle leaves the background, all of which is there, as it is.
    if (std::exchange(this->IsNewStroke, false))
    {
      const QPointF& first = places.first();
      this->Brush.Spares = std::hypot(first.x(), first.y()) > pqColorFilterImage::undeflected;
    }
    pqColorFilterImage::paint(this->Canvas, this->Underneath, this->Brush, places);
    this->View->setImage(this->Canvas);
    if (!this->Pause.isActive())
    {
      this->Pause.start();
    }
  }
}

void pqImageWidget::showStroke()
{
  const QString image = pqColorFilterImage::encoded(this->Canvas);
  if (this->Edit)
  {
    const QString name = this->proxy()->GetPropertyName(this->property());
    this->Edit->show({ { name, image } });
  }
  else
  {
    this->setImage(image);
  }
}

void pqImageWidget::endStroke()
{
  if (!this->IsPainting)
  {
    return;
  }
  if (this->Pause.isActive())
  {
    this->Pause.stop();
    this->showStroke();
  }
  if (this->Edit)
  {
    this->Edit->finish();
    this->Edit.reset();
  }
  this->IsPainting = false;
  this->Fetcher->setWaiting(false);
  this->showImage();
}

void pqImageWidget::paintOnImage(bool on)
{
  if (!on)
  {
    this->Painter->stop();
    return;
  }
  if (vtkSMPropertyHelper(this->proxy(), "Cutoff").GetAsInt() != vtkSchlierenFilter::COLOR_FILTER ||
    !this->Painter->start())
  {
    this->OnImage->setChecked(false);
    this->Note->setText(tr("No view shows an image made with the colour filter. Press Apply, and "
                           "show it in a render view."));
  }
}

void pqImageWidget::hideEvent(QHideEvent* event)
{
  if (this->Painter)
  {
    this->Painter->stop();
  }
  this->pqPropertyWidget::hideEvent(event);
}

void pqImageWidget::load()
{
  pqFileDialog dialog(nullptr, pqCoreUtilities::mainWidget(), tr("Load Image"), QString(),
    tr("Images (*.png *.jpg *.jpeg *.bmp *.ppm);;All files (*)"), false);
  dialog.setObjectName("LoadImageDialog");
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
    this->Note->setText(tr("Cannot read '%1': %2. The image is the one from before.")
                          .arg(file, reader.errorString()));
    return;
  }
  QImage image = pqColorFilterImage::opaque(read);
  image.setText(nameKey, QFileInfo(file).fileName());
  this->setImage(pqColorFilterImage::encoded(image));
}

void pqImageWidget::save()
{
  pqFileDialog dialog(nullptr, pqCoreUtilities::mainWidget(), tr("Save Image"), QString(),
    tr("PNG files (*.png)"), false);
  dialog.setObjectName("SaveImageDialog");
  dialog.setFileMode(pqFileDialog::AnyFile);
  if (dialog.exec() != QDialog::Accepted || dialog.getSelectedFiles().isEmpty())
  {
    return;
  }
  const QImage image = pqColorFilterImage::decoded(this->Image);
  QImageWriter writer(dialog.getSelectedFiles().first(), "PNG");
  if (!writer.write(
        pqColorFilterImage::opaque(image.isNull() ? pqColorFilterImage::paintable(image) : image)))
  {
    this->Note->setText(tr("Cannot write '%1': %2. Choose another folder or name.")
                          .arg(writer.fileName(), writer.errorString()));
  }
}

void pqImageWidget::clear() { this->setImage(QString("")); } // a null string would not be sent
