// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photograph/CameraFit.h"

#include <unsupported/Eigen/NonLinearOptimization>

#include <algorithm>
#include <cmath>
#include <vector>

namespace filters
{

namespace
{

using Vector = Eigen::VectorXd;

constexpr double robustScale = 0.02;
constexpr double leastLight = 1e-4;                  // powers of it have derivatives
constexpr double leastBlur = 0.05, largestBlur = 20; // points

// The black level is the middle of a range plus its half times tanh of the unknown.
constexpr double blackMiddle = 0.075, blackHalf = 0.125;

std::array<double, 6> termsAt(double x, double y) { return { 1, x, y, x * x, y * y, x * y }; }

/// A block of the image that is compared.
struct Block
{
  int column, row;
  double value;                // of the photograph
  double undisturbed;          // of that without flow
  std::array<double, 6> terms; // of the surface
};

/// Residuals and their derivatives, as Eigen's LevenbergMarquardt takes them. The unknowns: the light's parameters, ln of the
/// blur, the black level, the surface, of these what is fitted.
class Residuals
{
public:
  Residuals(const SimulatedLight& light, const Exposure& exposure, const CameraFit& start,
    Fitted what, Blur blur, const std::function<bool(double, double)>& uses)
    : Light(light)
    , Start(start)
    , FitsBlur(blur == Blur::Fitted)
    , FitsLight(what == Fitted::Light || what == Fitted::All)
    , FitsBlack(what == Fitted::BrightnessAndBlack || what == Fitted::All)
    , HasOther(!exposure.withoutFlow.values.empty() && light.isBrightWithoutFlow())
    , Factor(std::max(1, exposure.photograph.columns / 200))
  {
    const Plane photograph = shrunk(exposure.photograph, this->Factor);
    const Plane known = shrunk(exposure.known, this->Factor);
    const Plane other = this->HasOther ? shrunk(exposure.withoutFlow, this->Factor) : Plane();
    for (int row = 0; row < photograph.rows; ++row)
    {
      for (int column = 0; column < photograph.columns; ++column)
      {
        const double x = coordinate(column, photograph.columns);
        const double y = coordinate(row, photograph.rows);
        if (known(column, row) > 0.999f && (!uses || uses((1 + x) / 2, (1 + y) / 2)))
        {
          this->Blocks.push_back({ column, row, photograph(column, row),
            this->HasOther ? other(column, row) : 0, termsAt(x, y) });
        }
      }
    }
  }

  int inputs() const
  {
    return this->BlurredCount() + (this->FitsBlack ? 1 : 0) + (this->HasOther ? 0 : 6);
  }
  int values() const { return static_cast<int>(this->Blocks.size()); }

  Vector Unknowns(const CameraFit& fit) const
  {
    Vector x(this->inputs());
    int next = 0;
    for (int i = 0; i < this->LightCount(); ++i)
    {
      x[next++] = fit.light[static_cast<std::size_t>(i)];
    }
    if (this->FitsBlur)
    {
      x[next++] = std::log(fit.camera.blur);
    }
    if (this->FitsBlack)
    {
      x[next++] = std::atanh(std::clamp((fit.camera.black - blackMiddle) / blackHalf, -0.99, 0.99));
    }
    for (int i = 0; i < 6 && !this->HasOther; ++i)
    {
      x[next++] = fit.camera.surface[static_cast<std::size_t>(i)];
    }
    return x;
  }

  CameraFit FitOf(const Vector& x) const
  {
    CameraFit fit = this->Start;
    int next = 0;
    for (int i = 0; i < this->LightCount(); ++i)
    {
      fit.light[static_cast<std::size_t>(i)] = x[next++];
    }
    if (this->FitsBlur)
    {
      fit.camera.blur = std::clamp(std::exp(x[next++]), leastBlur, largestBlur);
    }
    if (this->FitsBlack)
    {
      fit.camera.black = blackMiddle + blackHalf * std::tanh(x[next++]);
    }
    for (int i = 0; i < 6 && !this->HasOther; ++i)
    {
      fit.camera.surface[static_cast<std::size_t>(i)] = x[next++];
    }
    return fit;
  }

  int operator()(const Vector& x, Vector& residuals) const
  {
    const CameraFit fit = this->FitOf(x);
    const Plane light = this->LightOf(fit);
    for (int i = 0; i < this->values(); ++i)
    {
      residuals[i] = this->Residual(this->Blocks[static_cast<std::size_t>(i)], light, fit).robust;
    }
    return 0;
  }

