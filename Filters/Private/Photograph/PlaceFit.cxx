// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photograph/PlaceFit.h"

#include <unsupported/Eigen/NonLinearOptimization>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace filters
{

namespace
{

using Vector = Eigen::VectorXd;

constexpr double robustScale = 0.1;

struct Sample
{
  Point2 place; // in the photograph
  double value;
};

/// Residuals and their derivatives, as Eigen's LevenbergMarquardt takes them. The unknowns: position to the right and up in
/// points of the image, rotation in radians, ln of the scale.
class Residuals
{
public:
  Residuals(const Place& start, FreePlace free, const std::vector<Sample>& samples,
    const Plane& image, const Grid& ofImage)
    : Start(start)
    , Free(free)
    , Samples(samples)
    , Gradient(gradientOf(image))
    , Image(image)
    , Right(this->Gradient.first)
    , Up(this->Gradient.second)
    , OfImage(ofImage)
  {
  }

  int inputs() const { return this->Free == FreePlace::ScaleToo ? 4 : 3; }
  int values() const { return static_cast<int>(this->Samples.size()); }

  Place PlaceOf(const Vector& x) const
  {
    Place place = this->Start;
    place.position[0] += x[0] * this->OfImage.spacing[0];
    place.position[1] += x[1] * this->OfImage.spacing[1];
    place.rotation += x[2];
    place.scale *= x.size() > 3 ? std::exp(x[3]) : 1;
    return place;
  }

  int operator()(const Vector& x, Vector& residuals) const
  {
    this->ForEach(x,
      [&](int i, double, double, double plain, double root)
      { residuals[i] = robustScale * plain * std::sqrt(2 / (root + 1)); });
    return 0;
  }

  int df(const Vector& x, Eigen::MatrixXd& derivatives) const
  {
    const Place place = this->PlaceOf(x);
    const Point2 middle = this->Index(place.position);
    this->ForEach(x,
      [&](int i, double column, double row, double, double root)
      {
        const double slope = std::sqrt((root + 1) / 2) / root;
        const double right = slope * this->Right(column, row, 0);
        const double up = slope * this->Up(column, row, 0);
        derivatives(i, 0) = right;
        derivatives(i, 1) = up;
        derivatives(i, 2) = up * (column - middle[0]) - right * (row - middle[1]);
        if (this->inputs() > 3)
        {
          derivatives(i, 3) = right * (column - middle[0]) + up * (row - middle[1]);
        }
      });
    return 0;
  }

private:
  /// Returns the column and the row in the image.
  Point2 Index(const Point2& at) const
  {
    return { (at[0] - this->OfImage.origin[0]) / this->OfImage.spacing[0],
      (at[1] - this->OfImage.origin[1]) / this->OfImage.spacing[1] };
  }

  template <class Use>
  void ForEach(const Vector& x, const Use& use) const
  {
    const Place place = this->PlaceOf(x);
    for (int i = 0; i < this->values(); ++i)
    {
      const Sample& sample = this->Samples[static_cast<std::size_t>(i)];
      const auto [column, row] = this->Index(place.inImage(sample.place));
      // Beyond the image nothing is known, and nothing is wrong.
      const double plain =
        (this->Image(column, row, static_cast<float>(sample.value)) - sample.value) / robustScale;
      use(i, column, row, plain, std::sqrt(1 + plain * plain));
    }
  }

  const Place& Start;
  FreePlace Free;
  const std::vector<Sample>& Samples;
  std::pair<Plane, Plane> Gradient;
  Lookup Image, Right, Up;
  const Grid& OfImage;
};

} // namespace

Plane lightOrNone(const Plane& photograph, double black, double exponent)
{
  const int factor = std::max(1, photograph.columns / 100);
  const Plane coarse = shrunk(photograph, factor);
  Plane bright(coarse.columns, coarse.rows);
  const int reach = std::max(1, coarse.columns / 8);
  for (int row = 0; row < coarse.rows; ++row)
  {
    for (int column = 0; column < coarse.columns; ++column)
    {
      std::vector<float> window;
      for (int y = std::max(0, row - reach); y <= std::min(coarse.rows - 1, row + reach); ++y)
      {
        for (int x = std::max(0, column - reach); x <= std::min(coarse.columns - 1, column + reach);
             ++x)
        {
          window.push_back(coarse(x, y));
        }
      }
      bright(column, row) = quantile(window, 0.6);
    }
  }
  const Lookup brightAt(bright);
  const double half = std::pow(0.5, exponent);
  Plane result(photograph.columns, photograph.rows);
  const auto place = [factor](int index, int count)
  { return std::clamp((index + 0.5) / factor - 0.5, 0., count - 1.); };
  for (int row = 0; row < photograph.rows; ++row)
  {
    for (int column = 0; column < photograph.columns; ++column)
    {
      const double light =
        brightAt(place(column, bright.columns), place(row, bright.rows), 1) - black;
      result(column, row) = photograph(column, row) > black + half * light ? 1.f : 0.f;
    }
  }
  return result;
}

Place fittedPlace(const Place& start, FreePlace free, const Plane& photograph, const Plane& used,
  const Grid& ofPhotograph, const Plane& image, const Grid& ofImage)
{
  Place place = start;
  for (const double sigma : { 12., 4., 1.5 })
  {
    const Plane smooth = blurred(photograph, sigma), near = blurred(used, sigma);
    const double perPoint = std::abs(place.scale * ofPhotograph.spacing[1] / ofImage.spacing[1]);
    const Plane model = blurred(image, sigma * perPoint);
    const int step = sigma > 4 ? 4 : 2;
    std::vector<Sample> samples;
    for (int row = 0; row < photograph.rows; row += step)
    {
      for (int column = 0; column < photograph.columns; column += step)
      {
        if (near(column, row) > 0.98f)
        {
          samples.push_back({ ofPhotograph.at(column, row), smooth(column, row) });
        }
      }
    }
    Residuals residuals(place, free, samples, model, ofImage);
    if (residuals.values() <= residuals.inputs())
    {
      break;
    }
    Vector unknowns = Vector::Zero(residuals.inputs());
    Eigen::LevenbergMarquardt<Residuals> solver(residuals);
    solver.parameters.maxfev = 30;
    solver.parameters.ftol = solver.parameters.xtol = 1e-6;
    solver.minimize(unknowns);
    place = residuals.PlaceOf(unknowns);
  }
  return place;
}

} // namespace filters
