// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Medium.h"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace schlieren
{

template <class Real>
Medium<Real> buildTree(const Field& field, const TreeSettings& settings)
{
  const double ambient = field.ambient ? *field.ambient : field.source->ambient();
  Medium<Real> medium{ PaddedVolume<Real>({ 1, 1, 1 }), {},
    std::make_unique<MediumTree<Real>>(field.source, ambient, settings) };
  medium.ambient = ambient;
  return medium;
}

namespace
{

template <class Real>
void summarize(Medium<Real>& medium)
{
  const MediumTree<Real>& tree = *medium.tree;
  medium.largestN = tree.largestN();
  medium.rangeOfNu = tree.rangeOfNu();
  medium.largestNu = tree.largestNu();
  medium.slope = tree.slope();
  medium.steepest = tree.steepest();
}

} // namespace

template <class Real>
bool refine(Medium<Real>& medium, const Column& column, const Monitor& monitor, Unneeded ofOthers)
{
  const bool hasChanged = medium.tree->refine(column, monitor, ofOthers);
  summarize(medium);
  return hasChanged;
}

template <class Real>
Medium<Real> copyOf(const Medium<Real>& medium)
{
  Medium<Real> copy{ PaddedVolume<Real>({ 1, 1, 1 }), {},
    std::make_unique<MediumTree<Real>>(*medium.tree) };
  copy.ambient = medium.ambient;
  summarize(copy);
  return copy;
}

template <class Real>
Medium<Real> finerIn(
  Medium<Real> medium, double tolerance, std::vector<Column::Part> parts, const Monitor& monitor)
{
  medium.tree->refineFurther(tolerance, std::move(parts), monitor);
  summarize(medium);
  return medium;
}

namespace
{

template <class Real>
MediumView<Real> viewOf(const MediumTree<Real>& tree)
{
  const Real* samples = tree.samples().data();
  MediumView<Real> view =
    viewOfBricks(samples, MediumTree<Real>::brickEdge, tree.apron(), tree.shape());
  const std::array<std::int64_t, 3>& points = tree.grid().dimensions;
  view.last = { static_cast<double>(points[0] - 1), static_cast<double>(points[1] - 1),
    static_cast<double>(points[2] - 1) };
  view.leaves = tree.leaves().data();
  view.finder = tree.finder();
  view.gasDistances =
    tree.gasDistances().empty() ? nullptr : tree.gasDistances().data() + (view.samples - samples);
  return view;
}

} // namespace

template <class Real>
MediumView<Real> Medium<Real>::view() const
{
  if (tree)
  {
    return viewOf(*tree);
  }
  const auto lastOf = [this](std::size_t axis)
  { return static_cast<double>(volume.dimensions[axis] - 1); };
  const Vec3<double> last = { lastOf(0), lastOf(1), lastOf(2) };
  MediumView<Real> view{ volume.samples.data(), volume.strides[1], volume.strides[2], { 0, 0, 0 },
    static_cast<Vec3<Real>>(last), last };
  view.solid = solid.empty() ? nullptr : solid.data();
  return view;
}

template Medium<float> buildTree(const Field&, const TreeSettings&);
template Medium<double> buildTree(const Field&, const TreeSettings&);
template bool refine(Medium<float>&, const Column&, const Monitor&, Unneeded);
template bool refine(Medium<double>&, const Column&, const Monitor&, Unneeded);
template Medium<float> copyOf(const Medium<float>&);
template Medium<double> copyOf(const Medium<double>&);
template Medium<float> finerIn(Medium<float>, double, std::vector<Column::Part>, const Monitor&);
template Medium<double> finerIn(Medium<double>, double, std::vector<Column::Part>, const Monitor&);
template struct Medium<float>;
template struct Medium<double>;

} // namespace schlieren
