// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Image/SensitivityLock.h"

#include "SchlierenSettings.h"

#include "Schlieren.h"

#include <iterator>
#include <tuple>
#include <type_traits>

namespace filters
{

namespace
{

bool isAtOtherTime(const ImageCircumstances& a, const ImageCircumstances& b)
{
  return a.time && b.time && *a.time != *b.time;
}

/// Compares everything but the time.
bool isSame(const ImageCircumstances& a, const ImageCircumstances& b)
{
  return std::tie(a.data, a.properties, a.medium, a.rays) ==
    std::tie(b.data, b.properties, b.medium, b.rays);
}

} // namespace

std::vector<double> settingsOfRays(const SchlierenSettings& settings)
{
  std::vector<double> values;
  const auto add = [&](const char*, auto member)
  {
    const auto& value = settings.*member;
    if constexpr (std::is_array_v<std::remove_reference_t<decltype(value)>>)
    {
      values.insert(values.end(), std::begin(value), std::end(value));
    }
    else
    {
      values.push_back(static_cast<double>(value));
    }
  };
  ViewSettings::visit(add);
  AccuracySettings::visit(add);
  values.insert(values.end(),
    { settings.SourceDistance, double(settings.SourceShape), double(settings.Device) });
  if (static_cast<schlieren::SourceShape>(settings.SourceShape) != schlieren::SourceShape::Point)
  {
    values.insert(values.end(),
      { settings.SourceWidth, settings.SourceLength, settings.MirrorFocalLength,
        settings.KnifeEdgeAngle });
  }
  return values;
}

std::optional<double> SensitivityLock::For(int mode, const ImageCircumstances& now)
{
  // Ignores the camera at other times than that of k, because an animation may move it before or
  // after the first image of a time is made. A given k belongs to no time.
  const bool holds = this->Last && this->Last->properties == now.properties &&
    this->Last->medium == now.medium &&
    (this->Last->data == now.data || isAtOtherTime(*this->Last, now)) &&
    (!this->Origin || this->Origin->rays == now.rays || isAtOtherTime(*this->Origin, now) ||
      mode == SchlierenSettings::K_AUTOMATIC_KEPT);
  if (this->Last && !holds)
  {
    this->Drop();
  }
  this->Last = now;
  return this->K;
}

void SensitivityLock::Found(double k)
{
  this->K = k;
  this->FoundAt = this->Origin = this->Last;
}

void SensitivityLock::Give(std::optional<double> k)
{
  this->K = k;
  this->FoundAt.reset();
  this->Origin.reset();
  this->Last.reset();
}

std::optional<double> SensitivityLock::GetKept() const
{
  const bool isFound = this->FoundAt && this->Last && isSame(*this->FoundAt, *this->Last);
  return isFound ? std::nullopt : this->K;
}

} // namespace filters
