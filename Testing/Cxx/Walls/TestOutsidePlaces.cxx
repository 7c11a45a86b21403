// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where light passes that no cell covers.
#include "OutsideShapes.h"

#include <set>

namespace
{

using Names = std::set<std::string>;

/// Turned about z.
Vec turnedInPlane(const Vec& x, double degrees)
{
  const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
  return { c * x[0] - s * x[1], s * x[0] + c * x[1], x[2] };
}

/// Returns the shapes of which any place is not as expected.
Names wrongOf(const std::vector<OutsideShape>& shapes, double degrees)
{
  Names wrong;
  for (const OutsideShape& shape : shapes)
  {
    for (const Data& block : shape.blocks)
    {
      vtkPoints* points = asPoints(block)->GetPoints();
      for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
      {
        points->SetPoint(i,
          turnedInPlane(
            Vec{ points->GetPoint(i)[0], points->GetPoint(i)[1], points->GetPoint(i)[2] }, degrees)
            .data());
      }
      points->Modified();
    }
    const Cells cells(shape.blocks);
    const auto extent = shape.isLayer ? filters::Extent::Layer : filters::Extent::Volume;
    const GasBoundary boundary =
      boundaryOfLeaves(pointers(shape.blocks), nullptr, Outside::Auto, {}, extent);
    for (const auto& [place, passes] : shape.places)
    {
      const Vec at = turnedInPlane(place, degrees);
      const bool doesPass = boundary.kindAt(at, cells.hold(at)) != Place::Wall;
      if (doesPass != passes)
      {
        wrong.insert(shape.name);
      }
    }
  }
  return wrong;
}

// What is wrong is named in properties.md.
const Names knownInPlanes{ "cascade", "double cone", "ramp from the inlet on",
  "tunnel with rounded corners" };
const Names knownInSpace{ "two blocks", "two blocks aside" };

} // namespace

TEST(OutsidePlaces, PlanesAreRightButForKnownOnes)
{
  EXPECT_EQ(wrongOf(shapes::inPlanes(), 0), knownInPlanes);
}

TEST(OutsidePlaces, TurnedPlanesAreRightButForKnownOnes)
{
  EXPECT_EQ(wrongOf(shapes::inPlanes(), 30), knownInPlanes);
}

TEST(OutsidePlaces, MeshesAreRightButForKnownOnes)
{
  EXPECT_EQ(wrongOf(shapes::inSpace(), 0), knownInSpace);
}

TEST(OutsidePlaces, TurnedMeshesAreRightButForKnownOnes)
{
  EXPECT_EQ(wrongOf(shapes::inSpace(), 30), knownInSpace);
}

// The floor rises; all below it is beyond the box's low side or passes.
TEST(OutsidePlaces, NothingBendsLightBesideAnObliqueBoundary)
{
  for (const double degrees : { 35., 45., 50. })
  {
    const double slope = std::tan(degrees * pi / 180);
    auto mesh = curvilinear(161, 61, 3,
      [&](double i, double j, double k)
      {
        const double x = -0.02 + 0.22 * i, floor = slope * std::max(0., x);
        return Vec{ x, floor + j * (0.3 - floor), 0.05 * k - 0.025 };
      });
    addPointArray(mesh, "rho",
      [](const Vec& x) { return 1.2 + 0.5 * std::sin(200 * x[0] + 100 * x[1]) * (1 + x[2]); });
    vtkNew<vtkSchlierenFilter> filter;
    filter->SetInputData(mesh);
    filter->SetInputArrayToProcess(
      vtkRefractiveIndex::DENSITY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "rho");
    const auto pixelsBelow = [&](vtkSchlierenFilter::OutsideModes outside, const char* array)
    {
      filter->SetOutside(outside);
      filter->Update();
      auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
      const std::vector<double> values = valuesOf(filter, array);
      const std::size_t components =
        values.size() / static_cast<std::size_t>(image->GetNumberOfPoints());
      int found = 0, below = 0;
      for (vtkIdType p = 0; p < image->GetNumberOfPoints(); ++p)
      {
        const double* x = image->GetPoint(p);
        if (x[0] > 0.005 && x[0] < 0.199 && x[1] > 0.001 && x[1] < slope * x[0] - 0.0025)
        {
          ++below;
          found += std::abs(values[static_cast<std::size_t>(p) * components]) > 1e-9 ? 1 : 0;
        }
      }
      EXPECT_GT(below, 1000);
      return static_cast<double>(found) / below;
    };
    EXPECT_EQ(pixelsBelow(vtkSchlierenFilter::OUTSIDE_PASSES, "Deflection"), 0) << degrees;
    EXPECT_EQ(pixelsBelow(vtkSchlierenFilter::OUTSIDE_AUTO, "BlockedFraction"), 1) << degrees;
    const std::string status = filter->GetStatus();
    EXPECT_NE(
      status.find(" % of the image is blocked where no cell is (Outside)"), std::string::npos)
      << status;
  }
}
