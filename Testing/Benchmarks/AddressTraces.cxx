// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the loads of a GPU's warp would meet: lines of 128 bytes, of which its cache looks up a few in a cycle, and sectors
// of 32, which it gets from memory. Counted on the CPU from where undisturbed rays are, for the places in memory that
// the medium really has and for others. Quadratic; 512^2 rays. And the error of deflections if samples had 16 bits,
// scaled to the range of each brick. Prints tables.
#include "MeasuredTrees.h"
#include "Rays/Cpu/CpuTracer.h"
#include "Rays/March/MakeTask.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <vector>

namespace
{

using namespace schlieren;

constexpr int points = QuadraticInterpolation::points;
constexpr int pixels = 512; // along each side of the image

/// The corner of the samples that a place needs: of which brick, and where in it, counted from its first ghost point.
struct Corner
{
  std::int64_t first; ///< sample of the brick
  std::int64_t at[3];
};

/// How samples of a brick follow each other.
struct Layout
{
  const char* name;
  int tile[3]; ///< samples side by side; 1: rows
  int bytes;   ///< of a sample
};

std::int64_t byteOf(
  const Layout& layout, const MediumView<float>& view, const Corner& corner, const int (&step)[3])
{
  const std::int64_t edge[3] = { view.rowStride, view.planeStride / view.rowStride,
    view.brickStride > 0 ? view.brickStride / view.planeStride : 1 };
  std::int64_t tiles[3], tile[3], inside[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const int size = layout.tile[axis];
    const std::int64_t at = corner.at[axis] + step[axis];
    tiles[axis] = (edge[axis] + size - 1) / size;
    tile[axis] = at / size;
    inside[axis] = at % size;
  }
  const std::int64_t perTile = std::int64_t{ layout.tile[0] } * layout.tile[1] * layout.tile[2];
  const std::int64_t brick =
    view.brickStride > 0 ? corner.first / view.brickStride * tiles[0] * tiles[1] * tiles[2] : 0;
  const std::int64_t number = brick + (tile[2] * tiles[1] + tile[1]) * tiles[0] + tile[0];
  return layout.bytes *
    (number * perTile + (inside[2] * layout.tile[1] + inside[1]) * layout.tile[0] + inside[0]);
}

struct Ray
{
  Vec3<double> start, along; ///< index coordinates, and those of a unit of length
  double length, end;        ///< where it is, and where it leaves the domain
  double perVoxel;           ///< length of a unit of the index coordinates
};

Ray rayOf(const MediumView<float>& view, const Light& light, int column, int row)
{
  Ray ray{ light.start(column, row), light.perLength, 0, light.depth, 0 };
  const double start[3] = { ray.start.x, ray.start.y, ray.start.z };
  const double along[3] = { ray.along.x, ray.along.y, ray.along.z };
  const double last[3] = { view.last.x, view.last.y, view.last.z };
  for (int axis = 0; axis < 3; ++axis)
  {
    if (along[axis] != 0)
    {
      const double a = -start[axis] / along[axis], b = (last[axis] - start[axis]) / along[axis];
      ray.length = std::max(ray.length, std::min(a, b));
      ray.end = std::min(ray.end, std::max(a, b));
    }
  }
  ray.perVoxel = 1 / std::sqrt(dot(ray.along, ray.along));
  return ray;
}

/// Takes a step of so many voxels. Adds what samples its middle needs, if any.
void take(const MediumView<float>& view, double voxels, Ray& ray, std::vector<Corner>& corners)
{
  const auto placeAt = [&](double length) { return ray.start + length * ray.along; };
  const Leaf<float> image{ { 0, 0, 0 }, 1, 0, 0, 0, Leaf<float>::Samples };
  const auto leafAt = [&](double length) -> const Leaf<float>&
  { return view.leaves != nullptr ? view.leaves[view.finder.at(placeAt(length))] : image; };
  const double step = voxels * ray.perVoxel / leafAt(ray.length).perIndex;
  const double middle = ray.length + 0.5 * step;
  const Leaf<float>& leaf = leafAt(middle);
  ray.length += step;
  if (leaf.kind == Leaf<float>::Constant || leaf.kind == Leaf<float>::Solid || middle >= ray.end)
  {
    return;
  }
  const Vec3<double> place = placeAt(middle);
  const double index[3] = { place.x, place.y, place.z };
  Corner corner{ leaf.brick * view.brickStride, {} };
  for (int axis = 0; axis < 3; ++axis)
  {
    // The lower neighbour of the nearest sample; ghosts begin at -1.
    corner.at[axis] =
      std::max(std::int64_t{ 0 }, std::int64_t{ std::lround(leaf.toLocal(axis, index[axis])) });
  }
  corners.push_back(corner);
}

template <std::size_t Size>
std::size_t different(std::array<std::int64_t, Size> numbers, std::size_t count)
{
  const auto end = numbers.begin() + static_cast<std::ptrdiff_t>(count);
  std::sort(numbers.begin(), end);
  return static_cast<std::size_t>(std::unique(numbers.begin(), end) - numbers.begin());
}

/// What a load meets, on average.
struct Count
{
  double lines = 0, sectors = 0;
};

/// Of warps of so many columns and rows of pixels.
Count count(const MediumView<float>& view, const Light& light, double voxels, const Layout& layout,
  int columns, int rows)
{
  constexpr int apart = 149; // warps that are looked at
  constexpr std::size_t lanes = 32;
  Count sum;
  double loads = 0;
  for (int warp = 0; warp < pixels * pixels / (columns * rows); warp += apart)
  {
    const int along = pixels / columns;
    std::vector<Ray> rays;
    for (int lane = 0; lane < columns * rows; ++lane)
    {
      rays.push_back(rayOf(view, light, warp % along * columns + lane % columns,
        warp / along * rows + lane / columns));
    }
    const auto isUnderWay = [](const Ray& ray) { return ray.length < ray.end; };
    while (std::any_of(rays.begin(), rays.end(), isUnderWay))
    {
      std::vector<Corner> corners;
      for (Ray& ray : rays)
      {
        if (isUnderWay(ray))
        {
          take(view, voxels, ray, corners);
        }
      }
      for (int load = 0; load < points * points * points && !corners.empty(); ++load)
      {
        const int step[3] = { load % points, load / points % points, load / (points * points) };
        std::array<std::int64_t, lanes> lines{}, sectors{};
        for (std::size_t i = 0; i < corners.size(); ++i)
        {
          const std::int64_t byte = byteOf(layout, view, corners[i], step);
          lines[i] = byte / 128;
          sectors[i] = byte / 32;
        }
        sum.lines += static_cast<double>(different(lines, corners.size()));
        sum.sectors += static_cast<double>(different(sectors, corners.size()));
        ++loads;
      }
    }
  }
  return { sum.lines / loads, sum.sectors / loads };
}

Light lightOf(const Grid& grid, const Vector& direction, double scale)
{
  View view;
  view.viewDirection = direction;
  view.parallelScale = scale;
  view.width = view.height = pixels;
  return collimatedLight(grid, frameOf(grid, view));
}

/// `scale`: half the height of the image; 0: all is seen.
void countAll(const char* name, const MediumView<float>& view, const Grid& grid, double scale)
{
  const Layout rows{ "rows", { 1, 1, 1 }, 4 };
  const std::vector<Layout> others = { { "tiles of 2 x 2 x 2", { 2, 2, 2 }, 4 },
    { "tiles of 4 x 4 x 2", { 4, 4, 2 }, 4 }, { "rows of 16 bits", { 1, 1, 1 }, 2 } };
  const auto print = [&](const Layout& layout, int columns, int height, double voxels)
  {
    std::printf("| %s | %s | %d x %d | %g |", name, layout.name, columns, height, voxels);
    for (const Direction& direction : directions)
    {
      const Count found =
        count(view, lightOf(grid, direction.view, scale), voxels, layout, columns, height);
      std::printf(" %.1f / %.1f |", found.lines, found.sectors);
    }
    std::puts("");
    std::fflush(stdout);
  };
  print(rows, 32, 1, 1);
  print(rows, 8, 4, 1);
  print(rows, 8, 4, 2);
  for (const Layout& layout : view.leaves != nullptr ? others : std::vector<Layout>{})
  {
    print(layout, 8, 4, 1);
  }
}

/// The samples of each brick as whole numbers of 16 bits times a factor of its own.
std::vector<float> in16Bits(const MediumTree<float>& tree, std::int64_t brickSize)
{
  std::vector<float> samples(tree.samples().begin(), tree.samples().end());
  const auto size = static_cast<std::size_t>(brickSize);
  for (std::size_t first = 0; first + size <= samples.size(); first += size)
  {
    const auto begin = samples.begin() + static_cast<std::ptrdiff_t>(first);
    const auto [low, high] = std::minmax_element(begin, begin + brickSize);
    const double least = *low, step = (static_cast<double>(*high) - least) / 65535;
    for (std::size_t i = first; i < first + size && step > 0; ++i)
    {
      samples[i] = static_cast<float>(least + step * std::round((samples[i] - least) / step));
    }
  }
  return samples;
}

void measure16Bits(const char* name, const Medium<float>& medium, double scale)
{
  for (const Direction& direction : { directions[0], directions[2] })
  {
    const Pass pass{ 0, 0, pixels, pixels, { 0, 0 } };
    RayTask<float> task = makeTask<float>(medium, nullptr, FieldGradientsView{},
      lightOf(medium.tree->grid(), direction.view, scale), RaySettings{});
    TracedPass exact, rounded;
    exact.resize(pass, 0);
    rounded.resize(pass, 0);
    traceOnCpu(task, pass, exact, 0, {});
    const std::vector<float> samples = in16Bits(*medium.tree, task.medium.brickStride);
    task.medium.samples = samples.data() + (task.medium.samples - medium.tree->samples().data());
    traceOnCpu(task, pass, rounded, 0, {});
    double largest = 0, worst = 0, squares = 0;
    for (std::size_t ray = 0; ray < exact.exits.size(); ++ray)
    {
      const auto& a = exact.exits[ray].deflection;
      const auto& b = rounded.exits[ray].deflection;
      const double error = std::hypot(a[0] - b[0], a[1] - b[1]);
      largest = std::max(largest, std::hypot(a[0], a[1]));
      worst = std::max(worst, error);
      squares += error * error;
    }
    std::printf("| %s | %s | %.2g | %.2g |\n", name, direction.name,
      std::sqrt(squares / static_cast<double>(exact.exits.size())) / largest, worst / largest);
  }
}

} // namespace

