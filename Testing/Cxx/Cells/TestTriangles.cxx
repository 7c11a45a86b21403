// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Triangles.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <utility>

namespace filters
{

namespace
{

TEST(TriangleTree, KnowsWhatIsBehindATriangle)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  const Point centre{ 3, 0, 0 };
  const auto place = [&](double size) {
    return centre + size * Point{ any(random), any(random), any(random) };
  };
  for (const bool isSphere : { true, false }) // seen from within all of it is in front; or anywhere
  {
    Triangles surface;
    for (int n = 0; n < 500; ++n)
    {
      // Towards the centre of a sphere; or anywhere.
      const Point middle = place(1);
      const Point out = unit(middle - centre), one = unit(cross(out, { 0.3, 0.4, 0.5 }));
      const Point other = cross(out, one);
      for (const Point& across : { 0.1 * other, 0.1 * one, -0.1 * (one + other) })
      {
        surface.points.push_back(
          isSphere ? centre + unit(out + across) : middle + 0.1 * (place(1) - centre));
      }
      const auto first = static_cast<std::int32_t>(surface.points.size() - 3);
      surface.corners.push_back({ first, first + 1, first + 2 });
    }
    TriangleTree tree(surface);
    tree.findPlanes();
    int behind = 0, others = 0;
    for (int n = 0; n < 2000; ++n)
    {
      const Point at = place(isSphere ? 1.2 : 60);
      bool is = false;
      for (std::size_t t = 0; t < surface.size(); ++t)
      {
        is = is || dot(surface.normal(t), at - surface.corner(t, 0)) < 0;
      }
      EXPECT_EQ(tree.isBehindAny(at), is);
      (is ? behind : others) += 1;
    }
    EXPECT_GT(behind, 100);
    EXPECT_TRUE(!isSphere || others > 100);
  }
  const Triangles none;
  TriangleTree empty(none);
  empty.findPlanes();
  EXPECT_FALSE(empty.isBehindAny({ 0, 0, 0 }));
}

} // namespace

} // namespace filters
