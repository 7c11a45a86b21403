// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// FitPoints for packs of `lanes` points. PointFit.cxx includes this once for each set of instructions.

/// Units for moments: those of a lower triangular matrix, and what a symmetric one makes of them.
struct Units
{
  Real spread[3][3], perSpread[3], shrunk[3][3];

  template <bool shrinks>
  SCHLIEREN_INLINE void scale(const Real* x, Real* y) const
  {
    for (int i = 0; i < 3; ++i)
    {
      y[i] = x[i];
      for (int k = 0; k < i; ++k)
      {
        y[i] -= this->spread[i][k] * y[k];
      }
      y[i] *= this->perSpread[i];
    }
    if constexpr (shrinks)
    {
      this->shrink(y);
    }
  }

  SCHLIEREN_INLINE void shrink(Real* y) const
  {
    const Real x[3] = { y[0], y[1], y[2] };
    for (int i = 0; i < 3; ++i)
    {
      y[i] = this->shrunk[i][0] * x[0] + this->shrunk[i][1] * x[1] + this->shrunk[i][2] * x[2];
    }
  }

  /// Of second moments xx, yy, zz, xy, yz, zx: the same along rows and columns.
  template <bool shrinks>
  SCHLIEREN_INLINE void scaleSecond(const Real* from, Real* to) const
  {
    const Real rows[3][3] = { { from[0], from[3], from[5] }, { from[3], from[1], from[4] },
      { from[5], from[4], from[2] } };
    Real half[3][3];
    for (int i = 0; i < 3; ++i)
    {
      this->scale<shrinks>(rows[i], half[i]);
    }
    Real all[3][3];
    for (int k = 0; k < 3; ++k)
    {
      const Real column[3] = { half[0][k], half[1][k], half[2][k] };
      this->scale<shrinks>(column, all[k]);
    }
    for (int k = 0; k < 3; ++k)
    {
      to[k] = all[k][k];
      to[3 + k] = all[k][(k + 1) % 3];
    }
  }

  /// Along directions in which `places` (second moments in the units so far) lie as close together as nothing else is to
  /// be compared with, as those of one layer of cells do, units become so large that nothing is found there.
  SCHLIEREN_INLINE void shrinkWhereFlat(const Real* places)
  {
    Real m[3][3] = { { places[0] + flat, places[3], places[5] },
      { places[3], places[1] + flat, places[4] }, { places[5], places[4], places[2] + flat } };
    Real minors[3][3];
    for (int i = 0; i < 3; ++i)
    {
      const int a = (i + 1) % 3, b = (i + 2) % 3;
      for (int k = 0; k < 3; ++k)
      {
        const int c = (k + 1) % 3, d = (k + 2) % 3;
        minors[i][k] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
      }
    }
    const Real perVolume =
      flat / (m[0][0] * minors[0][0] + m[0][1] * minors[0][1] + m[0][2] * minors[0][2]);
    for (int i = 0; i < 3; ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        this->shrunk[i][k] = (i == k ? 1 : 0) - perVolume * minors[i][k];
      }
    }
  }
};

/// The fit of a quadratic polynomial for a pack of points: to values of their neighbours, or to means over them.
template <bool ofMeans>
class PackFit
{
public:
  SCHLIEREN_INLINE PackFit(PointFit& fit, int firstPoint)
    : Of{ fit }
    , FirstPoint{ firstPoint }
    , First{ fit.numbers.data() + firstPoint }
    , Last{ this->First + perNeighbour * static_cast<std::ptrdiff_t>(fit.neighbours) }
    , IsGood(this->Zero == this->Zero)
  {
  }

  SCHLIEREN_INLINE void run()
  {
    this->findUnits();
    this->assemble();
    this->factorize();
    this->solve();
    if constexpr (ofMeans)
    {
      this->storeCorrection();
    }
    this->storeGradient();
    const Real unfit = this->Left / (this->All > 0 ? this->All : this->Zero + 1);
    store(unfit, this->Of.unfit + this->FirstPoint);
  }

private:
  static constexpr int points = PointFit::points;
  static constexpr std::ptrdiff_t perNeighbour = (ofMeans ? 10 : 4) * points;

  SCHLIEREN_INLINE static void loadPlace(const double* from, Real (&x)[3])
  {
    for (int i = 0; i < 3; ++i)
    {
      load(from + i * points, x[i]);
    }
  }

