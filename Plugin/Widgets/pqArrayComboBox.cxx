// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqArrayComboBox.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkSMArrayListDomain.h"
#include "vtkSMProperty.h"

#include <QSignalBlocker>

namespace
{

vtkSMArrayListDomain* domainOf(vtkSMProperty* offering)
{
  return offering ? offering->FindDomain<vtkSMArrayListDomain>() : nullptr;
}

/// Lists each name once, although points and cells may both have it.
QStringList namesOf(vtkSMArrayListDomain* domain)
{
  QStringList names;
  for (unsigned int i = 0; domain && i < domain->GetNumberOfStrings(); ++i)
  {
    names << QString::fromUtf8(domain->GetString(i));
  }
  names.removeDuplicates();
  return names;
}

} // namespace

//------------------------------------------------------------------------------
pqArrayComboBox::pqArrayComboBox(vtkSMProperty* offering, QWidget* parentObject)
  : QComboBox(parentObject)
  , Domain(domainOf(offering))
{
  // Keeps long names from widening the panel.
  this->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  this->setMinimumContentsLength(4);
  if (this->Domain)
  {
    this->Connection->Connect(this->Domain, vtkCommand::DomainModifiedEvent, this, SLOT(fill()));
  }
  this->fill();
}

//------------------------------------------------------------------------------
pqArrayComboBox::~pqArrayComboBox() = default;

//------------------------------------------------------------------------------
void pqArrayComboBox::setArray(const QString& name)
{
  const QSignalBlocker blocker(this);
  if (this->findText(name) < 0)
  {
    this->addItem(name);
  }
  this->setCurrentIndex(this->findText(name));
  this->setToolTip(name);
}

//------------------------------------------------------------------------------
void pqArrayComboBox::fill()
{
  const QString chosen = this->currentText();
  const QSignalBlocker blocker(this);
  this->clear();
  this->addItems(namesOf(this->Domain));
  this->setArray(chosen);
}

//------------------------------------------------------------------------------
QString pqArrayComboBox::firstBut(const QStringList& taken, vtkSMProperty* offering)
{
  for (const QString& name : namesOf(domainOf(offering)))
  {
    if (!taken.contains(name))
    {
      return name;
    }
  }
  return QString();
}
