// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/March/DisplacementBound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace schlieren
{

namespace
{

constexpr double unknown = std::numeric_limits<double>::infinity();
constexpr DisplacementBound noBound{ unknown, unknown, unknown, unknown };

/// Cells along u, v and w.
constexpr std::array<std::size_t, 3> maxCells{ 48, 48, 96 };

/// Boxes whose places decide where cells are.
constexpr std::size_t maxLooks = 4096;

/// A block of steep slopes in units of the light's length, along u (from the ray through pixel (0, 0)), v and w (from
/// the entry plane).
struct SteepBox
{
  float low[3], high[3];
  float gradient; ///< across the light, or all of it
};

struct Range
{
  double low, high;
};

/// Boxes as rays feel them.
class BoxesAlongLight
{
public:
  /// `layerDepth`: index coordinates along z of blocks that are of one layer, which do not need steps along it; 0:
  /// they are cubes.
  BoxesAlongLight(
    const SlopeBlocks& blocks, const Light& light, double stepVoxels, double layerDepth)
    : blocks_(blocks)
    , light_(light)
    , isCollimated_(light.smallestCosine() == 1)
    , layerDepth_(layerDepth)
  {
    Vec3<double> scale = light.indexScale;
    scale.z = layerDepth > 0 ? 0 : scale.z;
    halfStep_ = 0.5 * stepVoxels / light.fastest(scale);
  }

  template <class Visit>
  void forEach(const Visit& visit) const
  {
    for (const SlopeBlock& block : blocks_)
    {
      visit(boxOf(block));
    }
  }

  SteepBox boxOf(const SlopeBlock& block) const
  {
    const Vec3<double> low = static_cast<Vec3<double>>(block.low);
    Vec3<double> high = static_cast<Vec3<double>>(block.high());
    high.z = layerDepth_ > 0 ? layerDepth_ : high.z;
    const Vec3<double> middle = scaled(light_.unitsPerIndex, 0.5 * (low + high) - light_.corner);
    const Vec3<double> half = scaled(light_.unitsPerIndex, 0.5 * (high - low));
    const Vec3<double> gradient = scaled(light_.indexScale, static_cast<Vec3<double>>(block.slope));
    const auto along = [](const Vec3<double>& axis, const Vec3<double>& a)
    { return std::abs(axis.x) * a.x + std::abs(axis.y) * a.y + std::abs(axis.z) * a.z; };
    SteepBox box{};
    const Vec3<double>* const axes[3] = { &light_.u, &light_.v, &light_.w };
    for (int axis = 0; axis < 3; ++axis)
    {
      constexpr double rounding = 1e-5;
      const double at = dot(middle, *axes[axis]);
      // One kick is for all of a step, in whose middle the ray looks.
      const double ofStep = halfStep_ * static_cast<double>(block.edge) / SlopeBlock::voxels;
      const double reach = along(*axes[axis], half) * (1 + rounding) + rounding * std::abs(at) +
        (axis == 2 ? std::min(ofStep, light_.depth) : 0);
      box.low[axis] = static_cast<float>(at - reach);
      box.high[axis] = static_cast<float>(at + reach);
    }
    const double all = length(gradient);
    box.gradient = static_cast<float>(isCollimated_
        ? std::min(all, std::hypot(along(light_.u, gradient), along(light_.v, gradient)))
        : all);
    return box;
  }

private:
  const SlopeBlocks& blocks_;
  const Light& light_;
  bool isCollimated_;
  double layerDepth_;
  double halfStep_;
};

/// What may bend rays: the largest gradient in the cells of columns along the light.
class Columns
{
public:
  /// `areApart`: otherwise there is one column.
  Columns(const BoxesAlongLight& boxes, const std::array<Range, 3>& ranges, bool areApart)
    : boxes_(boxes)
    , ranges_(ranges)
    , areApart_(areApart)
  {
    std::size_t seen = 0;
    boxes.forEach([&](const SteepBox& box) { seen += isSeen(box) ? 1 : 0; });
    const std::size_t each = seen / maxLooks + 1;
    std::size_t number = 0;
    std::vector<float> sides[3];
    boxes.forEach(
      [&](const SteepBox& box)
      {
        number += isSeen(box) ? 1 : 0;
        for (std::size_t axis = 0; axis < 3 && isSeen(box) && number % each == 0; ++axis)
        {
          sides[axis].push_back(box.low[axis]);
          sides[axis].push_back(box.high[axis]);
        }
      });
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      findEdges(std::move(sides[axis]), axis);
    }
  }

  /// Fills the columns for rays that are nowhere displaced by more than `reach`. A box may lie beside the columns by
  /// that much.
  void fill(double reach, float gradientEverywhere)
  {
    const std::size_t layers = edges_[2].size() - 1;
    const std::size_t columns = edges_[0].size() - 1;
    steepest_.assign(columns * (edges_[1].size() - 1) * layers, gradientEverywhere);
    boxes_.forEach(
      [&](const SteepBox& box)
      {
        std::size_t from[3]{}, to[3]{};
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const std::vector<float>& edges = edges_[axis];
          to[axis] = edges.size() - 1;
          if (axis == 2 || areApart_)
          {
            const float wider = axis < 2 ? static_cast<float>(reach) : 0.f;
            const auto low =
              std::upper_bound(edges.begin() + 1, edges.end(), box.low[axis] - wider);
            const auto high =
              std::lower_bound(edges.begin(), edges.end() - 1, box.high[axis] + wider);
            from[axis] = static_cast<std::size_t>(low - edges.begin()) - 1;
            to[axis] = static_cast<std::size_t>(high - edges.begin());
          }
        }
        for (std::size_t row = from[1]; row < to[1]; ++row)
        {
          for (std::size_t column = from[0]; column < to[0]; ++column)
          {
            float* cells = steepest_.data() + (row * columns + column) * layers;
            for (std::size_t layer = from[2]; layer < to[2]; ++layer)
            {
              cells[layer] = std::max(cells[layer], box.gradient);
            }
          }
        }
      });
  }

  /// Calls visit(gradients, depths between them) for each column.
  template <class Visit>
  void forEach(const Visit& visit) const
  {
    const std::size_t layers = edges_[2].size() - 1;
    for (std::size_t at = 0; at < steepest_.size(); at += layers)
    {
      visit(steepest_.data() + at, edges_[2]);
    }
  }

private:
  bool isSeen(const SteepBox& box) const
  {
    const auto isWithin = [&](std::size_t axis)
    {
      return static_cast<double>(box.high[axis]) > ranges_[axis].low &&
        static_cast<double>(box.low[axis]) < ranges_[axis].high;
    };
    return !areApart_ || (isWithin(0) && isWithin(1));
  }

  /// The places between cells along an axis: more where there are more boxes.
  void findEdges(std::vector<float> sides, std::size_t axis)
  {
    const auto low = static_cast<float>(ranges_[axis].low);
    const auto high = static_cast<float>(ranges_[axis].high);
    std::sort(sides.begin(), sides.end());
    std::vector<float>& edges = edges_[axis];
    edges.push_back(low);
    const std::size_t cells = axis == 2 || areApart_ ? maxCells[axis] : 1;
    for (std::size_t n = 1; n < cells && !sides.empty(); ++n)
    {
      const float side = sides[n * sides.size() / cells];
      if (side > edges.back() && side < high)
      {
        edges.push_back(side);
      }
    }
    edges.push_back(high);
  }

  const BoxesAlongLight& boxes_;
  const std::array<Range, 3>& ranges_;
  std::vector<float> edges_[3];
  std::vector<float> steepest_; ///< along w first
  bool areApart_;
};

