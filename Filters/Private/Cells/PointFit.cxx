// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/PointFit.h"

#include "vtk_eigen.h"
#include VTK_EIGEN(Dense)

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace filters
{

namespace
{

/// Added to the matrix for second derivatives, in parts of their mean: where points are too few they are
/// small.
constexpr double leastSecond = 1e-5;
/// Added for first derivatives, for points in a plane or on a line.
constexpr double leastFirst = 1e-12;
/// Both for those of means: what first and second derivatives explain nearly alike, as at the boundary, is taken for a
/// first one.
constexpr double leastSecondOfMeans = 1e-2;
constexpr double leastFirstOfMeans = 1e-6;
/// Means have nothing to be compared with along directions in which their places are spread by less than this part of
/// their size, squared.
constexpr double flat = 0.01;
/// Added to squared distances, relative to their mean, so that weights are finite.
constexpr double leastSquare = 1e-6;

constexpr std::size_t fewest = 3; // neighbours

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Terms = Eigen::Matrix<double, 9, 1>; // three first derivatives, six second ones

Vector3d vectorOf(const double* x) { return { x[0], x[1], x[2] }; }

/// Of second moments xx, yy, zz, xy, yz, zx.
Matrix3d matrixOf(const double* s)
{
  Matrix3d matrix;
  matrix << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return matrix;
}

/// First and second moments in other units.
Terms termsOf(const Vector3d& y, const Matrix3d& second)
{
  Terms terms;
  terms << y, second(0, 0), second(1, 1), second(2, 2), second(0, 1), second(1, 2), second(2, 0);
  return terms;
}

} // namespace

void PointFit::find()
{
  this->gradient = {};
  this->correction = this->unfit = this->lowest = this->highest = 0;
  Matrix3d spread = Matrix3d::Zero();
  for (const Neighbour& neighbour : this->neighbours)
  {
    this->lowest = std::min(this->lowest, neighbour.value);
    this->highest = std::max(this->highest, neighbour.value);
    const Vector3d x = vectorOf(neighbour.x.data());
    spread += x * x.transpose();
  }
  if (this->neighbours.size() < fewest)
  {
    return;
  }
  const bool ofMeans = this->values == Values::Means;
  const double least = leastFirst * spread.trace();
  spread /= static_cast<double>(this->neighbours.size());
  const Vector3d ownFirst = vectorOf(this->own.data());
  const Matrix3d ownSecond = matrixOf(this->own.data() + 3);

  // Places in units of L, with L * transposed(L) = the mean of x * transposed(x), are as far along every axis. Of means
  // with the size of what the mean is over: where all have the same place along an axis, that is its unit.
  Matrix3d size = spread + least * Matrix3d::Identity();
  if (ofMeans)
  {
    size += ownSecond - ownFirst * ownFirst.transpose();
  }
  const Eigen::LLT<Matrix3d> root(size);
  if (root.info() != Eigen::Success)
  {
    return;
  }
  Matrix3d toUnits = root.matrixL().solve(Matrix3d::Identity());
  if (ofMeans)
  {
    // Along directions in which places lie as close together as nothing else is to be compared with, as those of one layer
    // of cells do, units become so large that nothing is found there.
    const Matrix3d places = toUnits * spread * toUnits.transpose() + flat * Matrix3d::Identity();
    toUnits -= flat * places.inverse() * toUnits;
  }

  Eigen::Matrix<double, 9, 9> matrix = Eigen::Matrix<double, 9, 9>::Zero();
  Terms right = Terms::Zero();
  double all = 0;
  for (const Neighbour& neighbour : this->neighbours)
  {
    const Vector3d y = toUnits * vectorOf(neighbour.x.data());
    const Terms terms = termsOf(y,
      ofMeans ? Matrix3d(toUnits * matrixOf(neighbour.second.data()) * toUnits.transpose())
              : Matrix3d(y * y.transpose()));
    const double weight = 1 / (y.squaredNorm() + leastSquare);
    const Terms weighted = weight * terms;
    for (Eigen::Index column = 0; column < matrix.cols();
         ++column) // which Eigen's own product is slower than
    {
      matrix.col(column) += terms[column] * weighted;
    }
    right += neighbour.value * weighted;
    all += weight * neighbour.value * neighbour.value;
  }
  const double ofFirst = matrix.diagonal().head<3>().sum();
  const double ofSecond = matrix.diagonal().tail<6>().sum();
  matrix.diagonal().head<3>().array() += (ofMeans ? leastFirstOfMeans : leastFirst) * ofFirst;
  matrix.diagonal().tail<6>().array() +=
    (ofMeans ? leastSecondOfMeans : leastSecond) / 6 * ofSecond;
  const Eigen::LLT<Eigen::Matrix<double, 9, 9>> factors(matrix);
  if (factors.info() != Eigen::Success)
  {
    return;
  }
  const Terms found = factors.solve(right);
  const Vector3d slope = toUnits.transpose() * found.head<3>();
  const double change = ofMeans
    ? -found.dot(termsOf(toUnits * ownFirst, toUnits * ownSecond * toUnits.transpose()))
    : 0;
  // What is left of the squares: for the best fit, all that the right side does not take away.
  this->unfit = (all - found.dot(right)) / (all > 0 ? all : 1);
  if (std::isfinite(slope.sum() + change))
  {
    this->gradient = { slope[0], slope[1], slope[2] };
    this->correction = change;
  }
}

} // namespace filters
