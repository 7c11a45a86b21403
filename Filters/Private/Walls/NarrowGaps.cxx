// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Walls/NarrowGaps.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace filters
{

namespace
{

constexpr int rings = 3;                // of faces around one, in which the gap has to close
constexpr double opposite = -0.5;       // greatest cosine between outward directions of both sides
constexpr double alike = 0.3;           // least cosine on the same side
constexpr unsigned quadrantsNeeded = 3; // of a face, in which there are shared points

/// The faces at each point.
class FacesOfPoints
{
public:
  FacesOfPoints(std::size_t points, const std::vector<OpenFace>& faces)
    : Starts(points + 1, 0)
  {
    for (const OpenFace& face : faces)
    {
      for (const std::int32_t corner : face.corners)
      {
        ++this->Starts[static_cast<std::size_t>(corner) + 1];
      }
    }
    std::partial_sum(this->Starts.begin(), this->Starts.end(), this->Starts.begin());
    this->Numbers.resize(this->Starts.back());
    std::vector<std::size_t> next(this->Starts.begin(), this->Starts.end() - 1);
    for (std::size_t face = 0; face < faces.size(); ++face)
    {
      for (const std::int32_t corner : faces[face].corners)
      {
        this->Numbers[next[static_cast<std::size_t>(corner)]++] = face;
      }
    }
  }

  const std::size_t* begin(std::int32_t point) const
  {
    return this->Numbers.data() + this->Starts[static_cast<std::size_t>(point)];
  }
  const std::size_t* end(std::int32_t point) const { return this->begin(point + 1); }

private:
  std::vector<std::size_t> Starts, Numbers;
};

double cosine(const OpenFace& a, const OpenFace& b)
{
  return dot(a.sides.outward, b.sides.outward);
}

class GapSearch
{
public:
  GapSearch(const std::vector<Point>& points, const std::vector<OpenFace>& faces)
    : Points{ points }
    , Faces{ faces }
    , OfPoints(points.size(), faces)
    , AreShared(points.size(), 0)
    , Visits(faces.size(), 0)
  {
    for (const OpenFace& face : faces)
    {
      for (const std::int32_t corner : face.corners)
      {
        unsigned char& isShared = this->AreShared[static_cast<std::size_t>(corner)];
        isShared = isShared ||
            std::any_of(this->OfPoints.begin(corner), this->OfPoints.end(corner),
              [&](std::size_t other) { return cosine(face, faces[other]) < opposite; })
          ? 1
          : 0;
      }
    }
  }

  /// Returns which faces have a shared point within reach: few or none on bodies.
  std::vector<unsigned char> areNearSharedPoints() const
  {
    std::vector<unsigned char> areNear = this->AreShared, areFaces(this->Faces.size(), 0);
    const auto isNear = [&](std::int32_t corner)
    { return areNear[static_cast<std::size_t>(corner)] != 0; };
    for (int ring = 0; ring <= rings; ++ring)
    {
      for (std::size_t face = 0; face < this->Faces.size(); ++face)
      {
        const std::vector<std::int32_t>& corners = this->Faces[face].corners;
        areFaces[face] =
          areFaces[face] || std::any_of(corners.begin(), corners.end(), isNear) ? 1 : 0;
      }
      for (std::size_t face = 0; face < this->Faces.size(); ++face)
      {
        for (std::size_t i = 0; i < this->Faces[face].corners.size() && areFaces[face]; ++i)
        {
          areNear[static_cast<std::size_t>(this->Faces[face].corners[i])] = 1;
        }
      }
    }
    return areFaces;
  }

  /// Returns whether there are shared points around a face.
  bool isSurrounded(std::size_t of)
  {
    const OpenFace& face = this->Faces[of];
    const Point along = unit(this->Points[static_cast<std::size_t>(face.corners[1])] -
      this->Points[static_cast<std::size_t>(face.corners[0])]);
    const Point across = cross(face.sides.outward, along);
    unsigned quadrants = 0;
    const auto look = [&](std::size_t at)
    {
      for (const std::int32_t corner : this->Faces[at].corners)
      {
        if (this->AreShared[static_cast<std::size_t>(corner)])
        {
          const Point from = this->Points[static_cast<std::size_t>(corner)] - face.sides.middle;
          quadrants |= 1U << ((dot(from, along) < 0 ? 2 : 0) + (dot(from, across) < 0 ? 1 : 0));
        }
      }
    };
    const auto isEnough = [&]
    {
      unsigned count = 0;
      for (unsigned quadrant = 0; quadrant < 4; ++quadrant)
      {
        count += quadrants >> quadrant & 1U;
      }
      return count >= quadrantsNeeded;
    };
    ++this->Visit;
    this->Visits[of] = this->Visit;
    std::vector<std::size_t> reached{ of };
    look(of);
    std::size_t first = 0;
    for (int ring = 0; ring < rings && !isEnough(); ++ring)
    {
      const std::size_t end = reached.size();
      for (; first < end; ++first)
      {
        for (const std::int32_t corner : this->Faces[reached[first]].corners)
        {
          std::for_each(this->OfPoints.begin(corner), this->OfPoints.end(corner),
            [&](std::size_t other)
            {
              if (this->Visits[other] != this->Visit && cosine(face, this->Faces[other]) > alike)
              {
                this->Visits[other] = this->Visit;
                reached.push_back(other);
                look(other);
              }
            });
        }
      }
    }
    return isEnough();
  }

private:
  const std::vector<Point>& Points;
  const std::vector<OpenFace>& Faces;
  FacesOfPoints OfPoints;
  std::vector<unsigned char> AreShared; // of points: whether faces of both sides have it
  std::vector<std::size_t> Visits;      // of faces: the last search that came there
  std::size_t Visit = 0;
};

} // namespace

std::vector<unsigned char> areBesideNarrowGaps(
  const std::vector<Point>& points, const std::vector<OpenFace>& faces)
{
  GapSearch search(points, faces);
  std::vector<unsigned char> are = search.areNearSharedPoints();
  for (std::size_t face = 0; face < faces.size(); ++face)
  {
    are[face] = are[face] && search.isSurrounded(face) ? 1 : 0;
  }
  return are;
}

} // namespace filters