  /// Finds L with L * transposed(L) = the mean of x * transposed(x): places in units of it are as far along every axis.
  SCHLIEREN_INLINE void findUnits()
  {
    Real perCount = this->Zero;
    for (int lane = 0; lane < lanes; ++lane)
    {
      const std::size_t count = this->Of.counts[this->FirstPoint + lane];
      perCount[lane] = 1 / static_cast<double>(count > 0 ? count : 1);
      this->IsGood[lane] = count >= fewest ? -1 : 0;
    }
    Real sums[3][3] = {};
    this->sumPlaces(sums);
    for (Real& along : this->Middle)
    {
      along *= perCount;
    }
    const Real least = leastFirst * (sums[0][0] + sums[1][1] + sums[2][2]);
    for (int i = 0; i < unknowns && ofMeans; ++i)
    {
      load(this->Of.own[i] + this->FirstPoint, this->Own[i]);
    }
    Real(&spread)[3][3] = this->Scale.spread;
    for (int i = 0; i < 3; ++i)
    {
      for (int k = 0; k <= i; ++k)
      {
        Real sum = sums[i][k] * perCount;
        if constexpr (ofMeans)
        {
          // With the size of what the mean is over: where all have the same place along an axis, that is its unit.
          const int second = i == k ? 3 + i : i == 1 ? 6 : k == 1 ? 7 : 8;
          sum += this->Own[second] - this->Own[i] * this->Own[k];
        }
        for (int j = 0; j < k; ++j)
        {
          sum -= spread[i][j] * spread[k][j];
        }
        if (k < i)
        {
          spread[i][k] = sum * this->Scale.perSpread[k];
          continue;
        }
        sum += least;
        this->IsGood &= sum > 0;
        for (int lane = 0; lane < lanes; ++lane)
        {
          spread[i][i][lane] = std::sqrt(sum[lane] > 0 ? sum[lane] : 1);
        }
        this->Scale.perSpread[i] = 1 / spread[i][i];
      }
    }
    if constexpr (ofMeans)
    {
      const Real places[6] = { sums[0][0] * perCount, sums[1][1] * perCount, sums[2][2] * perCount,
        sums[1][0] * perCount, sums[2][1] * perCount, sums[2][0] * perCount };
      Real scaled[6];
      this->Scale.template scaleSecond<false>(places, scaled);
      this->Scale.shrinkWhereFlat(scaled);
    }
  }

  /// Sums x * transposed(x), and stores the range of the values.
  SCHLIEREN_INLINE void sumPlaces(Real sums[3][3])
  {
    Real low = this->Zero, high = this->Zero;
    for (const double* from = this->First; from != this->Last; from += perNeighbour)
    {
      Real x[3], value;
      loadPlace(from, x);
      load(from + 3 * points, value);
      low = value < low ? value : low;
      high = value > high ? value : high;
      for (int i = 0; i < 3; ++i)
      {
        this->Middle[i] += x[i];
        for (int k = 0; k <= i; ++k)
        {
          sums[i][k] += x[i] * x[k];
        }
      }
    }
    store(low, this->Of.lowest + this->FirstPoint);
    store(high, this->Of.highest + this->FirstPoint);
  }

  /// Sums the lower half of the fit's matrix, its right side and the values' squares, and adds what keeps it regular.
  SCHLIEREN_INLINE void assemble()
  {
    for (const double* from = this->First; from != this->Last; from += perNeighbour)
    {
      Real x[3], y[3], value;
      loadPlace(from, x);
      this->Scale.template scale<ofMeans>(x, y);
      load(from + 3 * points, value);
      const Real weight = 1 / (y[0] * y[0] + y[1] * y[1] + y[2] * y[2] + leastSquare);
      Real terms[unknowns] = { y[0], y[1], y[2], y[0] * y[0], y[1] * y[1], y[2] * y[2], y[0] * y[1],
        y[1] * y[2], y[2] * y[0] };
      if constexpr (ofMeans)
      {
        Real second[6];
        for (int i = 0; i < 6; ++i)
        {
          load(from + (4 + i) * points, second[i]);
        }
        this->Scale.template scaleSecond<true>(second, terms + 3);
      }
      for (int i = 0; i < unknowns; ++i)
      {
        const Real weighted = weight * terms[i];
        for (int k = 0; k <= i; ++k)
        {
          this->Matrix[i][k] += weighted * terms[k];
        }
        this->Right[i] += weighted * value;
      }
      this->All += weight * value * value;
    }
    Real trace[2] = { this->Zero, this->Zero };
    for (int i = 0; i < unknowns; ++i)
    {
      trace[i / 3 > 0] += this->Matrix[i][i];
    }
    for (int i = 0; i < unknowns; ++i)
    {
      this->Matrix[i][i] += i < 3 ? (ofMeans ? leastFirstOfMeans : leastFirst) * trace[0]
                                  : (ofMeans ? leastSecondOfMeans : leastSecond) / 6 * trace[1];
    }
  }

  /// Makes Matrix = U * D * transposed(U), by columns; U has 1 in its diagonal, where 1 / D is put.
  SCHLIEREN_INLINE void factorize()
  {
    for (int k = 0; k < unknowns; ++k)
    {
      this->IsGood &= this->Matrix[k][k] > 0;
      const Real perDiagonal = 1 / (this->Matrix[k][k] > 0 ? this->Matrix[k][k] : this->Zero + 1);
      Real column[unknowns];
      for (int i = k + 1; i < unknowns; ++i)
      {
        column[i] = this->Matrix[i][k];
        this->Matrix[i][k] *= perDiagonal;
      }
      for (int i = k + 1; i < unknowns; ++i)
      {
        for (int j = k + 1; j <= i; ++j)
        {
          this->Matrix[i][j] -= this->Matrix[i][k] * column[j];
        }
      }
      this->Matrix[k][k] = perDiagonal;
    }
  }

