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

/// Describes an image in one line: samples, speed, device and accuracy of its rays.
/// `raysPerSecond`: 0 if unknown.
std::string statusInWords(
  const schlieren::Image& image, const schlieren::Scene& scene, double raysPerSecond);

} // namespace filters
