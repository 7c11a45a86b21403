// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "LegendPanel.h"

#include "NumberText.h"
#include "vtkSchlierenLegend.h"

#include "vtkBrush.h"
#include "vtkContext2D.h"
#include "vtkContextScene.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPen.h"
#include "vtkRect.h"
#include "vtkTextProperty.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace
{

// Lengths in heights of the font.
constexpr float lineHeight = 1.4f;
constexpr float padding = 0.6f;
constexpr float widthOfScale = 15;
constexpr float heightOfScale = 1.1f;
constexpr float sideOfPlane = 7, sideOfSmallPlane = 4;
constexpr float belowScale = 0.3f;
constexpr float sizeOfIcon = 2.4f;
constexpr float shareOfSource = 0.7f; // of the icon: the image of the light source
constexpr float heightOfRuler = 0.5f;

constexpr int opacityOfPanel = 235;

// Fractions of a view's sides and area that the panel may cover.
constexpr float largestSide = 0.6f;
constexpr float largestArea = 0.12f, largestOfLeast = 0.25f; // with all texts, with the least
constexpr int largestFont = 10;                              // points
constexpr int smallestFont = 8;                              // pixels, that are still legible

/// Returns the largest of 1, 2 and 5 times a power of ten that is not above a length.
double roundLength(double length)
{
  const double power = std::pow(10, std::floor(std::log10(length)));
  const double digits = length / power;
  return power * (digits >= 5 ? 5 : digits >= 2 ? 2 : 1);
}

} // namespace

/// Draws with places in heights of the font from the panel's lower left corner.
struct LegendPanel::Pencil
{
  vtkContext2D* To;
  float Left, Bottom, Height;

  float x(float place) const { return this->Left + place * this->Height; }
  float y(float place) const { return this->Bottom + place * this->Height; }
  void Text(float left, float bottom, const std::string& text) const
  {
    this->To->DrawString(this->x(left), this->y(bottom), text.c_str());
  }
};

vtkStandardNewMacro(LegendPanel);

float LegendPanel::HeightOfHead() const { return this->HasIcon() ? 2 * lineHeight : lineHeight; }

std::string LegendPanel::GetLabelWithUnit() const
{
  const double most = std::max(std::abs(this->Range[0]), std::abs(this->Range[1]));
  return this->Unit.empty() ? this->Label
                            : this->Label + ", " + unitPrefixOf(most).name + this->Unit;
}

std::string LegendPanel::TextAt(double value) const
{
  const double most = std::max(std::abs(this->Range[0]), std::abs(this->Range[1]));
  return filters::textOf(this->Unit.empty() ? value : value / unitPrefixOf(most).factor, 3);
}

void LegendPanel::UseText(vtkContext2D* painter, int justification, bool isBold) const
{
  vtkNew<vtkTextProperty> text;
  text->SetFontFamilyToArial();
  text->SetFontSize(this->Points);
  text->SetBold(isBold);
  text->SetColor(1, 1, 1);
  text->SetJustification(justification);
  text->SetVerticalJustificationToBottom();
  painter->ApplyTextProp(text);
}

float LegendPanel::HeightOfFont(vtkContext2D* painter)
{
  constexpr float bySize = 0.92f; // of a capital with a descender
  float bounds[4];
  painter->ComputeStringBounds("Ag", bounds);
  return std::max(1.f, bounds[3] / bySize);
}

// Draws the image of the light source, and what the stop covers of it.
void LegendPanel::DrawIcon(const Pencil& pencil, float left, float bottom) const
{
  const float radius = 0.5f * sizeOfIcon * pencil.Height;
  const float x = pencil.x(left) + radius, y = pencil.y(bottom) + radius;
  vtkContext2D* to = pencil.To;
  to->GetPen()->SetLineType(vtkPen::NO_PEN);
  to->GetBrush()->SetColor(255, 255, 255, 255);
  to->DrawEllipticArc(x, y, shareOfSource * radius, shareOfSource * radius, 0, 360);
  to->GetBrush()->SetColor(110, 110, 110, 255);
  if (!this->HasAngle)
  {
    this->DrawStop(pencil, x, y, shareOfSource * radius);
    return;
  }
  // The knife covers the side that dark light has moved to.
  const double extent = this->Range[1] - this->Range[0];
  const double middle = extent > 0 ? 0.5 * (this->Range[0] + this->Range[1]) / extent : 0;
  const double edge = std::clamp(2 * middle * shareOfSource, -1., 1.) * radius;
  const double angle = vtkMath::RadiansFromDegrees(this->Angle);
  const double normal[2] = { std::cos(angle), std::sin(angle) };
  const double back = (this->IsDarkFirst ? -1 : 1) * radius;
  float corners[8];
  const double places[4][2] = { { edge, -radius }, { edge, radius }, { back, radius },
    { back, -radius } };
  for (int i = 0; i < 4; ++i)
  {
    corners[2 * i] = static_cast<float>(x + places[i][0] * normal[0] - places[i][1] * normal[1]);
    corners[2 * i + 1] =
      static_cast<float>(y + places[i][0] * normal[1] + places[i][1] * normal[0]);
  }
  to->DrawPolygon(corners, 4);
}

