// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSchlierenLegend.h"

#include "LegendColors.h"
#include "vtkSchlierenActor.h"
#include "vtkSchlierenFilter.h"

#include "vtkBrush.h"
#include "vtkContext2D.h"
#include "vtkContextItem.h"
#include "vtkContextScene.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPen.h"
#include "vtkPointData.h"
#include "vtkRect.h"
#include "vtkRenderer.h"
#include "vtkStringArray.h"
#include "vtkTextProperty.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace
{

constexpr const char* arraysOfLegend[] = { "LegendTitle", "LegendLabel", "LegendRange",
  "LegendSize", "LegendColors", "LegendNotes", "LegendAngle", "LengthScale" };

// Lengths in heights of the font.
constexpr float lineHeight = 1.4f;
constexpr float padding = 0.6f;
constexpr float widthOfScale = 15;
constexpr float heightOfScale = 1.1f;
constexpr float sideOfPlane = 7;
constexpr float sizeOfIcon = 2.4f;
constexpr float shareOfSource = 0.7f; // of the icon: the image of the light source
constexpr float heightOfRuler = 0.5f;

constexpr int opacityOfPanel = 235;
constexpr double largestShareOfView = 0.6; // of its width, and of its height

double numberIn(vtkFieldData* data, const char* name, vtkIdType index, double otherwise)
{
  vtkDataArray* array = data->GetArray(name);
  return array && array->GetNumberOfValues() > index ? array->GetComponent(index, 0) : otherwise;
}

std::vector<std::string> textsIn(vtkFieldData* data, const char* name)
{
  auto* array = vtkStringArray::SafeDownCast(data->GetAbstractArray(name));
  std::vector<std::string> texts;
  for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i)
  {
    texts.push_back(array->GetValue(i));
  }
  return texts;
}

std::string textOf(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// The prefix of a unit in which a value has one to three digits before the point.
struct Prefix
{
  double factor;
  const char* name;
};

Prefix prefixFor(double value)
{
  constexpr Prefix prefixes[] = { { 1, "" }, { 1e3, "m" }, { 1e6, "\xC2\xB5" }, { 1e9, "n" } };
  for (const Prefix& prefix : prefixes)
  {
    if (std::abs(value) * prefix.factor >= 1)
    {
      return prefix;
    }
  }
  return prefixes[3];
}

/// Returns the largest of 1, 2 and 5 times a power of ten that is not above a length.
double roundLength(double length)
{
  const double power = std::pow(10, std::floor(std::log10(length)));
  const double digits = length / power;
  return power * (digits >= 5 ? 5 : digits >= 2 ? 2 : 1);
}

std::string lengthInWords(double metres)
{
  const bool isLong = metres >= 1000;
  const Prefix prefix = isLong ? Prefix{ 1e-3, "k" } : prefixFor(metres);
  return textOf(metres * prefix.factor) + " " + prefix.name + "m";
}

} // namespace

//------------------------------------------------------------------------------
// The item that draws.
class vtkSchlierenLegend::Panel : public vtkContextItem
{
public:
  static Panel* New();
  vtkTypeMacro(Panel, vtkContextItem);

  bool Paint(vtkContext2D* painter) override;

  int Corner = LOWER_RIGHT;
  int FontSize = 10;
  double MetresPerPixel = 0; // of the view; 0: unknown

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
  /// Draws with places in heights of the font from the panel's lower left corner.
  struct Pencil
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

  bool HasScale() const { return this->Size[0] > 0; }
  bool HasPlane() const { return this->Size[1] > 1; }
  bool HasIcon() const { return this->HasScale() && !this->HasPlane() && this->Unit == "rad"; }
  std::string GetLabelWithUnit() const;
  std::string TextAt(double value) const;
  void DrawIcon(const Pencil& pencil, float left, float bottom) const;
  void DrawStop(const Pencil& pencil, float x, float y, float radius) const;
  void DrawTicks(const Pencil& pencil, float bottom) const;
  void DrawRuler(const Pencil& pencil, float bottom) const;
  void UseText(vtkContext2D* painter, int justification, bool isBold = false) const;
  /// Measures the font, whose size in pixels depends on the screen, and of screenshots on how they are made.
  static float HeightOfFont(vtkContext2D* painter);
};

vtkStandardNewMacro(vtkSchlierenLegend::Panel);

//------------------------------------------------------------------------------
std::string vtkSchlierenLegend::Panel::GetLabelWithUnit() const
{
  const double most = std::max(std::abs(this->Range[0]), std::abs(this->Range[1]));
  return this->Unit.empty() ? this->Label : this->Label + ", " + prefixFor(most).name + this->Unit;
}

//------------------------------------------------------------------------------
std::string vtkSchlierenLegend::Panel::TextAt(double value) const
{
  const double most = std::max(std::abs(this->Range[0]), std::abs(this->Range[1]));
  return textOf(this->Unit.empty() ? value : value * prefixFor(most).factor);
}

