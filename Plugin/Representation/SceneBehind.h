// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Renders what a view shows behind a flow.
#pragma once

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <vector>

class vtkCamera;
class vtkProp;
class vtkRenderer;

/// Renders a scene without flows drawn as Schlieren.
class SceneBehind
{
public:
  explicit SceneBehind(vtkRenderer* renderer);

  /// Renders what lies behind a depth (distance along the camera's direction), with the renderer's
  /// background: RGB bytes of so many pixels. Changes the camera's clipping range. Only during a
  /// rendering. Null if OpenGL fails.
  vtkSmartPointer<vtkImageData> Draw(vtkCamera* camera, const int size[2], double depth) const;

  /// Returns the distance from a depth to the middle of the scene; negative for an empty one.
  double GetDistance(double depth) const;

private:
  vtkRenderer* Renderer;
  std::vector<vtkProp*> Props;
};

/// Returns the largest depth of a box.
double backOf(const double bounds[6], vtkCamera* camera);