/// What is across inclined light of its kick at entry.
double bendAtEntry(double largestNu, const Light& light)
{
  const double cosine = light.smallestCosine();
  return light.faces.refract
    ? std::sqrt(std::max(0., 1 - cosine * cosine)) * largestKickAtEntry(largestNu, light)
    : 0;
}

/// What bends a ray more and more along w.
class BendingRay
{
public:
  BendingRay(double largestNu, double cosine, double bendBefore)
    : bend(bendBefore)
    , largest_(1 + largestNu)
    , smallest_((1 - largestNu) * cosine)
    , isCollimated_(cosine == 1)
  {
  }

  /// Where the gradient is at most `gradient` over `depth`. False: it may turn around.
  ///
  /// Crosses a layer. With Q the length of the kicks so far, p.w is at least a - Q, a = (1 - nu) cosine; and, as |p| =
  /// 1 + nu is conserved and kicks along w do not count where the light is along w, sqrt(a^2 - Q^2) for such light.
  /// Over a layer Q grows by S = (1 + nu) |grad nu| depth over p.w, whose least value is that at the layer's end.
  bool cross(double gradient, double depth)
  {
    const double s = largest_ * gradient * depth;
    const double before = bend;
    if (s > 0)
    {
      if (!isCollimated_)
      {
        const double a = smallest_ - before;
        const double discriminant = a * a - 4 * s;
        if (!(a > 0 && discriminant > 0))
        {
          return false;
        }
        bend += 2 * s / (a + std::sqrt(discriminant));
      }
      else if (!kick(s))
      {
        return false;
      }
    }
    const double forward = leastForward(bend);
    displacement += 0.5 * (before + bend) * depth / forward;
    slope = bend / forward;
    withinMedium = s > 0 ? displacement : withinMedium;
    return true;
  }

