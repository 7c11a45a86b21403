// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/BetweenTimeSteps.h"

#include "Common/AvailableMemory.h"
#include "Common/CellTypes.h"
#include "Common/ImagePlace.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkArrayDispatch.h"
#include "vtkCellArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArrayRange.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSMPTools.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace filters
{

namespace
{

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

struct AreSame
{
  bool Result = false;

  template <class ArrayA, class ArrayB>
  void operator()(ArrayA* a, ArrayB* b)
  {
    const auto ofA = vtk::DataArrayValueRange(a);
    const auto ofB = vtk::DataArrayValueRange(b);
    this->Result = std::equal(ofA.begin(), ofA.end(), ofB.begin(), ofB.end());
  }
};

bool areSame(vtkDataArray* a, vtkDataArray* b)
{
  if (a == b || !a || !b)
  {
    return a == b;
  }
  AreSame compare;
  if (!vtkArrayDispatch::Dispatch2BySameValueType<vtkArrayDispatch::Integrals>::Execute(
        a, b, compare))
  {
    compare(a, b);
  }
  return compare.Result;
}

bool areSame(vtkCellArray* a, vtkCellArray* b)
{
  return a == b ||
    (a && b && areSame(a->GetOffsetsArray(), b->GetOffsetsArray()) &&
      areSame(a->GetConnectivityArray(), b->GetConnectivityArray()));
}

struct Blend
{
  double Ratio;
  vtkDataArray* Result;

  template <class ArrayA, class ArrayB>
  void operator()(ArrayA* a, ArrayB* b)
  {
    using Number = vtk::GetAPIType<ArrayA>;
    const auto earlier = vtk::DataArrayValueRange(a);
    const auto later = vtk::DataArrayValueRange(b);
    auto blended = vtk::DataArrayValueRange(this->Result);
    if (auto* plain = vtkAOSDataArrayTemplate<Number>::FastDownCast(this->Result))
    {
      this->Write(earlier, later, vtk::DataArrayValueRange(plain));
    }
    else
    {
      this->Write(earlier, later, blended);
    }
  }

  template <class RangeA, class RangeB, class Out>
  void Write(const RangeA& earlier, const RangeB& later, Out blended) const
  {
    vtkSMPTools::For(0, earlier.size(),
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          const double from = static_cast<double>(earlier[i]);
          blended[i] = static_cast<typename Out::ValueType>(
            from + this->Ratio * (static_cast<double>(later[i]) - from));
        }
      });
  }
};

vtkSmartPointer<vtkDataArray> blend(vtkDataArray* earlier, vtkDataArray* later, double ratio)
{
  auto result =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(earlier->GetDataType()));
  result->SetName(earlier->GetName());
  result->SetNumberOfComponents(earlier->GetNumberOfComponents());
  setTuples(result, earlier->GetNumberOfTuples());
  Blend blender{ ratio, result };
  if (!vtkArrayDispatch::Dispatch2BySameValueType<vtkArrayDispatch::Reals>::Execute(
        earlier, later, blender))
  {
    blender(earlier, later);
  }
  return result;
}

bool isReal(vtkDataArray* array)
{
  return array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
}

bool haveSameSize(vtkDataArray* a, vtkDataArray* b)
{
  return a->GetNumberOfTuples() == b->GetNumberOfTuples() &&
    a->GetNumberOfComponents() == b->GetNumberOfComponents();
}

void blendArrays(vtkDataSetAttributes* earlier, vtkDataSetAttributes* later, double ratio,
  vtkDataSetAttributes* to)
{
  for (int i = 0; i < earlier->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = earlier->GetArray(i); // null: an array of text
    if (!array || !array->GetName() || !isReal(array))
    {
      continue;
    }
    vtkDataArray* other = later->GetArray(array->GetName());
    if (!other || !haveSameSize(array, other))
    {
      fail("the array " + std::string(array->GetName()) + " is not in both of them");
    }
    to->AddArray(blend(array, other, ratio)); // replaces the array of the same name
  }
}

void blendCoordinates(
  vtkRectilinearGrid* earlier, vtkRectilinearGrid* later, double ratio, vtkRectilinearGrid* to)
{
  if (!std::equal(earlier->GetExtent(), earlier->GetExtent() + 6, later->GetExtent()))
  {
    fail("their grids have different extents");
  }
  to->SetXCoordinates(blend(earlier->GetXCoordinates(), later->GetXCoordinates(), ratio));
  to->SetYCoordinates(blend(earlier->GetYCoordinates(), later->GetYCoordinates(), ratio));
  to->SetZCoordinates(blend(earlier->GetZCoordinates(), later->GetZCoordinates(), ratio));
}

void blendPoints(vtkPointSet* earlier, vtkPointSet* later, double ratio, vtkPointSet* to)
{
  if (!earlier->GetPoints() || earlier->GetPoints() == later->GetPoints())
  {
    return;
  }
  auto points =
    vtkSmartPointer<vtkPoints>::Take(vtkPoints::New(earlier->GetPoints()->GetDataType()));
  points->SetData(blend(earlier->GetPoints()->GetData(), later->GetPoints()->GetData(), ratio));
  to->SetPoints(points);
}

