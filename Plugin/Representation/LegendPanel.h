// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkContextItem.h"
#include "vtkImageData.h"
#include "vtkNew.h"

#include <cstddef>
#include <string>
#include <vector>

class vtkContext2D;

/// Draws the panel of a vtkSchlierenLegend.
class LegendPanel : public vtkContextItem
{
public:
  static LegendPanel* New();
  vtkTypeMacro(LegendPanel, vtkContextItem);

  bool Paint(vtkContext2D* painter) override;

  int Corner = 1;            ///< of vtkSchlierenLegend::Corners
  double MetresPerPixel = 0; // of the view; 0: unknown
  int PixelsPerPoint = 1;    // more in a screenshot that is larger than its view

  std::string Title, Label, Unit;
  std::vector<std::string> Notes;
  double Range[2] = { 0, 0 };
  int Size[2] = { 0, 0 };
  double Angle = 0;
  bool HasAngle = false;
  bool IsDarkFirst = false; ///< whether the light of the first value is less than that of the last
  double MetresPerUnit = 0; // of the data's lengths
  vtkNew<vtkImageData> Colors;

private:
  struct Pencil;

  /// What a view has room for.
  struct Layout
  {
    float Font = 0;              ///< its height, pixels
    float Width = 0, Height = 0; ///< of the panel, in heights of the font
    float Side = 0;              ///< the scale's height, likewise
    std::size_t Notes = 0;       ///< the first ones
    bool HasRuler = false;
  };

  /// Finds a smaller font and, if that does not suffice, a smaller plane, fewer notes and no ruler, so that the panel does
  /// not cover too much.
  /// Returns false if it would in any case.
  bool Fit(vtkContext2D* painter, Layout& layout);
  float WidthOf(const Layout& layout, vtkContext2D* painter) const;
  float HeightOf(const Layout& layout) const;
  float HeightOfHead() const;

  bool HasScale() const { return this->Size[0] > 0; }
  bool HasPlane() const { return this->Size[1] > 1; }
  bool HasIcon() const { return this->HasScale() && !this->HasPlane() && this->Unit == "rad"; }
  std::string GetLabelWithUnit() const;
  std::string TextAt(double value) const;
  void DrawHead(const Pencil& pencil, float bottom) const;
  void DrawScale(const Pencil& pencil, float bottom, float side) const;
  void DrawIcon(const Pencil& pencil, float left, float bottom) const;
  void DrawStop(const Pencil& pencil, float x, float y, float radius) const;
  void DrawTicks(const Pencil& pencil, float bottom) const;
  void DrawRuler(const Pencil& pencil, float bottom) const;
  void UseText(vtkContext2D* painter, int justification, bool isBold = false) const;
  /// Measures the font, whose size in pixels depends on the screen, and of screenshots on how they are made.
  static float HeightOfFont(vtkContext2D* painter);

  int Points = 10; // of the font in use

  LegendPanel() = default;
  ~LegendPanel() override = default;
  LegendPanel(const LegendPanel&) = delete;
  void operator=(const LegendPanel&) = delete;
};
