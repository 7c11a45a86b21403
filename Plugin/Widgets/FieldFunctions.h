// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

#include <QVector>

class vtkSMProxy;
class vtkSMProxyProperty;

/// The transfer functions of fields that a panel edits, in a property once they are applied:
/// ParaView's opacity functions "SchlierenField1", ..., which state files and scripts can restore.
/// Those that it has made and nobody uses are unregistered.
class FieldFunctions
{
public:
  explicit FieldFunctions(vtkSMProxyProperty* property);
  ~FieldFunctions();

  vtkSMProxyProperty* property() const;
  vtkSMProxy* at(int row) const; ///< null: none yet
  void complete(int count);      ///< adds straight lines from 0 to 1
  void remove(int row) { this->Rows.removeAt(row); }

  void read();  ///< from the property
  void write(); ///< to the property; dropUnused() is to follow
  void dropUnused();

private:
  using Functions = QVector<vtkSmartPointer<vtkSMProxy>>;
  Functions used() const;

  vtkSmartPointer<vtkSMProxyProperty> Property;
  Functions Rows;
  Functions Candidates; ///< made here, or used before
};