bool haveSameCells(vtkDataSet* a, vtkDataSet* b)
{
  if (auto* structured = vtkStructuredGrid::SafeDownCast(a))
  {
    const int* extent = structured->GetExtent();
    return std::equal(extent, extent + 6, vtkStructuredGrid::SafeDownCast(b)->GetExtent());
  }
  if (auto* mesh = vtkUnstructuredGrid::SafeDownCast(a))
  {
    auto* other = vtkUnstructuredGrid::SafeDownCast(b);
    return areSame(mesh->GetCells(), other->GetCells()) &&
      areSame(cellTypesOf(mesh), cellTypesOf(other));
  }
  if (auto* surface = vtkPolyData::SafeDownCast(a))
  {
    auto* other = vtkPolyData::SafeDownCast(b);
    return areSame(surface->GetPolys(), other->GetPolys()) &&
      areSame(surface->GetStrips(), other->GetStrips());
  }
  return true;
}

vtkSmartPointer<vtkDataObject> blendLeaves(
  vtkDataObject* earlierObject, vtkDataObject* laterObject, double ratio)
{
  auto* earlier = vtkDataSet::SafeDownCast(earlierObject);
  auto* later = vtkDataSet::SafeDownCast(laterObject);
  if (!earlier || !later || earlier->GetDataObjectType() != later->GetDataObjectType())
  {
    fail("they are of different or unknown types");
  }
  const vtkIdType points[] = { earlier->GetNumberOfPoints(), later->GetNumberOfPoints() };
  const vtkIdType cells[] = { earlier->GetNumberOfCells(), later->GetNumberOfCells() };
  if (points[0] != points[1] || cells[0] != cells[1])
  {
    fail("they have " + std::to_string(points[0]) + " and " + std::to_string(points[1]) +
      " points and " + std::to_string(cells[0]) + " and " + std::to_string(cells[1]) + " cells");
  }
  auto result = vtkSmartPointer<vtkDataSet>::Take(earlier->NewInstance());
  result->ShallowCopy(earlier);
  if (auto* image = vtkImageData::SafeDownCast(earlier))
  {
    auto* other = vtkImageData::SafeDownCast(later);
    if (!std::equal(image->GetExtent(), image->GetExtent() + 6, other->GetExtent()) ||
      !haveSamePlace(image, other))
    {
      fail("their grids lie at different places");
    }
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(earlier))
  {
    blendCoordinates(rectilinear, vtkRectilinearGrid::SafeDownCast(later), ratio,
      vtkRectilinearGrid::SafeDownCast(result));
  }
  else if (!haveSameCells(earlier, later))
  {
    fail("their cells have different points");
  }
  else if (auto* set = vtkPointSet::SafeDownCast(earlier))
  {
    blendPoints(set, vtkPointSet::SafeDownCast(later), ratio, vtkPointSet::SafeDownCast(result));
  }
  for (const int association : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    blendArrays(earlier->GetAttributes(association), later->GetAttributes(association), ratio,
      result->GetAttributes(association));
  }
  return result;
}

vtkSmartPointer<vtkDataObject> blendBlocks(
  vtkCompositeDataSet* earlier, vtkCompositeDataSet* later, double ratio)
{
  auto result = vtkSmartPointer<vtkCompositeDataSet>::Take(earlier->NewInstance());
  result->CopyStructure(earlier);
  auto one = vtkSmartPointer<vtkCompositeDataIterator>::Take(earlier->NewIterator());
  auto other = vtkSmartPointer<vtkCompositeDataIterator>::Take(later->NewIterator());
  other->InitTraversal();
  for (one->InitTraversal(); !one->IsDoneWithTraversal(); one->GoToNextItem())
  {
    if (other->IsDoneWithTraversal() || one->GetCurrentFlatIndex() != other->GetCurrentFlatIndex())
    {
      break;
    }
    result->SetDataSet(
      one, blendLeaves(one->GetCurrentDataObject(), other->GetCurrentDataObject(), ratio));
    other->GoToNextItem();
  }
  if (!one->IsDoneWithTraversal() || !other->IsDoneWithTraversal())
  {
    fail("they have different blocks");
  }
  result->GetFieldData()->ShallowCopy(earlier->GetFieldData());
  return result;
}

} // namespace

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataObject> betweenTimeSteps(
  vtkDataObject* earlier, vtkDataObject* later, double ratio)
{
  if (earlier == later || ratio == 0)
  {
    return earlier;
  }
  auto* blocks = vtkCompositeDataSet::SafeDownCast(earlier);
  auto* laterBlocks = vtkCompositeDataSet::SafeDownCast(later);
  return blocks && laterBlocks ? blendBlocks(blocks, laterBlocks, ratio)
                               : blendLeaves(earlier, later, ratio);
}

} // namespace filters
