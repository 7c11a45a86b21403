// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Wavefront/BeamQuality.h"

#include "Wavefront/Zernike.h"

#include "vtkMath.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>
#include <string>

namespace filters
{

namespace
{

/// A pixel of the aperture; x and y are 1 at the unit circle.
struct Sample
{
  std::size_t pixel;
  int column, row;
  double x, y;
};

/// The radius of the unit circle, pixels.
double circleOf(const Aperture& aperture)
{
  return aperture.diameter * (aperture.shape == ApertureShape::Round ? 0.5 : std::sqrt(0.5));
}

std::vector<Sample> samplesOf(const Aperture& aperture, int columns, int rows)
{
  const double circle = circleOf(aperture);
  std::vector<Sample> samples;
  std::size_t pixel = 0;
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column, ++pixel)
    {
      if (aperture.has(column, row))
      {
        samples.push_back({ pixel, column, row, (column - aperture.column) / circle,
          (row - aperture.row) / circle });
      }
    }
  }
  return samples;
}

/// Returns the coefficients of the first terms that are closest to the path. The polynomials are nearly orthogonal, so
/// that the normal equations are as good as the others, of which there is one for each pixel.
Eigen::VectorXd fitted(
  const std::vector<double>& path, const std::vector<Sample>& samples, int terms)
{
  std::vector<Zernike> polynomials;
  for (int number = 1; number <= terms; ++number)
  {
    polynomials.emplace_back(number);
  }
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(terms, terms);
  Eigen::VectorXd withPath = Eigen::VectorXd::Zero(terms), values(terms);
  for (const Sample& sample : samples)
  {
    for (int term = 0; term < terms; ++term)
    {
      values[term] = polynomials[static_cast<std::size_t>(term)](sample.x, sample.y);
    }
    products.selfadjointView<Eigen::Lower>().rankUpdate(values);
    withPath += path[sample.pixel] * values;
  }
  const Eigen::MatrixXd whole = products.selfadjointView<Eigen::Lower>();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(whole);
  constexpr double leastPivot = 1e-9; // of the largest; rounding leaves 1e-15
  solver.setThreshold(leastPivot);
  if (solver.rank() < terms)
  {
    throw std::runtime_error("The aperture has too few pixels (" + std::to_string(samples.size()) +
      ") for " + std::to_string(terms) +
      " Zernike terms. Choose a larger ApertureDiameter, fewer ZernikeTerms, or an image of more "
      "pixels.");
  }
  return solver.solve(withPath);
}

/// Returns the squared modulus of the pupil's Fourier transform, sum of pupil exp(-2 pi i (f column + g row)), at `points` x
/// `points` frequencies around a middle. A product of matrices has as fine a grid as is wanted where it is wanted
/// (Soummer, Pueyo, Sivaramakrishnan and Vanderbei, Opt. Express 15, 15935, 2007, equation 12).
Eigen::MatrixXd farField(
  const Eigen::MatrixXcd& pupil, const std::array<double, 2>& middle, double step, int points)
{
  const auto kernel = [&](double of, Eigen::Index length)
  {
    Eigen::MatrixXcd waves(points, length);
    for (Eigen::Index at = 0; at < length; ++at)
    {
      for (int point = 0; point < points; ++point)
      {
        const double frequency = of + (point - points / 2) * step;
        waves(point, at) = std::polar(1., -2 * vtkMath::Pi() * frequency * static_cast<double>(at));
      }
    }
    return waves;
  };
  return (kernel(middle[1], pupil.rows()) * pupil * kernel(middle[0], pupil.cols()).transpose())
    .cwiseAbs2();
}

/// Returns the largest value of the far field between its points.
double peakOf(const Eigen::MatrixXcd& pupil, const Eigen::MatrixXd& field, double step)
{
  constexpr int levels = 4, finer = 4;
  std::array<double, 2> middle{};
  Eigen::Index row = 0, column = 0;
  double peak = field.maxCoeff(&row, &column);
  auto half = static_cast<double>(farFieldPoints / 2);
  for (int level = 0; level < levels; ++level)
  {
    middle[0] += (static_cast<double>(column) - half) * step;
    middle[1] += (static_cast<double>(row) - half) * step;
    step /= finer;
    half = finer;
    peak = farField(pupil, middle, step, 2 * finer + 1).maxCoeff(&row, &column);
  }
  return peak;
}

/// Fractions of the energy within circles, whose radii are 0, 1 and so on steps.
class Encircled
{
public:
  Encircled(const Eigen::MatrixXd& field, double step, double all)
  {
    constexpr int half = farFieldPoints / 2;
    // The part of a point's square within a circle, as if the circle were straight.
    const auto within = [](double radius, double distance)
    { return std::clamp(radius - distance + 0.5, 0., 1.); };
    this->Fractions.assign(half + 1, 0);
    for (int row = 0; row < farFieldPoints; ++row)
    {
      for (int column = 0; column < farFieldPoints; ++column)
      {
        const double distance = std::hypot(row - half, column - half);
        const double energy = field(row, column) * step * step / all;
        for (int radius = std::max(0, static_cast<int>(distance) - 1); radius <= half; ++radius)
        {
          this->Fractions[static_cast<std::size_t>(radius)] += energy * within(radius, distance);
        }
      }
    }
    this->Fractions[0] = 0; // not the part of the square in the middle
  }