int main()
{
  const auto waves = std::make_shared<WavesSource>();
  constexpr std::int64_t edge = 256;
  const double voxel = 2. / edge;
  const Medium<float> tree = treeOf(waves, 0, everything({ 1, 0, 0 }, { 0, 1, 0 }, voxel));
  const std::vector<float> zeros(edge * edge * edge); // where samples are does not depend on them
  Field field;
  field.grid.dimensions = { edge, edge, edge };
  field.grid.spacing = { voxel, voxel, voxel };
  field.grid.origin = { 0.5 * voxel - 1, 0.5 * voxel - 1, 0.5 * voxel - 1 };
  field.singles = zeros.data();
  field.ambient = 0;
  const Medium<float> image = buildMedium<float>(field, Interpolation::Quadratic, 0);
  const auto shock = std::make_shared<BowShockSource>();
  constexpr double shockScale = 3;
  const Medium<float> farField =
    treeOf(shock, 0.01, everything({ 1, 0, 0 }, { 0, 1, 0 }, 2 * shockScale / pixels));

  std::puts("Lines of 128 bytes / sectors of 32 bytes by load of a warp");
  std::puts("| medium | samples | warp | step | along z | along x | oblique | diagonal |");
  std::puts("|---|---|---|---|---|---|---|---|");
  countAll("256^3 points, a grid", image.view(), field.grid, 0);
  countAll("256^3 points, bricks", tree.view(), tree.tree->grid(), 0);
  countAll("far field, bricks", farField.view(), farField.tree->grid(), shockScale);

  std::puts("\nSamples of 16 bits, scaled to the range of each brick: error of deflection by the "
            "largest one");
  std::puts("| medium | view | rms | worst |");
  std::puts("|---|---|---|---|");
  measure16Bits("256^3 points, bricks", tree, 0);
  measure16Bits("far field, bricks", farField, shockScale);
  return 0;
}
