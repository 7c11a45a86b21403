// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QPointF>

#include <vector>

class vtkImageData;

/// Brightnesses of the histogram of the light on the cutoff plane.
class pqCutoffLight
{
public:
  pqCutoffLight() = default;

  /// Reads the filter's second output, which may be null or empty.
  explicit pqCutoffLight(vtkImageData* histogram);

  bool isEmpty() const { return this->Bins.empty(); }

  /// Returns 0 for no ray to 1 for the most rays, on a logarithmic scale.
  double brightnessAt(const QPointF& deflection) const;

  /// Returns the deflection along u and v that nearly all rays are below, radians. 0 without light.
  double extent() const { return this->Extent; }

private:
  int Size = 0; ///< along both axes
  double BinWidth = 0;
  double Extent = 0;
  std::vector<float> Bins; ///< brightness, row by row from the lowest
};