  double displacement = 0, withinMedium = 0, slope = 0, bend;

private:
  double leastForward(double q) const
  {
    return isCollimated_ ? std::sqrt(smallest_ * smallest_ - q * q) : smallest_ - q;
  }

  /// Solves (Q - Q0) sqrt(a^2 - Q^2) = s for the smaller Q from below, where it is sure to be: by the largest
  /// p.w that is left, again and again. Each Q is less than the one that is sought; a little more than the last
  /// one fulfils the inequality.
  bool kick(double s)
  {
    double q = bend;
    constexpr int most = 40;
    constexpr double margin = 1 + 1e-9;
    for (int n = 0; n < most; ++n)
    {
      const double forward = leastForward(q);
      if (!(smallest_ > 0 && forward > 0))
      {
        return false;
      }
      const double next = bend + s / forward;
      if (next <= q * margin)
      {
        bend = q * margin;
        return leastForward(bend) > 0;
      }
      q = next;
    }
    return false;
  }

  double largest_, smallest_;
  bool isCollimated_;
};

void widen(DisplacementBound& bound, const BendingRay& ray)
{
  bound.displacement = std::max(bound.displacement, ray.displacement);
  bound.withinMedium = std::max(bound.withinMedium, ray.withinMedium);
  bound.slope = std::max(bound.slope, ray.slope);
  bound.bend = std::max(bound.bend, ray.bend);
}

/// Finds the bound in units of the light's length.
DisplacementBound boundOf(const Columns& columns, double largestNu, const Light& light)
{
  const double cosine = light.smallestCosine();
  const double atEntry = bendAtEntry(largestNu, light);
  DisplacementBound bound{ 0, 0, 0, 0 };
  columns.forEach(
    [&](const float* gradients, const std::vector<float>& depths)
    {
      BendingRay ray(largestNu, cosine, atEntry);
      for (std::size_t layer = 0; layer + 1 < depths.size(); ++layer)
      {
        const double depth =
          static_cast<double>(depths[layer + 1]) - static_cast<double>(depths[layer]);
        if (!ray.cross(static_cast<double>(gradients[layer]), depth))
        {
          bound = noBound;
          return;
        }
      }
      widen(bound, ray);
    });
  return bound;
}

} // namespace

double largestKickAtEntry(double largestNu, const Light& light)
{
  if (!light.faces.refract)
  {
    return largestNu;
  }
  // |sqrt(cosine^2 + 2 nu + nu^2) - cosine|, of nu of both signs.
  const double cosine = light.smallestCosine();
  const double square = cosine * cosine;
  const double kick = largestNu * (2 + largestNu);
  const double back = std::min(largestNu * std::max(0., 2 - largestNu), square);
  return std::max(
    kick / (cosine + std::sqrt(square + kick)), back / (cosine + std::sqrt(square - back)));
}

