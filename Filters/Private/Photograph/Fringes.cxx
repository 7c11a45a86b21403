// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photograph/Fringes.h"

#include "vtkMath.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <complex>

namespace filters
{

namespace
{

constexpr int mostBlocks = 200;

double tiltOf(Eigen::Index index, Eigen::Index count)
{
  return vtkMath::Pi() / 2 * static_cast<double>(index - count / 2);
}

/// Returns exp(-i tilt x) of each tilt, by rows, and each block, by columns.
Eigen::MatrixXcd wavesOf(int blocks, int factor, int points)
{
  Eigen::MatrixXcd waves(2 * (blocks / 2) + 1, blocks);
  for (Eigen::Index block = 0; block < blocks; ++block)
  {
    const double place = coordinate((static_cast<double>(block) + 0.5) * factor - 0.5, points);
    for (Eigen::Index tilt = 0; tilt < waves.rows(); ++tilt)
    {
      waves(tilt, block) = std::polar(1., -tiltOf(tilt, waves.rows()) * place);
    }
  }
  return waves;
}

/// Returns contrast / 2 and phase, as a complex number, of the fringes of each tilt, by rows those along columns.
Eigen::MatrixXcd fringesOfTilts(const Plane& light, const Plane& weight, const Plane& turns)
{
  double sum = 0, count = 1e-9;
  for (std::size_t i = 0; i < light.size(); ++i)
  {
    count += weight.values[i] > 0 ? 1 : 0;
    sum += weight.values[i] > 0 ? light.values[i] : 0;
  }
  const double mean = std::max(sum / count, 1e-6);
  Plane real(light.columns, light.rows), imaginary = real;
  for (std::size_t i = 0; i < light.size(); ++i)
  {
    if (weight.values[i] > 0)
    {
      const double phase = turns.values.empty() ? 0 : 2 * vtkMath::Pi() * turns.values[i];
      const double change = light.values[i] / mean - 1;
      real.values[i] = static_cast<float>(change * std::cos(phase));
      imaginary.values[i] = static_cast<float>(-change * std::sin(phase));
    }
  }
  const int factor = 1 + (std::max(light.columns, light.rows) - 1) / mostBlocks;
  real = shrunk(real, factor);
  imaginary = shrunk(imaginary, factor);
  using Rows =
    Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
  Eigen::MatrixXcd blocks(real.rows, real.columns);
  blocks.real() = Rows(real.values.data(), real.rows, real.columns).cast<double>();
  blocks.imag() = Rows(imaginary.values.data(), real.rows, real.columns).cast<double>();
  return wavesOf(real.rows, factor, light.rows) *
    (blocks * wavesOf(real.columns, factor, light.columns).transpose()) * (factor * factor / count);
}

} // namespace

std::array<Fringes, 2> findFringes(
  const Plane& light, const Plane& weight, const Plane& turns, const Plane& withoutFlow)
{
  const Eigen::MatrixXcd own = fringesOfTilts(light, weight, turns);
  Eigen::MatrixXd power = own.cwiseAbs2();
  if (!withoutFlow.values.empty())
  {
    power += fringesOfTilts(withoutFlow, weight, Plane()).cwiseAbs2();
  }
  Eigen::Index row = 0, column = 0;
  power.maxCoeff(&row, &column);
  const auto at = [&](Eigen::Index r, Eigen::Index c)
  {
    return Fringes{ 2 * std::abs(own(r, c)), std::arg(own(r, c)),
      { tiltOf(c, own.cols()), tiltOf(r, own.rows()) } };
  };
  return { at(row, column), at(own.rows() - 1 - row, own.cols() - 1 - column) };
}

} // namespace filters