  /// Finds the polynomial, and what is left of the squares: for the best fit, all that the right side does not take away.
  SCHLIEREN_INLINE void solve()
  {
    for (int i = 0; i < unknowns; ++i)
    {
      this->Found[i] = this->Right[i];
      for (int j = 0; j < i; ++j)
      {
        this->Found[i] -= this->Matrix[i][j] * this->Found[j];
      }
    }
    this->Left = this->All;
    for (int i = unknowns - 1; i >= 0; --i)
    {
      this->Found[i] *= this->Matrix[i][i];
      for (int j = i + 1; j < unknowns; ++j)
      {
        this->Found[i] -= this->Matrix[j][i] * this->Found[j];
      }
      this->Left -= this->Found[i] * this->Right[i];
    }
  }

  /// Stores by how much the value at the point differs from the mean over its own moments.
  SCHLIEREN_INLINE void storeCorrection()
  {
    Real scaled[unknowns];
    this->Scale.template scale<true>(this->Own, scaled);
    this->Scale.template scaleSecond<true>(this->Own + 3, scaled + 3);
    Real correction = this->Zero;
    for (int i = 0; i < unknowns; ++i)
    {
      correction -= this->Found[i] * scaled[i];
    }
    this->IsGood &= correction * 0 == 0;
    correction = this->IsGood ? correction : this->Zero;
    store(correction, this->Of.correction + this->FirstPoint);
    this->Scale.shrink(this->Found);
  }

  SCHLIEREN_INLINE void storeGradient()
  {
    Real gradient[3];
    for (int i = 2; i >= 0; --i)
    {
      gradient[i] = this->Found[i];
      for (int k = i + 1; k < 3; ++k)
      {
        gradient[i] -= this->Scale.spread[k][i] * gradient[k];
      }
      gradient[i] *= this->Scale.perSpread[i];
    }
    this->IsGood &= (gradient[0] + gradient[1] + gradient[2]) * 0 == 0;
    for (int i = 0; i < 3; ++i)
    {
      gradient[i] = this->IsGood ? gradient[i] : this->Zero;
      store(gradient[i], this->Of.gradient[i] + this->FirstPoint);
    }
    if constexpr (!ofMeans)
    {
      this->storeReach(gradient);
    }
  }

  SCHLIEREN_INLINE void storeReach(const Real (&gradient)[3])
  {
    Real least = this->Zero, most = this->Zero;
    for (const double* from = this->First; from != this->Last; from += perNeighbour)
    {
      Real x[3];
      loadPlace(from, x);
      const Real there = gradient[0] * x[0] + gradient[1] * x[1] + gradient[2] * x[2];
      least = there < least ? there : least;
      most = there > most ? there : most;
    }
    store(0.5 * least, this->Of.leastHalf + this->FirstPoint);
    store(0.5 * most, this->Of.mostHalf + this->FirstPoint);
    // In units in which squares of places along any direction are 1 in the mean.
    const Real* second = this->Found + 3;
    Real m[3];
    this->Scale.template scale<false>(this->Middle, m);
    const Real away = m[0] * m[0] + m[1] * m[1] + m[2] * m[2];
    const Real along = m[0] * (m[0] * second[0] + m[1] * second[3] + m[2] * second[5]) +
      m[1] * (m[1] * second[1] + m[2] * second[4]) + m[2] * m[2] * second[2];
    Real part = (away - PointFit::onAllSides) / (PointFit::onOneSide - PointFit::onAllSides);
    part = part > 0 ? part : this->Zero;
    part = part < 1 ? part : this->Zero + 1;
    const Real bend =
      second[0] + second[1] + second[2] - part * along / (away > 0 ? away : this->Zero + 1);
    const Mask isKnown = this->IsGood & (bend * 0 == 0);
    store(isKnown ? bend : this->Zero, this->Of.bend + this->FirstPoint);
  }

  PointFit& Of;
  const int FirstPoint;
  const double *const First, *const Last; // the neighbours' numbers
  const Real Zero = {};
  Mask IsGood;
  Units Scale;
  Real Middle[3] = {}; // of the neighbours' places
  Real Own[unknowns];  // moments of what the mean at the point is over
  Real Matrix[unknowns][unknowns] = {}, Right[unknowns] = {}, All = {};
  Real Found[unknowns], Left;
};

inline void fit(PointFit& of)
{
  for (int point = 0; point < PointFit::points; point += lanes)
  {
    of.values == PointFit::Values::Means ? PackFit<true>(of, point).run()
                                         : PackFit<false>(of, point).run();
  }
}
