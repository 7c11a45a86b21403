// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace schlieren
{
struct Accuracy;
struct Image;
struct Scene;
} // namespace schlieren

namespace filters
{

/// Names what contributes most to an image's error, such as "rays per pixel".
std::string limitInWords(const schlieren::Accuracy& accuracy);

/// Returns a text such as "error 0.0031 of full scale (target 0.0039)", of an image with a target.
std::string errorInWords(const schlieren::Accuracy& accuracy, const schlieren::Scene& scene);

/// Says whether waves matter to an image whose LightModel is not Rays; empty for others.
std::string wavesInWords(const schlieren::Image& image);

double blockedShare(const schlieren::Image& image);
/// Says how much light is blocked where no cell is; empty for less than a thousandth.
std::string outsideInWords(const schlieren::Image& image, bool isAlone);

/// Describes an image in one line: samples, the time that missing ones take, speed, device
/// and accuracy of its rays, and the error that a target has led to.
/// `raysPerSecond`: 0 if unknown.
std::string statusInWords(
  const schlieren::Image& image, const schlieren::Scene& scene, double raysPerSecond);

} // namespace filters
