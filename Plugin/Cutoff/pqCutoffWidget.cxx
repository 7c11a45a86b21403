// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqCutoffWidget.h"

#include "pqColorFilterImage.h"
#include "pqCutoffLightFetcher.h"
#include "pqCutoffView.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkPiecewiseFunction.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSchlierenFilter.h"

#include <QLabel>
#include <QVBoxLayout>

#include <cmath>

namespace
{

using Filter = vtkSchlierenFilter;

static_assert(int(pqCutoff::KnifeEdge) == Filter::KNIFE_EDGE &&
  int(pqCutoff::BrightField) == Filter::BRIGHT_FIELD &&
  int(pqCutoff::DarkField) == Filter::DARK_FIELD &&
  int(pqCutoff::GradedFilter) == Filter::GRADED_FILTER &&
  int(pqCutoff::ColorFilter) == Filter::COLOR_FILTER &&
  int(pqCutoff::NumericalSchlieren) == Filter::NUMERICAL_SCHLIEREN);

constexpr int digits = 4; // precision of dragging

double valueOf(vtkSMProxy* proxy, const char* property)
{
  return vtkSMPropertyHelper(proxy, property).GetAsDouble();
}

/// Returns the k times deflection over SourceWidth, which of a colour filter's image is from -1 to 1.
double kOfWidth(int cutoff) { return cutoff == Filter::COLOR_FILTER ? 2 : 1; }

vtkPiecewiseFunction* gradedFilterOf(vtkSMProxy* proxy)
{
  vtkSMProxy* function = vtkSMPropertyHelper(proxy, "GradedFilter").GetAsProxy();
  auto* points =
    function ? vtkPiecewiseFunction::SafeDownCast(function->GetClientSideObject()) : nullptr;
  return points && points->GetSize() > 0 ? points : nullptr;
}

/// Returns the cutoff with the filter's current values.
pqCutoff cutoffOf(vtkSMProxy* proxy)
{
  pqCutoff cutoff;
  const int kind = vtkSMPropertyHelper(proxy, "Cutoff").GetAsInt();
  if (!Filter::CutoffHasK(kind))
  {
    return cutoff;
  }
  cutoff.Kind = static_cast<pqCutoff::Kinds>(kind);
  cutoff.HasEdge = Filter::CutoffHasEdge(kind);
  cutoff.Angle = valueOf(proxy, "KnifeEdgeAngle");
  cutoff.IsOfDisc = valueOf(proxy, "SourceShape") == Filter::DISC;
  cutoff.IsSquare = *vtkSMPropertyHelper(proxy, "ColorFilterImage").GetAsString() != '\0';
  const int mode = vtkSMPropertyHelper(proxy, "KMode").GetAsInt();
  if (mode == Filter::K_BENCH)
  {
    const double width = valueOf(proxy, "SourceWidth"); // millimetres
    cutoff.K = kOfWidth(kind) * 1e3 * valueOf(proxy, "MirrorFocalLength") / width;
  }
  else
  {
    cutoff.K = valueOf(proxy, mode == Filter::K_VALUE ? "KScale" : "KScaleUsed");
  }
  cutoff.Offset = valueOf(proxy, "CutoffOffset");
  if (!std::isfinite(cutoff.K) || !std::isfinite(cutoff.Offset))
  {
    cutoff.K = cutoff.Offset = 0; // optics of zero width
  }
  if (vtkPiecewiseFunction* function = gradedFilterOf(proxy))
  {
    const vtkSmartPointer<vtkPiecewiseFunction> kept = function;
    cutoff.Graded = [kept](double place) { return kept->GetValue(place); };
  }
  return cutoff;
}

} // namespace

