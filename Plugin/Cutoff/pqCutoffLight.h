// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QPointF>

#include <vector>

class vtkImageData;

/// The histogram of the light on the cutoff plane, as brightnesses to be shown.
class pqCutoffLight
{
public:
  /// No light.
  pqCutoffLight() = default;

  /// Of the filter's second output, which may be null or empty.
  explicit pqCutoffLight(vtkImageData* histogram);

  bool isEmpty() const { return this->Bins.empty(); }

  /// From 0, no ray, to 1, where there are most; logarithmic.
  double brightnessAt(const QPointF& deflection) const;

  /// Nearly all rays are bent by less than this along u and along v, radians. 0 where there is no light.
  double extent() const { return this->Extent; }

private:
  int Size = 0; ///< along both axes
  double BinWidth = 0;
  double Extent = 0;
  std::vector<float> Bins; ///< brightness, row by row, the lowest first
};
