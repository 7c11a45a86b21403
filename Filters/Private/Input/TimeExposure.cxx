// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/TimeExposure.h"

#include <algorithm>
#include <iterator>
#include <sstream>

namespace filters
{

//------------------------------------------------------------------------------
TimeExposure::TimeExposure(const std::vector<double>& steps, double first, double last, double time,
  double length, int samples)
{
  this->Time = time;
  this->Begin = std::max(first, time - length / 2);
  this->End = std::min(last, time + length / 2);
  if (samples < 2 || !(this->Begin < this->End))
  {
    return;
  }
  const auto need = [this](double step)
  {
    const auto place = std::lower_bound(this->Steps.begin(), this->Steps.end(), step);
    const auto number = static_cast<std::size_t>(place - this->Steps.begin());
    if (place == this->Steps.end()) // instants increase
    {
      this->Steps.push_back(step);
    }
    return number;
  };
  for (int i = 0; i < samples; ++i)
  {
    Instant instant;
    instant.time = this->Begin + (i + 0.5) / samples * (this->End - this->Begin);
    // Finds the steps around the instant.
    const auto after = std::upper_bound(steps.begin(), steps.end(), instant.time);
    if (after == steps.begin() || after == steps.end())
    {
      instant.earlier = instant.later =
        need(steps.empty() ? instant.time : std::clamp(instant.time, first, last));
      this->Instants.push_back(instant);
      continue;
    }
    const double lower = *std::prev(after), upper = *after;
    constexpr double rounding = 1e-9;
    instant.ratio = (instant.time - lower) / (upper - lower);
    if (instant.ratio < rounding || instant.ratio > 1 - rounding)
    {
      instant.earlier = instant.later = need(instant.ratio < 0.5 ? lower : upper);
      instant.ratio = 0;
    }
    else
    {
      instant.earlier = need(lower);
      instant.later = need(upper);
    }
    this->Instants.push_back(instant);
  }
}

//------------------------------------------------------------------------------
std::string TimeExposure::GetWords() const
{
  std::ostringstream words;
  words << "mean of " << this->Instants.size() << " instants from " << this->Begin << " to "
        << this->End;
  return words.str();
}

} // namespace filters