// A stop in the middle covers the light that nothing bends, an iris what is bent.
void LegendPanel::DrawStop(const Pencil& pencil, float x, float y, float radius) const
{
  constexpr float small = 0.5f;
  if (this->IsDarkFirst)
  {
    pencil.To->DrawEllipticArc(x, y, small * radius, small * radius, 0, 360);
  }
  else
  {
    const float outer = radius / shareOfSource;
    pencil.To->DrawEllipseWedge(x, y, outer, outer, small * radius, small * radius, 0, 360);
  }
}

void LegendPanel::DrawTicks(const Pencil& pencil, float bottom) const
{
  const bool hasZero = this->Range[0] < 0 && this->Range[1] > 0;
  const double middle = hasZero ? 0 : 0.5 * (this->Range[0] + this->Range[1]);
  const double extent = this->Range[1] - this->Range[0];
  const auto place = static_cast<float>((middle - this->Range[0]) / extent * widthOfScale);
  this->UseText(pencil.To, VTK_TEXT_LEFT);
  pencil.Text(0, bottom, this->TextAt(this->Range[0]));
  this->UseText(pencil.To, VTK_TEXT_RIGHT);
  pencil.Text(widthOfScale, bottom, this->TextAt(this->Range[1]));
  constexpr float room = 4; // for the texts at the ends
  if (place > room && place < widthOfScale - room)
  {
    this->UseText(pencil.To, VTK_TEXT_CENTERED);
    pencil.Text(place, bottom, this->TextAt(middle));
  }
}

void LegendPanel::DrawRuler(const Pencil& pencil, float bottom) const
{
  const double most = this->MetresPerPixel * widthOfScale * pencil.Height;
  constexpr double leastShare = 1e-30;
  if (!(most > leastShare) || !std::isfinite(most))
  {
    return;
  }
  constexpr double share = 0.6; // the text is beside it
  const double length = roundLength(share * most);
  const auto width = static_cast<float>(length / this->MetresPerPixel);
  vtkContext2D* to = pencil.To;
  to->GetPen()->SetLineType(vtkPen::NO_PEN);
  to->GetBrush()->SetColor(255, 255, 255, 255);
  const float thin = std::max(1.f, 0.15f * pencil.Height);
  const float y = pencil.y(bottom + 0.3f);
  to->DrawRect(pencil.x(0), y, width, thin);
  to->DrawRect(pencil.x(0), y, thin, heightOfRuler * pencil.Height);
  to->DrawRect(pencil.x(0) + width - thin, y, thin, heightOfRuler * pencil.Height);
  this->UseText(to, VTK_TEXT_LEFT);
  pencil.Text(width / pencil.Height + padding, bottom, filters::lengthInWords(length, 3));
}

float LegendPanel::HeightOf(const Layout& layout) const
{
  const float lines = static_cast<float>(layout.Notes) + (this->Label.empty() ? 0 : 1) +
    (this->HasScale() ? 1 : 0) + (layout.HasRuler ? 1 : 0);
  return this->HeightOfHead() + lineHeight * lines +
    (this->HasScale() ? layout.Side + belowScale : 0) + 2 * padding;
}

float LegendPanel::WidthOf(const Layout& layout, vtkContext2D* painter) const
{
  float width = widthOfScale;
  const auto widen = [&](const std::string& text, float indent = 0)
  {
    float bounds[4];
    painter->ComputeStringBounds(text.c_str(), bounds);
    width = std::max(width, indent + bounds[2] / layout.Font);
  };
  this->UseText(painter, VTK_TEXT_LEFT, true);
  widen(this->Title, this->HasIcon() ? sizeOfIcon + padding : 0);
  this->UseText(painter, VTK_TEXT_LEFT);
  widen(this->GetLabelWithUnit());
  for (std::size_t i = 0; i < layout.Notes; ++i)
  {
    widen(this->Notes[i]);
  }
  return width + 2 * padding;
}

