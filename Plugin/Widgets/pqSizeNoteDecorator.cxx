// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqSizeNoteDecorator.h"

#include "UnitPrefix.h"
#include "WidgetRows.h"
#include "pqPropertyWidget.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

#include <QLabel>
#include <QStringList>

#include <algorithm>
#include <array>
#include <cmath>

namespace
{

/// Returns the edges of the box around a filter's input, in data units; 0 if there is none.
std::array<double, 3> sizeOfInput(vtkSMProxy* filter)
{
  const vtkSMPropertyHelper input(filter, "Input", true);
  std::array<double, 3> size{};
  auto* source =
    input.GetNumberOfElements() > 0 ? vtkSMSourceProxy::SafeDownCast(input.GetAsProxy()) : nullptr;
  if (source)
  {
    double bounds[6];
    source->GetDataInformation(input.GetOutputPort())->GetBounds(bounds);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      size[axis] = std::max(0., bounds[2 * axis + 1] - bounds[2 * axis]);
    }
  }
  return size;
}

/// Returns lengths in the unit that suits the largest, such as "40 × 10 mm", without zeros.
QString lengthsInWords(const std::array<double, 3>& metres)
{
  const UnitPrefix prefix = unitPrefixOf(*std::max_element(metres.begin(), metres.end()));
  QStringList lengths;
  for (const double length : metres)
  {
    if (length > 0)
    {
      lengths << QString::number(length / prefix.factor, 'g', 3);
    }
  }
  return lengths.join(" × ") + " " + QString::fromUtf8(prefix.name) + "m";
}

} // namespace

//------------------------------------------------------------------------------
pqSizeNoteDecorator::pqSizeNoteDecorator(vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqPropertyWidgetDecorator(element, parentObject)
  , Note(new QLabel(parentObject))
{
  this->Note->setObjectName("Note");
  this->Note->setTextFormat(Qt::PlainText);
  this->Note->setWordWrap(true);
  appendBelow(parentObject, this->Note);
  for (const unsigned long event :
    { vtkCommand::ModifiedEvent, vtkCommand::UncheckedPropertyModifiedEvent })
  {
    this->Connection->Connect(parentObject->property(), event, this, SLOT(showNote()));
  }
  this->showNote();
}

//------------------------------------------------------------------------------
pqSizeNoteDecorator::~pqSizeNoteDecorator() = default;

//------------------------------------------------------------------------------
void pqSizeNoteDecorator::showNote()
{
  const double scale = vtkSMUncheckedPropertyHelper(this->parentWidget()->property()).GetAsDouble();
  std::array<double, 3> size = sizeOfInput(this->parentWidget()->proxy());
  std::transform(size.begin(), size.end(), size.begin(), [=](double x) { return x * scale; });
  const bool isKnown = std::any_of(size.begin(), size.end(), [](double x) { return x > 0; }) &&
    std::all_of(size.begin(), size.end(), [](double x) { return std::isfinite(x); });
  this->Note->setText(isKnown ? tr("The data are %1.").arg(lengthsInWords(size)) : QString());
}
