// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What one click mends of an image, or of a flow that has none yet.
#pragma once

#include <QMap>
#include <QString>
#include <QVariant>
#include <QVector>

class vtkSMProxy;

struct Remedy
{
  QString text;                   ///< of the button
  QMap<QString, QVariant> values; ///< properties of the filter
};

/// Returns what helps a filter, or one inside of a representation, whose messages name what is missing:
/// a pressure or a temperature, water for a liquid, a revolution for a plane beside an axis. Mostly empty.
QVector<Remedy> remediesFor(vtkSMProxy* filter);