  double largest() const { return this->Fractions.back(); }

  /// NaN beyond the last circle.
  double operator()(double steps) const
  {
    const auto before = static_cast<std::size_t>(steps);
    if (before + 1 >= this->Fractions.size())
    {
      return before < this->Fractions.size() && steps == static_cast<double>(before)
        ? this->Fractions[before]
        : std::numeric_limits<double>::quiet_NaN();
    }
    const double part = steps - static_cast<double>(before);
    return (1 - part) * this->Fractions[before] + part * this->Fractions[before + 1];
  }

private:
  std::vector<double> Fractions;
};

void findFarField(BeamQuality& found, const std::vector<Sample>& samples, const Aperture& aperture,
  const BeamSettings& settings)
{
  int low[2] = { samples[0].column, samples[0].row }, high[2] = { low[0], low[1] };
  for (const Sample& sample : samples)
  {
    low[0] = std::min(low[0], sample.column);
    high[0] = std::max(high[0], sample.column);
    high[1] = std::max(high[1], sample.row);
  }
  Eigen::MatrixXcd pupil = Eigen::MatrixXcd::Zero(high[1] - low[1] + 1, high[0] - low[0] + 1);
  for (const Sample& sample : samples)
  {
    pupil(sample.row - low[1], sample.column - low[0]) =
      std::polar(1., 2 * vtkMath::Pi() * found.residual[sample.pixel] / settings.wavelength);
  }

  // As fine as the Airy pattern can be seen, over 16 of its widths; coarser and wider where that does not hold the light.
  // Frequencies are per pixel, of which all there are lie between -1/2 and 1/2.
  constexpr double pointsPerWidth = 8, mostBeyond = 0.05;
  constexpr int coarsest = 4;
  const double count = found.pixels;
  const double all = 1. / farFieldPoints,
               finest = std::min(1 / (pointsPerWidth * aperture.diameter), all);
  double step = finest;
  Eigen::MatrixXd field = farField(pupil, {}, step, farFieldPoints);
  Encircled energy(field, step, count);
  while (energy.largest() < 1 - mostBeyond && step < std::min(coarsest * finest, all))
  {
    step = std::min(2 * step, all);
    field = farField(pupil, {}, step, farFieldPoints);
    energy = Encircled(field, step, count);
  }
  found.strehl = peakOf(pupil, field, step) / (count * count);
  constexpr double firstDarkRing = 1.2196698912665045; // of Airy's pattern: zero of J1 over pi
  found.energyWithinAiry = energy(firstDarkRing / (aperture.diameter * step));
  found.angle = step * settings.wavelength / settings.metresPerPixel;
  for (int row = 0; row < farFieldPoints; ++row)
  {
    for (int column = 0; column < farFieldPoints; ++column)
    {
      constexpr int half = farFieldPoints / 2;
      found.pointSpread.push_back(field(row, column) / (count * count));
      found.energy.push_back(energy(std::hypot(row - half, column - half)));
    }
  }
}

} // namespace

BeamQuality qualityOf(const std::vector<double>& path, int columns, const Aperture& aperture,
  const BeamSettings& settings)
{
  const std::vector<Sample> samples =
    samplesOf(aperture, columns, static_cast<int>(path.size()) / columns);
  BeamQuality found;
  const Eigen::VectorXd zernike = fitted(path, samples, settings.zernikeTerms);
  found.zernike.assign(zernike.begin(), zernike.end());

  // Noll's 1 to 3 are piston and tilt, 4 is focus.
  const Eigen::VectorXd removed = fitted(path, samples, settings.removesFocus ? 4 : 3);
  const std::array<Zernike, 4> polynomials{ Zernike(1), Zernike(2), Zernike(3), Zernike(4) };
  const double perTilt = polynomials[1](1, 0) / (circleOf(aperture) * settings.metresPerPixel);
  found.tilt = { removed[1] * perTilt, removed[2] * perTilt };
  found.residual.assign(path.size(), std::numeric_limits<double>::quiet_NaN());
  double squares = 0, lowest = HUGE_VAL, highest = -HUGE_VAL;
  for (const Sample& sample : samples)
  {
    double value = path[sample.pixel];
    for (Eigen::Index term = 0; term < removed.size(); ++term)
    {
      value -= removed[term] * polynomials[static_cast<std::size_t>(term)](sample.x, sample.y);
    }
    found.residual[sample.pixel] = value;
    squares += value * value;
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  found.pixels = static_cast<double>(samples.size());
  found.rms = std::sqrt(squares / found.pixels);
  found.peakToValley = highest - lowest;
  const double phase = 2 * vtkMath::Pi() * found.rms / settings.wavelength;
  found.marechal = std::exp(-phase * phase);
  findFarField(found, samples, aperture, settings);
  return found;
}

} // namespace filters
