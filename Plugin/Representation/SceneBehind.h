// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a view shows behind a flow.
#pragma once

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <vector>

class vtkCamera;
class vtkProp;
class vtkRenderer;

/// What a renderer would draw without flows drawn as Schlieren, and where.
class SceneBehind
{
public:
  explicit SceneBehind(vtkRenderer* renderer);

  /// Draws what is behind a depth (distance from the camera along its direction), with the renderer's background, as a
  /// camera of the renderer, whose clipping range this changes, sees it in so many pixels: RGB bytes. Only while the
  /// renderer draws. Null where OpenGL cannot.
  vtkSmartPointer<vtkImageData> Draw(vtkCamera* camera, const int size[2], double depth) const;

  /// How far behind a depth the middle of it all is; negative where there is nothing.
  double GetDistance(double depth) const;

private:
  vtkRenderer* Renderer;
  std::vector<vtkProp*> Props;
};

/// The largest depth of a box from a camera.
double backOf(const double bounds[6], vtkCamera* camera);
