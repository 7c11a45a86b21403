// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Data that are one cell thick are seen as the plane that they stand for.
#include "Fixtures.h"

#include "vtkAppendFilter.h"
#include "vtkCellType.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

namespace
{

constexpr double thickness = 0.1;
constexpr int around = 61, outward = 41;

/// From coordinates in the plane and across it to the data's.
Vec placed(int axis, double a, double b, double across)
{
  return axis == 0 ? Vec{ across, a, b } : axis == 1 ? Vec{ a, across, b } : Vec{ a, b, across };
}

double fieldAt(double a, double b) { return 1e-5 * std::exp(-((a - 1) * (a - 1) + b * b)); }

/// A body-fitted mesh of so many layers of points; across the plane, the field changes by `slope`.
vtkSmartPointer<vtkStructuredGrid> ring(
  int axis, int layers, bool ofCells = false, double slope = 0)
{
  auto mesh = vtkSmartPointer<vtkStructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> values;
  values->SetName("N");
  for (int k = 0; k < layers; ++k)
  {
    for (int j = 0; j < outward; ++j)
    {
      for (int i = 0; i < around; ++i)
      {
        const double r = 0.5 * std::pow(12, j / (outward - 1.)), angle = 2 * pi * i / (around - 1);
        const double a = r * std::cos(angle), b = r * std::sin(angle);
        points->InsertNextPoint(
          placed(axis, a, b, layers == 1 ? 0.5 * thickness : k * thickness).data());
        values->InsertNextValue(fieldAt(a, b) * (1 + k * slope));
      }
    }
  }
  mesh->SetDimensions(around, outward, layers);
  mesh->SetPoints(points);
  mesh->GetPointData()->AddArray(values);
  if (ofCells)
  {
    addCellArray(mesh, "N",
      [axis](const Vec& x)
      {
        return axis == 0 ? fieldAt(x[1], x[2])
          : axis == 1    ? fieldAt(x[0], x[2])
                         : fieldAt(x[0], x[1]);
      });
    mesh->GetPointData()->Initialize();
  }
  return mesh;
}

vtkSmartPointer<vtkUnstructuredGrid> asCells(vtkDataSet* mesh)
{
  vtkNew<vtkAppendFilter> append;
  append->SetInputData(mesh);
  append->Update();
  return append->GetOutput();
}

/// Each hexahedron as two wedges, or as a polyhedron.
vtkSmartPointer<vtkUnstructuredGrid> asOtherCells(vtkDataSet* mesh, int type)
{
  auto cells = vtkSmartPointer<vtkUnstructuredGrid>::New();
  cells->SetPoints(vtkPointSet::SafeDownCast(mesh)->GetPoints());
  cells->GetPointData()->ShallowCopy(mesh->GetPointData());
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    mesh->GetCellPoints(cell, ids);
    const vtkIdType* c = ids->GetPointer(0);
    if (type == VTK_WEDGE)
    {
      const vtkIdType first[6] = { c[0], c[1], c[2], c[4], c[5], c[6] };
      const vtkIdType second[6] = { c[0], c[2], c[3], c[4], c[6], c[7] };
      cells->InsertNextCell(VTK_WEDGE, 6, first);
      cells->InsertNextCell(VTK_WEDGE, 6, second);
      continue;
    }
    const vtkIdType faces[] = { 4, c[0], c[3], c[2], c[1], 4, c[4], c[5], c[6], c[7], 4, c[0], c[1],
      c[5], c[4], 4, c[1], c[2], c[6], c[5], 4, c[2], c[3], c[7], c[6], 4, c[3], c[0], c[4], c[7] };
    cells->InsertNextCell(VTK_POLYHEDRON, 8, c, 6, faces);
  }
  return cells;
}

/// Where the ring closes, a mesh of cells is joined; a structured grid is not.
constexpr double ofSeam = 3e-3;

struct Seen
{
  std::vector<double> path, blocked;
  std::string warning;
};

Seen seen(vtkDataObject* input, bool ofCells = false, double depth = 0)
{
  auto filter = bench(input, 96);
  if (ofCells)
  {
    filter->SetInputArrayToProcess(
      vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "N");
  }
  filter->SetDepth(depth);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_TRUE(complaints->Errors.empty());
  return { valuesOf(filter, "OpticalPathDifference"), valuesOf(filter, "BlockedFraction"),
    complaints->Warnings.empty() ? "" : complaints->Warnings[0] };
}

