// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Random data and benches for TargetErrorScenes. All that is random follows from a number, everywhere in the same way.
#pragma once

#include "Fields.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace schlieren
{

/// Random numbers that do not depend on the standard library's distributions.
class Random
{
public:
  explicit Random(std::uint64_t seed)
    : engine_(seed)
  {
  }
  double uniform(double low, double high)
  {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double logUniform(double low, double high)
  {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  int below(int count) { return static_cast<int>(uniform(0, count)); }
  bool chance(double probability) { return uniform(0, 1) < probability; }
  Vector direction();

private:
  std::mt19937_64 engine_;
};

enum class DataKind
{
  Balls,      ///< Gaussian
  Shock,      ///< tanh, 0.7 to 6 voxels thick, and a ball
  Column,     ///< Gaussian, along an axis or aslant
  Waves,      ///< two or three sines
  Turbulence, ///< 24 waves whose heights fall with their numbers
  Step,       ///< from one voxel to the next
  Body,       ///< balls or a shock around a solid
  Flat,       ///< 2-D, one layer of cells
  TreeBalls,
  TreeShock, ///< a thin shell
  TreeBody,  ///< a sphere in a far field, with a bow shock or without
  TreeFine   ///< gratings or sheets finer than pixels
};
constexpr int dataKinds = 12;
const char* name(DataKind kind);

/// A grid's samples or a source, and what belongs to them.
struct RandomData
{
  DataKind kind;
  std::unique_ptr<SampledField<double>> samples; ///< null: of a source
  std::vector<unsigned char> valid;
  Field field;
  std::unique_ptr<SampledField<double>>
    everywhere;    ///< the same box full of gas, to see which rays cross it
  double near = 0; ///< data units: half height of a view of what is worth looking at; 0: all of it
};

RandomData randomData(DataKind kind, Random& random);

/// A view of the data, a technique and a light, with distances and wavelengths that make something to be seen.
Scene randomScene(const RandomData& data, Cutoff cutoff, Random& random);

/// What the error of a technique is that cannot be seen.
double invisibleError(Cutoff cutoff);

} // namespace schlieren
