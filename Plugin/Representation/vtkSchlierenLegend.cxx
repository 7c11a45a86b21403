// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSchlierenLegend.h"

#include "LegendColors.h"
#include "LegendPanel.h"
#include "vtkSchlierenActor.h"
#include "vtkSchlierenFilter.h"

#include "vtkContextScene.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <string>
#include <vector>

namespace
{

constexpr const char* arraysOfLegend[] = { "LegendTitle", "LegendLabel", "LegendRange",
  "LegendSize", "LegendColors", "LegendNotes", "LegendAngle", "LengthScale" };

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

} // namespace

vtkStandardNewMacro(vtkSchlierenLegend);

vtkSchlierenLegend::vtkSchlierenLegend()
  : Shown(vtkSmartPointer<LegendPanel>::New())
{
  this->GetScene()->AddItem(this->Shown);
  this->PickableOff();
  this->DragableOff();
  this->UseBoundsOff();
}

vtkSchlierenLegend::~vtkSchlierenLegend() = default;

void vtkSchlierenLegend::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Corner: " << this->Shown->Corner << "\n";
  os << indent << "Title: " << this->Shown->Title << "\n";
}

void vtkSchlierenLegend::SetCorner(int corner) { this->Shown->Corner = corner; }

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

void vtkSchlierenLegend::SetImage(vtkImageData* image, const Painting& painting)
{
  LegendPanel& shown = *this->Shown;
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

int vtkSchlierenLegend::RenderOverlay(vtkViewport* viewport)
{
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  if (!renderer || this->Shown->Title.empty())
  {
    return 0;
  }
  const vtkSchlierenActor::View view = vtkSchlierenActor::ViewOf(renderer);
  this->Shown->MetresPerPixel = this->Shown->MetresPerUnit * 2 * view.ParallelScale / view.Size[1];
  constexpr int dpiOfViews = 72;
  vtkRenderWindow* window = renderer->GetRenderWindow();
  this->Shown->PixelsPerPoint =
    std::max(1, window->GetTileScale()[1] * window->GetDPI() / dpiOfViews);
  return this->Superclass::RenderOverlay(viewport);
}
