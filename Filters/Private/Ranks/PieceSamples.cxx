// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/PieceSamples.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace filters
{

PieceSamples PieceSamples::Of(const DataPiece& piece, const schlieren::Lattice& lattice)
{
  const auto size = static_cast<std::size_t>(lattice.size());
  PieceSamples samples{ std::vector<unsigned char>(size), std::vector<double>(size) };
  piece.sample(lattice, samples.values.data(), samples.found.data());
  const bool isAny =
    std::find(samples.found.begin(), samples.found.end(), 1) != samples.found.end();
  return isAny ? std::move(samples) : PieceSamples();
}

void PieceSamples::Add(PieceSamples other)
{
  if (this->found.empty())
  {
    *this = std::move(other);
    return;
  }
  for (std::size_t i = 0; i < other.found.size(); ++i)
  {
    if (other.found[i] && !this->found[i])
    {
      this->found[i] = 1;
      this->values[i] = other.values[i];
    }
  }
}

// Writes a bit for each point and only values that were found: most lattice points are outside.
void PieceSamples::Put(std::vector<char>& message) const
{
  const std::size_t size = this->found.size();
  std::vector<unsigned char> bits((size + 7) / 8);
  std::vector<double> known;
  for (std::size_t i = 0; i < size; ++i)
  {
    if (this->found[i])
    {
      bits[i / 8] = static_cast<unsigned char>(bits[i / 8] | 1u << i % 8);
      known.push_back(this->values[i]);
    }
  }
  put(static_cast<std::uint64_t>(size), message);
  putAll(bits, message);
  putAll(known, message);
}

PieceSamples PieceSamples::Get(Reader& message, std::size_t points)
{
  const auto size = static_cast<std::size_t>(message.Get<std::uint64_t>());
  const auto bits = message.GetAll<std::vector<unsigned char>>();
  const auto known = message.GetAll<std::vector<double>>();
  PieceSamples samples;
  if (size == 0)
  {
    return samples;
  }
  if (size != points || bits.size() != (size + 7) / 8)
  {
    Reader::Fail();
  }
  samples.found.resize(size);
  for (std::size_t i = 0; i < size; ++i)
  {
    samples.found[i] = bits[i / 8] >> i % 8 & 1u;
  }
  const auto count =
    static_cast<std::size_t>(std::count(samples.found.begin(), samples.found.end(), 1));
  if (known.size() != count)
  {
    Reader::Fail();
  }
  const double* next = known.data();
  samples.values.resize(size);
  for (std::size_t i = 0; i < size; ++i)
  {
    if (samples.found[i])
    {
      samples.values[i] = *next++;
    }
  }
  return samples;
}

} // namespace filters
