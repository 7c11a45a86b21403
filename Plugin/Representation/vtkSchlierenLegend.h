// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSchlierenLegend
 * @brief   what an image of vtkSchlierenFilter shows, drawn in a corner of a view
 *
 * Draws the name of the technique, the stop with the side that it covers, the light over the
 * deflection, path or intensity that it stands for, notes such as k, and a ruler. All of this comes
 * from the field data of the image. A panel behind it makes it legible on any image. Nothing is
 * drawn in views that it would cover most of.
 */
#ifndef vtkSchlierenLegend_h
#define vtkSchlierenLegend_h

#include "vtkOpenGLContextActor.h"
#include "vtkSmartPointer.h"

class LegendPanel;
class vtkImageData;
class vtkScalarsToColors;

class vtkSchlierenLegend : public vtkOpenGLContextActor
{
public:
  static vtkSchlierenLegend* New();
  vtkTypeMacro(vtkSchlierenLegend, vtkOpenGLContextActor);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Corners
  {
    LOWER_LEFT,
    LOWER_RIGHT,
    UPPER_LEFT,
    UPPER_RIGHT
  };

  /// How a view draws an image: its light, by a map of colours (null: as it is), or another of its arrays.
  struct Painting
  {
    bool IsLight = true;
    vtkScalarsToColors* Map = nullptr;
  };

  /// Copies what is shown from the field data of an image; null: nothing is. The scale has the colours of the painting,
  /// and is left out where another array is drawn.
  void SetImage(vtkImageData* image) { this->SetImage(image, Painting{}); }
  void SetImage(vtkImageData* image, const Painting& painting);

  /// Sets the corner, one of Corners (default: LOWER_RIGHT).
  void SetCorner(int corner);

  /// Copies the arrays of an image's field data that a legend needs.
  static void CopyFieldData(vtkImageData* from, vtkImageData* to);

  int RenderOverlay(vtkViewport* viewport) override;

protected:
  vtkSchlierenLegend();
  ~vtkSchlierenLegend() override;

private:
  vtkSchlierenLegend(const vtkSchlierenLegend&) = delete;
  void operator=(const vtkSchlierenLegend&) = delete;

  vtkSmartPointer<LegendPanel> Shown;
};

#endif