template <class Real>
DisplacementBound boundBySteepest(const Medium<Real>& medium, const Light& light)
{
  const double steepest = length(scaled(medium.slope, light.indexScale));
  const double bend = (1 + medium.largestNu) * steepest;
  const double cosine = light.smallestCosine();
  const double atEntry = bendAtEntry(medium.largestNu, light);
  if (bend == 0 && atEntry == 0)
  {
    return { 0, 0, 0, 0 };
  }
  // The path s after which the ray has advanced by the depth at the latest, for the ray that is inclined most:
  // ((1 - nu) cosine - bend at entry) s - bend s^2 / 2.
  const double forward = (1 - medium.largestNu) * cosine - atEntry;
  const double discriminant = forward * forward - 2 * bend * light.depth;
  if (!(forward > 0) || !(discriminant > 0))
  {
    return noBound;
  }
  const double path = 2 * light.depth / (forward + std::sqrt(discriminant));
  const double displacement = (atEntry + 0.5 * bend * path) * path * light.unit / cosine;
  const double all = atEntry + bend * path;
  return { displacement, displacement, all / ((forward - bend * path) * cosine), all };
}

template <class Real>
DisplacementBound boundDisplacement(const Medium<Real>& medium, const Light& light,
  const View& view, double stepVoxels, double atLeast)
{
  const DisplacementBound simple = boundBySteepest(medium, light);
  const double cosine = light.smallestCosine();
  const bool isCollimated = cosine == 1;
  if (medium.slopes.empty() || simple.bend == 0)
  {
    return simple;
  }
  const double pixel = length(scaled(light.unitsPerIndex, light.perColumn));
  const auto margin = static_cast<double>(maxMargin(view)) + 1;
  const std::array<Range, 3> ranges{ { { -margin * pixel, (view.width - 1 + margin) * pixel },
    { -margin * pixel, (view.height - 1 + margin) * pixel }, { 0, light.depth } } };
  const bool isOfLayer = medium.tree && medium.tree->shape() == BrickShape::Layer;
  const BoxesAlongLight boxes(
    medium.slopes, light, stepVoxels, isOfLayer ? medium.view().last.z : 0);
  const auto ofAxis = [&](double most) { return static_cast<float>(std::min(atLeast, most)); };
  const SlopeBlock any{ {}, 0,
    { ofAxis(medium.slope.x), ofAxis(medium.slope.y), ofAxis(medium.slope.z) } };
  const float everywhere = boxes.boxOf(any).gradient;
  Columns columns(boxes, ranges, isCollimated);
  DisplacementBound bound = noBound;
  constexpr double ofView = 0.004; // a fifth of a column, as a first guess
  double reach = ofView * pixel * std::min(view.width, view.height);
  constexpr int maxAttempts = 8;
  for (int attempt = 0; attempt < maxAttempts; ++attempt)
  {
    columns.fill(reach, everywhere);
    const DisplacementBound found = boundOf(columns, medium.largestNu, light);
    if (!isCollimated || found.displacement <= reach)
    {
      bound = found;
      break;
    }
    constexpr double more = 1.1;
    reach = more * found.displacement;
    if (!std::isfinite(reach))
    {
      break;
    }
  }
  constexpr double rounding = 1 + 1e-6;
  const double perSlope = rounding / cosine;
  return { std::min(simple.displacement, bound.displacement * light.unit * perSlope),
    std::min(simple.withinMedium, bound.withinMedium * light.unit * perSlope),
    std::min(simple.slope, bound.slope * perSlope), std::min(simple.bend, bound.bend * rounding) };
}

template DisplacementBound boundBySteepest(const Medium<float>&, const Light&);
template DisplacementBound boundBySteepest(const Medium<double>&, const Light&);
template DisplacementBound boundDisplacement(
  const Medium<float>&, const Light&, const View&, double, double);
template DisplacementBound boundDisplacement(
  const Medium<double>&, const Light&, const View&, double, double);

} // namespace schlieren