  int df(const Vector& x, Eigen::MatrixXd& derivatives) const
  {
    // Of logarithms and radians. Long enough to see across the kinks where light is clipped: an automatic k is at one.
    constexpr double step = 0.02;
    const CameraFit fit = this->FitOf(x);
    const Plane light = this->LightOf(fit);
    std::vector<Plane> others;
    for (int i = 0; i < this->BlurredCount(); ++i)
    {
      Vector other = x;
      other[i] += step;
      others.push_back(this->LightOf(this->FitOf(other)));
    }
    for (int i = 0; i < this->values(); ++i)
    {
      const Block& block = this->Blocks[static_cast<std::size_t>(i)];
      const Difference difference = this->Residual(block, light, fit);
      int next = 0;
      for (const Plane& other : others)
      {
        const double change =
          (other(block.column, block.row) - light(block.column, block.row)) / step;
        derivatives(i, next++) = difference.slope * difference.byLight * change;
      }
      if (this->FitsBlack)
      {
        const double part = (fit.camera.black - blackMiddle) / blackHalf;
        derivatives(i, next++) =
          difference.slope * difference.byBlack * blackHalf * (1 - part * part);
      }
      for (std::size_t term = 0; term < 6 && !this->HasOther; ++term)
      {
        derivatives(i, next++) = difference.slope * difference.bySurface * block.terms[term];
      }
    }
    return 0;
  }

private:
  /// The model less the photograph as the robust loss counts it, and what it changes by.
  struct Difference
  {
    double robust; // its square is the loss
    double slope;  // of it by the plain difference
    double byLight, byBlack, bySurface;
  };

  int LightCount() const { return this->FitsLight ? static_cast<int>(this->Light.free()) : 0; }

  /// Of the unknowns that change the blurred light.
  int BlurredCount() const { return this->LightCount() + (this->FitsBlur ? 1 : 0); }

  /// Returns the blurred light of the blocks.
  Plane LightOf(const CameraFit& fit) const
  {
    return blurred(
      shrunk(this->Light.light(fit.light), this->Factor), fit.camera.blur / this->Factor);
  }

  Difference Residual(const Block& block, const Plane& light, const CameraFit& fit) const
  {
    const Camera& camera = fit.camera;
    const double relative = std::max<double>(light(block.column, block.row), leastLight);
    const double power = std::pow(relative, camera.exponent);
    double bright = block.undisturbed - camera.black;
    if (!this->HasOther)
    {
      double sum = 0;
      for (std::size_t term = 0; term < 6; ++term)
      {
        sum += camera.surface[term] * block.terms[term];
      }
      bright = std::exp(sum);
    }
    const double plain = (camera.black + bright * power - block.value) / robustScale;
    const double root = std::sqrt(1 + plain * plain);
    // 2 (root - 1), without cancellation.
    const double robust = plain * std::sqrt(2 / (root + 1));
    const double slope = std::sqrt((root + 1) / 2) / root;
    return { robustScale * robust, slope, bright * camera.exponent * power / relative,
      this->HasOther ? 1 - power : 1, bright * power };
  }

  const SimulatedLight& Light;
  const CameraFit& Start;
  bool FitsBlur;
  bool FitsLight;
  bool FitsBlack;
  bool HasOther; // a photograph without flow
  int Factor;    // points to a block's side
  std::vector<Block> Blocks;
};

} // namespace

double Camera::surfaceAt(double x, double y) const
{
  const auto terms = termsAt(x, y);
  double sum = 0;
  for (std::size_t term = 0; term < terms.size(); ++term)
  {
    sum += this->surface[term] * terms[term];
  }
  return sum;
}

CameraFit fitCamera(const SimulatedLight& light, const Exposure& exposure, const CameraFit& start,
  Fitted what, Blur blur, const std::function<bool(double, double)>& uses)
{
  Residuals residuals(light, exposure, start, what, blur, uses);
  if (residuals.inputs() == 0 || residuals.values() <= residuals.inputs())
  {
    return start;
  }
  Vector unknowns = residuals.Unknowns(start);
  Eigen::LevenbergMarquardt<Residuals> solver(residuals);
  solver.parameters.maxfev = 60;
  solver.parameters.ftol = solver.parameters.xtol = 1e-6;
  solver.minimize(unknowns);
  CameraFit result = residuals.FitOf(unknowns);
  result.cost = solver.fvec.squaredNorm() / residuals.values();
  return result;
}

Plane recorded(const SimulatedLight& light, const Exposure& exposure, const CameraFit& fit)
{
  const bool hasOther = !exposure.withoutFlow.values.empty() && light.isBrightWithoutFlow();
  std::vector<float> seen;
  for (std::size_t i = 0; hasOther && i < exposure.known.size(); ++i)
  {
    if (exposure.known.values[i] > 0)
    {
      seen.push_back(exposure.withoutFlow.values[i]);
    }
  }
  const double median = quantile(seen, 0.5);
  Plane result = blurred(light.light(fit.light), fit.camera.blur);
  for (int row = 0; row < result.rows; ++row)
  {
    for (int column = 0; column < result.columns; ++column)
    {
      float& value = result(column, row);
      double bright = std::exp(
        fit.camera.surfaceAt(coordinate(column, result.columns), coordinate(row, result.rows)));
      if (hasOther)
      {
        const double other = exposure.withoutFlow(column, row);
        bright = (std::isfinite(other) ? other : median) - fit.camera.black;
      }
      const double power = std::pow(std::max<double>(value, leastLight), fit.camera.exponent);
      value = static_cast<float>(std::clamp(fit.camera.black + bright * power, 0., 1.));
    }
  }
  return result;
}

} // namespace filters
