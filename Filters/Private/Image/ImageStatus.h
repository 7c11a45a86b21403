// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace schlieren
{
struct Image;
struct Scene;
} // namespace schlieren

namespace filters
{

/// An image in words that fit in a line: its samples, the speed and the device, and how exact its rays are.
/// `raysPerSecond`: 0 where it is not known.
std::string statusInWords(
  const schlieren::Image& image, const schlieren::Scene& scene, double raysPerSecond);

} // namespace filters
