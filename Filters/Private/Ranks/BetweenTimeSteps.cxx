// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/BetweenTimeSteps.h"

#include "Cells/MeshKey.h"
#include "Common/AvailableMemory.h"
#include "Common/ImagePlace.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkRectilinearGrid.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace filters
{

namespace
{

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

/// Whether a hash of something in both datasets is the same.
bool areSame(void (*add)(Hash&, vtkDataSet*), vtkDataSet* a, vtkDataSet* b)
{
  Hash ofA, ofB;
  add(ofA, a);
  add(ofB, b);
  return ofA.value() == ofB.value();
}

vtkSmartPointer<vtkDataArray> blend(vtkDataArray* earlier, vtkDataArray* later, double ratio)
{
  auto result =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(earlier->GetDataType()));
  result->SetName(earlier->GetName());
  result->SetNumberOfComponents(earlier->GetNumberOfComponents());
  setTuples(result, earlier->GetNumberOfTuples());
  vtkSMPTools::For(0, earlier->GetNumberOfTuples(),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        result->InterpolateTuple(i, i, earlier, i, later, ratio);
      }
    });
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
  if (!earlier->GetPoints() || areSame(addPoints, earlier, later))
  {
    return;
  }
  auto points =
    vtkSmartPointer<vtkPoints>::Take(vtkPoints::New(earlier->GetPoints()->GetDataType()));
  points->SetData(blend(earlier->GetPoints()->GetData(), later->GetPoints()->GetData(), ratio));
  to->SetPoints(points);
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
  else if (!areSame(addCells, earlier, later))
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