//------------------------------------------------------------------------------
void vtkSchlierenLegend::Panel::UseText(vtkContext2D* painter, int justification, bool isBold) const
{
  vtkNew<vtkTextProperty> text;
  text->SetFontFamilyToArial();
  text->SetFontSize(this->FontSize);
  text->SetBold(isBold);
  text->SetColor(1, 1, 1);
  text->SetJustification(justification);
  text->SetVerticalJustificationToBottom();
  painter->ApplyTextProp(text);
}

//------------------------------------------------------------------------------
float vtkSchlierenLegend::Panel::HeightOfFont(vtkContext2D* painter)
{
  constexpr float bySize = 0.92f; // of a capital with a descender
  float bounds[4];
  painter->ComputeStringBounds("Ag", bounds);
  return std::max(1.f, bounds[3] / bySize);
}

//------------------------------------------------------------------------------
// Draws the image of the light source, and what the stop covers of it.
void vtkSchlierenLegend::Panel::DrawIcon(const Pencil& pencil, float left, float bottom) const
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

//------------------------------------------------------------------------------
// A stop in the middle covers the light that nothing bends, an iris what is bent.
void vtkSchlierenLegend::Panel::DrawStop(const Pencil& pencil, float x, float y, float radius) const
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

//------------------------------------------------------------------------------
void vtkSchlierenLegend::Panel::DrawTicks(const Pencil& pencil, float bottom) const
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

//------------------------------------------------------------------------------
void vtkSchlierenLegend::Panel::DrawRuler(const Pencil& pencil, float bottom) const
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
  pencil.Text(width / pencil.Height + padding, bottom, lengthInWords(length));
}

//------------------------------------------------------------------------------
bool vtkSchlierenLegend::Panel::Paint(vtkContext2D* painter)
{
  if (this->Title.empty())
  {
    return true;
  }
  const float side = this->HasPlane() ? sideOfPlane : heightOfScale;
  const float heightOfHead = this->HasIcon() ? 2 * lineHeight : lineHeight;
  const float lines = static_cast<float>(this->Notes.size()) + (this->Label.empty() ? 0 : 1) +
    (this->HasScale() ? 1 : 0) + (this->MetresPerPixel > 0 ? 1 : 0);
  const float height =
    heightOfHead + lineHeight * lines + (this->HasScale() ? side + 0.3f : 0) + 2 * padding;

  this->UseText(painter, VTK_TEXT_LEFT);
  const float font = this->HeightOfFont(painter);
  float width = widthOfScale;
  const auto widen = [&](const std::string& text, float indent = 0)
  {
    float bounds[4];
    painter->ComputeStringBounds(text.c_str(), bounds);
    width = std::max(width, indent + bounds[2] / font);
  };
  widen(this->GetLabelWithUnit());
  for (const std::string& note : this->Notes)
  {
    widen(note);
  }
  width += 2 * padding;
  const auto room = this->GetScene()->GetSceneWidth(), rise = this->GetScene()->GetSceneHeight();
  if (width * font > largestShareOfView * room || height * font > largestShareOfView * rise)
  {
    return true;
  }
  const bool isLeft = this->Corner == LOWER_LEFT || this->Corner == UPPER_LEFT;
  const bool isLow = this->Corner == LOWER_LEFT || this->Corner == LOWER_RIGHT;
  const float margin = padding * font;
  const float left = isLeft ? margin : static_cast<float>(room) - margin - width * font;
  const float bottom = isLow ? margin : static_cast<float>(rise) - margin - height * font;

  painter->GetPen()->SetLineType(vtkPen::NO_PEN);
  painter->GetBrush()->SetColor(0, 0, 0, opacityOfPanel);
  painter->DrawRect(left, bottom, width * font, height * font);

  const Pencil pencil{ painter, left + padding * font, bottom + padding * font, font };
  float y = height - 2 * padding - heightOfHead;
  const float indent = this->HasIcon() ? sizeOfIcon + padding : 0;
  if (this->HasIcon())
  {
    this->DrawIcon(pencil, 0, y + 0.5f * (heightOfHead - sizeOfIcon));
  }
  this->UseText(painter, VTK_TEXT_LEFT, true);
  pencil.Text(indent, y + 0.5f * (heightOfHead - lineHeight), this->Title);
  this->UseText(painter, VTK_TEXT_LEFT);
  if (!this->Label.empty())
  {
    y -= lineHeight;
    pencil.Text(0, y, this->GetLabelWithUnit());
  }
  if (this->HasScale())
  {
    y -= side + 0.3f;
    const float across = this->HasPlane() ? side : widthOfScale;
    painter->DrawImage(
      vtkRectf(pencil.x(0), pencil.y(y), across * font, side * font), this->Colors);
    y -= lineHeight;
    if (this->HasPlane())
    {
      this->UseText(painter, VTK_TEXT_LEFT);
      pencil.Text(0, y, this->TextAt(this->Range[0]));
      this->UseText(painter, VTK_TEXT_RIGHT);
      pencil.Text(side, y, this->TextAt(this->Range[1]));
    }
    else
    {
      this->DrawTicks(pencil, y);
    }
  }
  this->UseText(painter, VTK_TEXT_LEFT);
  for (const std::string& note : this->Notes)
  {
    y -= lineHeight;
    pencil.Text(0, y, note);
  }
  if (this->MetresPerPixel > 0)
  {
    this->DrawRuler(pencil, y - lineHeight);
  }
  return true;
}

