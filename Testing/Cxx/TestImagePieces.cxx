// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Images whose pieces are on several ranks, against the same images in one piece.
#include "Pieces.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"

#include <limits>
#include <stdexcept>

namespace
{

using Extent = std::array<int, 6>;

constexpr Extent all{ -7, 34, 3, 38, 0, 27 };

/// The values differ by half of the range from one point to the next: what points far away change in a spline shows.
double rough(const Vec& x)
{
  return ball(x) + 5e-5 * std::sin(70 * x[0]) * std::cos(50 * x[1] - 60 * x[2]);
}

/// An image, or a part of it.
vtkSmartPointer<vtkImageData> imageOf(const Extent& extent = all, bool isTurned = false)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(extent[0], extent[1], extent[2], extent[3], extent[4], extent[5]);
  image->SetSpacing(0.05, 0.06, 0.07);
  image->SetOrigin(-0.67, -1.23, -0.95);
  if (isTurned)
  {
    image->SetDirectionMatrix(0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1);
  }
  addPointArray(image, "N", rough);
  addCellArray(image, "N of cells", rough);
  return image;
}

/// Cut by 1, 2 and 5 planes, and by two that cross.
std::vector<std::vector<Extent>> cuts()
{
  std::vector<std::vector<Extent>> cut(4);
  const auto layers = [](const std::vector<int>& at, std::vector<Extent>& parts)
  {
    for (std::size_t i = 0; i + 1 < at.size(); ++i)
    {
      parts.push_back({ at[i], at[i + 1], all[2], all[3], all[4], all[5] });
    }
  };
  layers({ -7, 13, 34 }, cut[0]);
  layers({ -7, 12, 15, 34 }, cut[1]);
  layers({ -7, -6, 10, 13, 14, 20, 34 }, cut[2]);
  cut[3] = { { -7, 13, 3, 20, 0, 27 }, { 13, 34, 3, 20, 0, 27 }, { -7, 10, 20, 38, 0, 27 },
    { 10, 34, 20, 38, 0, 27 } };
  return cut;
}

/// Makes the parts of an image; the second rank has none.
template <class Make>
std::vector<Data> partsOf(const std::vector<Extent>& extents, const Make& make)
{
  std::vector<Data> parts;
  for (const Extent& extent : extents)
  {
    parts.push_back(make(extent));
    if (parts.size() == 1)
    {
      parts.push_back(nullptr);
    }
  }
  return parts;
}

/// Single precision is what splines have.
constexpr double precision = 1e-7;

TEST(ImagePieces, AreSampledAsOneImage)
{
  for (const bool ofCells : { false, true })
  {
    for (const bool isTurned : { false, true })
    {
      const auto make = [&](const Extent& extent) { return imageOf(extent, isTurned); };
      const auto whole = inOnePiece(make(all), ofCells);
      for (const std::vector<Extent>& extents : cuts())
      {
        SCOPED_TRACE(std::to_string(extents.size()) + (ofCells ? ", cells" : ", points"));
        Ranks ranks(partsOf(extents, make), ofCells);
        const auto pieces = ranks.make();
        expectSame(*whole, *pieces, precision);
        EXPECT_EQ(whole->direction(), pieces->direction());
      }
    }
  }
}

// What a tree asks: the ranges of values in a box do not depend on who has them.
TEST(ImagePieces, SayTheSameOfBoxes)
{
  const auto whole = inOnePiece(imageOf());
  for (const std::vector<Extent>& extents : cuts())
  {
    Ranks ranks(partsOf(extents, [](const Extent& extent) { return imageOf(extent); }));
    const auto pieces = ranks.make();
    expectSameContents(*whole, *pieces);
  }
}

// Points that are no gas, in and beside the planes between pieces, and a body across them.
TEST(ImagePieces, WallsAndBodiesGoOn)
{
  const auto make = [](const Extent& extent)
  {
    auto image = imageOf(extent);
    vtkDataArray* values = image->GetPointData()->GetArray("N");
    for (vtkIdType point = 0; point < image->GetNumberOfPoints(); ++point)
    {
      Vec x;
      image->GetPoint(point, x.data());
      if (std::abs(x[0] + 0.02) < 0.14 && std::abs(x[1] - 0.3) < 0.2 && x[2] > 0.2)
      {
        values->SetComponent(point, 0, std::numeric_limits<double>::quiet_NaN());
      }
    }
    return image;
  };
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.75); // more than what ranks know of others
  sphere->SetCenter(0.1, -0.4, -0.5);
  sphere->SetThetaResolution(40);
  sphere->SetPhiResolution(40);
  sphere->Update();
  for (vtkPolyData* bodies : { static_cast<vtkPolyData*>(nullptr), sphere->GetOutput() })
  {
    const auto whole = inOnePiece(make(all), false, bodies);
    for (const std::vector<Extent>& extents : cuts())
    {
      SCOPED_TRACE(extents.size());
      Ranks ranks(partsOf(extents, make));
      // Values within what is no gas are continued from what a rank knows, which the spline beside it feels.
      expectSame(*whole, *ranks.make(bodies), 1e-5);
    }
  }
}

// As parts of a partitioned dataset, too; but not where some of it is missing between them.
TEST(ImagePieces, MayBePartsOfAComposite)
{
  const auto parted = [](const Extent& extent)
  {
    vtkNew<vtkPartitionedDataSet> parts;
    parts->SetPartition(0, imageOf(extent));
    return Data(parts);
  };
  Ranks ranks(partsOf(cuts()[1], parted));
  expectSame(*inOnePiece(imageOf()), *ranks.make(), precision);

  const std::vector<Extent> apart{ { -7, 8, 3, 38, 0, 27 }, { 12, 34, 3, 38, 0, 27 } };
  Ranks ranksApart(partsOf(apart, parted));
  const auto pieces = ranksApart.make();
  const schlieren::Box gap{ { -0.18, 0.1, -0.1 }, { -0.12, 0.2, 0.1 } };
  pieces->prepareContents({ gap });
  EXPECT_FALSE(pieces->contentOf(gap).hasGas);
}

TEST(ImagePieces, PartsOfDifferentImagesAreRefused)
{
  const auto other = imageOf({ 13, 34, 3, 38, 0, 27 });
  other->SetSpacing(0.05, 0.06, 0.08);
  Ranks ranks({ imageOf({ -7, 13, 3, 38, 0, 27 }), other });
  try
  {
    ranks.make();
    FAIL();
  }
  catch (const std::runtime_error& problem)
  {
    EXPECT_NE(std::string(problem.what()).find("spacings"), std::string::npos) << problem.what();
  }
}

} // namespace