bool LegendPanel::Fit(vtkContext2D* painter, Layout& layout)
{
  const auto room = static_cast<float>(this->GetScene()->GetSceneWidth());
  const auto rise = static_cast<float>(this->GetScene()->GetSceneHeight());
  const int smallest =
    std::min(largestFont, (smallestFont + this->PixelsPerPoint - 1) / this->PixelsPerPoint);
  layout.Notes = this->Notes.size();
  layout.HasRuler = this->MetresPerPixel > 0;
  layout.Side = this->HasPlane() ? sideOfPlane : heightOfScale;
  while (true)
  {
    const bool isLeast = layout.Notes == 0 && !layout.HasRuler && layout.Side != sideOfPlane;
    const float largest = isLeast ? largestOfLeast : largestArea;
    for (this->Points = largestFont; this->Points >= smallest; --this->Points)
    {
      this->UseText(painter, VTK_TEXT_LEFT);
      layout.Font = this->HeightOfFont(painter);
      layout.Width = this->WidthOf(layout, painter);
      layout.Height = this->HeightOf(layout);
      const float width = layout.Width * layout.Font / room,
                  height = layout.Height * layout.Font / rise;
      if (std::max(width, height) <= largestSide && width * height <= largest)
      {
        return true;
      }
    }
    if (layout.Side == sideOfPlane)
    {
      layout.Side = sideOfSmallPlane;
    }
    else if (layout.Notes > 0)
    {
      --layout.Notes;
    }
    else if (!std::exchange(layout.HasRuler, false))
    {
      return false;
    }
  }
}

bool LegendPanel::Paint(vtkContext2D* painter)
{
  Layout layout;
  if (this->Title.empty() || !this->Fit(painter, layout))
  {
    return true;
  }
  const float font = layout.Font, height = layout.Height;
  const auto room = this->GetScene()->GetSceneWidth(), rise = this->GetScene()->GetSceneHeight();
  const bool isLeft = this->Corner == vtkSchlierenLegend::LOWER_LEFT ||
    this->Corner == vtkSchlierenLegend::UPPER_LEFT;
  const bool isLow = this->Corner == vtkSchlierenLegend::LOWER_LEFT ||
    this->Corner == vtkSchlierenLegend::LOWER_RIGHT;
  const float margin = padding * font;
  const float left = isLeft ? margin : static_cast<float>(room) - margin - layout.Width * font;
  const float bottom = isLow ? margin : static_cast<float>(rise) - margin - height * font;

  painter->GetPen()->SetLineType(vtkPen::NO_PEN);
  painter->GetBrush()->SetColor(0, 0, 0, opacityOfPanel);
  painter->DrawRect(left, bottom, layout.Width * font, height * font);

  const Pencil pencil{ painter, left + padding * font, bottom + padding * font, font };
  float y = height - 2 * padding - this->HeightOfHead();
  this->DrawHead(pencil, y);
  this->UseText(painter, VTK_TEXT_LEFT);
  if (!this->Label.empty())
  {
    y -= lineHeight;
    pencil.Text(0, y, this->GetLabelWithUnit());
  }
  if (this->HasScale())
  {
    y -= layout.Side + belowScale + lineHeight;
    this->DrawScale(pencil, y, layout.Side);
  }
  this->UseText(painter, VTK_TEXT_LEFT);
  for (std::size_t i = 0; i < layout.Notes; ++i)
  {
    y -= lineHeight;
    pencil.Text(0, y, this->Notes[i]);
  }
  if (layout.HasRuler)
  {
    this->DrawRuler(pencil, y - lineHeight);
  }
  return true;
}

void LegendPanel::DrawHead(const Pencil& pencil, float bottom) const
{
  const float height = this->HeightOfHead();
  if (this->HasIcon())
  {
    this->DrawIcon(pencil, 0, bottom + 0.5f * (height - sizeOfIcon));
  }
  this->UseText(pencil.To, VTK_TEXT_LEFT, true);
  pencil.Text(
    this->HasIcon() ? sizeOfIcon + padding : 0, bottom + 0.5f * (height - lineHeight), this->Title);
}

void LegendPanel::DrawScale(const Pencil& pencil, float bottom, float side) const
{
  const float across = this->HasPlane() ? side : widthOfScale;
  // A frame, as one end of the scale may be as dark as the panel.
  pencil.To->GetBrush()->SetColor(128, 128, 128, 255);
  pencil.To->GetPen()->SetLineType(vtkPen::NO_PEN);
  pencil.To->DrawRect(pencil.x(0) - 1, pencil.y(bottom + lineHeight) - 1,
    across * pencil.Height + 2, side * pencil.Height + 2);
  pencil.To->DrawImage(vtkRectf(pencil.x(0), pencil.y(bottom + lineHeight), across * pencil.Height,
                         side * pencil.Height),
    this->Colors);
  if (!this->HasPlane())
  {
    this->DrawTicks(pencil, bottom);
    return;
  }
  this->UseText(pencil.To, VTK_TEXT_LEFT);
  pencil.Text(0, bottom, this->TextAt(this->Range[0]));
  this->UseText(pencil.To, VTK_TEXT_RIGHT);
  pencil.Text(side, bottom, this->TextAt(this->Range[1]));
}