//------------------------------------------------------------------------------
vtkStandardNewMacro(vtkSchlierenLegend);

//------------------------------------------------------------------------------
vtkSchlierenLegend::vtkSchlierenLegend()
  : Shown(vtkSmartPointer<Panel>::New())
{
  this->GetScene()->AddItem(this->Shown);
  this->PickableOff();
  this->DragableOff();
  this->UseBoundsOff();
}

//------------------------------------------------------------------------------
vtkSchlierenLegend::~vtkSchlierenLegend() = default;

//------------------------------------------------------------------------------
void vtkSchlierenLegend::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Corner: " << this->Shown->Corner << "\n";
  os << indent << "FontSize: " << this->Shown->FontSize << "\n";
  os << indent << "Title: " << this->Shown->Title << "\n";
}

//------------------------------------------------------------------------------
void vtkSchlierenLegend::SetCorner(int corner) { this->Shown->Corner = corner; }

//------------------------------------------------------------------------------
void vtkSchlierenLegend::SetFontSize(int points) { this->Shown->FontSize = points; }

//------------------------------------------------------------------------------
void vtkSchlierenLegend::CopyFieldData(vtkImageData* from, vtkImageData* to)
{
  for (const char* name : arraysOfLegend)
  {
    if (vtkAbstractArray* array = from->GetFieldData()->GetAbstractArray(name))
    {
      to->GetFieldData()->AddArray(array);
    }
  }
}

//------------------------------------------------------------------------------
void vtkSchlierenLegend::SetImage(vtkImageData* image, const Painting& painting)
{
  Panel& shown = *this->Shown;
  shown.Title.clear();
  vtkFieldData* data = image ? image->GetFieldData() : nullptr;
  auto* colors =
    data ? vtkUnsignedCharArray::SafeDownCast(data->GetArray("LegendColors")) : nullptr;
  const auto title = data ? textsIn(data, "LegendTitle") : std::vector<std::string>();
  const auto label = data ? textsIn(data, "LegendLabel") : std::vector<std::string>();
  if (title.empty() || label.size() < 2)
  {
    return;
  }
  shown.Title = title[0];
  shown.Label = label[0];
  shown.Unit = label[1];
  shown.Notes = textsIn(data, "LegendNotes");
  for (int i = 0; i < 2; ++i)
  {
    shown.Range[i] = numberIn(data, "LegendRange", i, 0);
    shown.Size[i] = static_cast<int>(numberIn(data, "LegendSize", i, 0));
  }
  shown.HasAngle = data->HasArray("LegendAngle") != 0;
  shown.Angle = numberIn(data, "LegendAngle", 0, 0);
  const vtkIdType count = vtkIdType{ shown.Size[0] } * shown.Size[1];
  const vtkSmartPointer<vtkUnsignedCharArray> painted = colors && painting.IsLight
    ? paintedLight(colors, numberIn(data, "WhiteLevel", 0, 1), painting.Map)
    : nullptr;
  if (!painting.IsLight || (colors && !painted))
  {
    shown.Label.clear();
  }
  if (!painted || count == 0 || count != painted->GetNumberOfTuples())
  {
    shown.Size[0] = shown.Size[1] = 0;
  }
  else
  {
    shown.IsDarkFirst = colors->GetComponent(0, 1) < colors->GetComponent(count - 1, 1);
    shown.Colors->Initialize();
    shown.Colors->SetDimensions(shown.Size[0], shown.Size[1], 1);
    shown.Colors->GetPointData()->SetScalars(painted);
  }
  shown.MetresPerUnit = numberIn(data, "LengthScale", 0, 0);
}

//------------------------------------------------------------------------------
int vtkSchlierenLegend::RenderOverlay(vtkViewport* viewport)
{
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  if (!renderer || this->Shown->Title.empty())
  {
    return 0;
  }
  const vtkSchlierenActor::View view = vtkSchlierenActor::ViewOf(renderer);
  this->Shown->MetresPerPixel = this->Shown->MetresPerUnit * 2 * view.ParallelScale / view.Size[1];
  return this->Superclass::RenderOverlay(viewport);
}
