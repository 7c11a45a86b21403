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