void expectSame(const Seen& a, const Seen& b, double tolerance = 1e-5)
{
  EXPECT_LT(relativeDifference(a.path, b.path), tolerance);
  EXPECT_LT(relativeDifference(a.blocked, b.blocked), 1e-4);
  EXPECT_NE(a.warning.find("one cell thick"), std::string::npos) << a.warning;
}

} // namespace

TEST(OneLayer, IsSeenAsItsPlane)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const bool ofCells : { false, true })
    {
      SCOPED_TRACE(testing::Message() << axis << (ofCells ? " cells" : " points"));
      const Seen plane = seen(ring(axis, 1, ofCells), ofCells, thickness);
      EXPECT_GT(largest(plane.blocked), 0.9);
      const auto layer = ring(axis, 2, ofCells);
      const Seen structured = seen(layer, ofCells);
      expectSame(structured, plane);
      EXPECT_NE(structured.warning.find(" 0.1 data units"), std::string::npos)
        << structured.warning;
      expectSame(seen(asCells(layer), ofCells), plane, ofSeam);
      Seen deeper = seen(layer, ofCells, 3);
      for (double& path : deeper.path)
      {
        path *= thickness / 3;
      }
      EXPECT_LT(relativeDifference(deeper.path, plane.path), 1e-3);
    }
  }
}

TEST(OneLayer, OfWedgesAndPolyhedraIsSeenAsItsPlane)
{
  const Seen plane = seen(ring(2, 1), false, thickness);
  const auto layer = ring(2, 2);
  expectSame(seen(asOtherCells(layer, VTK_POLYHEDRON)), plane, ofSeam);
  const Seen wedges = seen(asOtherCells(layer, VTK_WEDGE));
  EXPECT_LT(relativeDifference(wedges.path, plane.path), 0.01); // triangles
  EXPECT_NE(wedges.warning.find("one cell thick"), std::string::npos);
}

TEST(OneLayer, OfSeveralBlocksIsSeenAsTheirPlane)
{
  const auto blocksOf = [](int layers)
  {
    auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    for (const int half : { 0, 1 })
    {
      vtkNew<vtkStructuredGrid> part;
      const auto whole = ring(1, layers);
      int extent[6];
      whole->GetExtent(extent);
      extent[2] = half == 0 ? 0 : outward / 2;
      extent[3] = half == 0 ? outward / 2 : outward - 1;
      part->DeepCopy(whole);
      part->Crop(extent);
      blocks->SetBlock(static_cast<unsigned>(half), part);
    }
    return blocks;
  };
  expectSame(seen(blocksOf(2)), seen(blocksOf(1), false, thickness));
}

// What differs from one face to the other is a flow in three dimensions.
TEST(OneLayer, WithOtherValuesBehindIsNone)
{
  const Seen uneven = seen(ring(2, 2, false, 0.5));
  EXPECT_EQ(uneven.warning, "");
  const Seen even = seen(ring(2, 2));
  EXPECT_NEAR(largest(uneven.path) / largest(even.path), 1.25, 0.02);
}

TEST(OneLayer, OfAnImageIsSeenAsItsPlane)
{
  for (const bool ofCells : { false, true })
  {
    std::vector<Seen> images;
    for (const int layers : { 1, 2 })
    {
      vtkNew<vtkImageData> image;
      image->SetDimensions(65, layers, 33);
      image->SetOrigin(-2, layers == 1 ? 0.05 : 0, -1);
      image->SetSpacing(1. / 16, 0.1, 1. / 16);
      const auto field = [](const Vec& x) { return fieldAt(x[0], x[2]); };
      ofCells ? addCellArray(image, "N", field)
              : static_cast<void>(addPointArray(image, "N", field));
      images.push_back(seen(image, ofCells, layers == 1 ? thickness : 0));
    }
    EXPECT_LT(relativeDifference(images[1].path, images[0].path), 1e-5) << ofCells;
    EXPECT_NE(images[1].warning.find("one cell thick along y"), std::string::npos);
  }
}
