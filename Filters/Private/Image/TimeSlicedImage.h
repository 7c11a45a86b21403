// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Image/PathDifference.h"

#include "Schlieren.h"

#include <cstdint>
#include <string>
#include <vector>

namespace filters
{

/// Makes the images of a filter one after the other, each as a whole or time-sliced.
class TimeSlicedImage
{
public:
  TimeSlicedImage();
  TimeSlicedImage(const TimeSlicedImage&) = delete; // Difference knows where the benches are
  TimeSlicedImage& operator=(const TimeSlicedImage&) = delete;

  enum class Paths
  {
    OfScene,
    Difference ///< see PathDifference
  };

  /// `seconds`: for rays and light, about; 0: no limit. What the image holds then, see schlieren::Image::finished.
  schlieren::Image Begin(const schlieren::Field& field, const schlieren::Scene& scene, Paths paths,
    double seconds, const schlieren::Monitor& monitor);
  schlieren::Image Resume(double seconds, const schlieren::Monitor& monitor);

  void Cancel() { this->Difference.Cancel(); }

  /// Who traces rays, too: see schlieren::Bench.
  void SetProcesses(schlieren::Processes* processes);

  schlieren::Work GetWork() const;                                 ///< of all images
  const schlieren::Scene& GetScene() const { return this->Scene; } ///< of the last one

  /// In words that fit in a line; see statusInWords.
  std::string GetStatus(const schlieren::Image& image) const;

  /// What the user should know of its rays: once for the same rays, whatever images are made of them; that light is
  /// taken to leave a liquid, once.
  std::vector<std::string> GetWarnings(const schlieren::Image& image);

private:
  schlieren::Image Noted(schlieren::Image image);

  schlieren::Bench Bench;
  schlieren::Bench StraightBench; // of differences
  PathDifference Difference{ this->Bench, this->StraightBench };
  bool IsDifference = false;
  schlieren::Work WorkBefore; // of benches that are gone
  schlieren::Scene Scene;
  std::int64_t RaysBefore = 0; // this image
  double RaysPerSecond = 0;    // when rays were traced last
  std::int64_t WarnedOf[4] = { 0, 0, 0, 0 };
  bool HasNotedExit = false;
};

} // namespace filters