pqCutoffWidget::pqCutoffWidget(vtkSMProxy* smProxy, vtkSMPropertyGroup*, QWidget* parentObject)
  : pqPropertyWidget(smProxy, parentObject)
  , View(new pqCutoffView(this))
  , Numbers(new QLabel(this))
  , Fetcher(new pqCutoffLightFetcher(smProxy, this))
{
  this->setShowLabel(false);
  this->View->setObjectName("Plane");
  this->Numbers->setObjectName("Numbers");
  this->Numbers->setTextFormat(Qt::PlainText);
  this->Numbers->setWordWrap(true);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(this->View);
  column->addWidget(this->Numbers);

  QObject::connect(this->Fetcher, &pqCutoffLightFetcher::imageChanged, this,
    [this]()
    {
      this->proxy()->UpdatePropertyInformation(this->proxy()->GetProperty("KScaleUsed"));
      this->readCutoff();
    });
  QObject::connect(this->Fetcher, &pqCutoffLightFetcher::lightChanged, this,
    [this]() { this->View->setLight(this->Fetcher->light()); });
  QObject::connect(this->View, &pqCutoffView::grabbed, this, &pqCutoffWidget::grabbed);
  QObject::connect(this->View, &pqCutoffView::dragged, this, &pqCutoffWidget::dragged);
  QObject::connect(this->View, &pqCutoffView::released, this, &pqCutoffWidget::released);
  for (const char* name :
    { "Cutoff", "KnifeEdgeAngle", "CutoffOffset", "KMode", "KScale", "MirrorFocalLength",
      "SourceWidth", "SourceShape", "ColorFilterImage", "GradedFilter", "KScaleUsed" })
  {
    this->Connection->Connect(
      smProxy->GetProperty(name), vtkCommand::ModifiedEvent, this, SLOT(readCutoff()));
  }
  this->readCutoff();
}

pqCutoffWidget::~pqCutoffWidget() = default;

void pqCutoffWidget::readCutoff()
{
  this->View->setEnabled(pqLiveEdit::isPossible(this->proxy()));
  if (!this->View->isGrabbed())
  {
    const pqCutoff cutoff = cutoffOf(this->proxy());
    const bool isImage = cutoff.Kind == pqCutoff::ColorFilter && cutoff.IsSquare;
    this->View->setCutoff(cutoff,
      isImage ? pqColorFilterImage::decoded(
                  vtkSMPropertyHelper(this->proxy(), "ColorFilterImage").GetAsString())
              : QImage());
  }
  this->showNumbers();
}

void pqCutoffWidget::showNumbers()
{
  const pqCutoff& cutoff = this->View->cutoff();
  QStringList numbers;
  if (this->View->isEnabled() && cutoff.Kind != pqCutoff::NoCutoff)
  {
    if (cutoff.HasEdge)
    {
      numbers << tr("offset %1").arg(cutoff.Offset, 0, 'g', 3)
              << QString::fromUtf8("%1°").arg(cutoff.Angle);
    }
    numbers << tr("k = %1").arg(cutoff.K, 0, 'g', digits);
  }
  this->Numbers->setText(numbers.join(", "));
}

void pqCutoffWidget::grabbed()
{
  this->Fetcher->setWaiting(true);
  this->Edit = std::make_unique<pqLiveEdit>(this->proxy(), tr("Drag Cutoff"));
}

QMap<QString, QVariant> pqCutoffWidget::changes() const
{
  const pqCutoff& now = this->View->cutoff();
  const bool fromOptics = vtkSMPropertyHelper(this->proxy(), "KMode").GetAsInt() == Filter::K_BENCH;
  QMap<QString, QVariant> values;
  switch (this->View->handle())
  {
    case pqCutoffPlane::TurnHandle:
      values["KnifeEdgeAngle"] = now.Angle;
      break;
    case pqCutoffPlane::EdgeLine:
      values["CutoffOffset"] = now.Offset;
      break;
    case pqCutoffPlane::DarkLine:
    case pqCutoffPlane::BrightLine:
    case pqCutoffPlane::SizeHandle:
      if (fromOptics)
      {
        values["SourceWidth"] = rounded(
          kOfWidth(now.Kind) * 1e3 * valueOf(this->proxy(), "MirrorFocalLength") / now.K, digits);
      }
      else
      {
        values["KMode"] = Filter::K_VALUE;
        values["KScale"] = now.K;
      }
      break;
    case pqCutoffPlane::NoHandle:
      break;
  }
  return values;
}

void pqCutoffWidget::dragged()
{
  this->Edit->show(this->changes());
  this->showNumbers();
}

void pqCutoffWidget::released(bool keep)
{
  const std::unique_ptr<pqLiveEdit> edit = std::move(this->Edit);
  if (edit)
  {
    keep ? edit->finish() : edit->cancel();
  }
  this->Fetcher->setWaiting(false);
  this->readCutoff();
}
