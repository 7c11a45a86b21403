// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace filters
{

/// Makes the images of a filter one after the other, each as a whole or time-sliced.
class TimeSlicedImage
{
public:
  TimeSlicedImage();

  /// `seconds`: for rays and light, about; 0: no limit. What the image holds then, see schlieren::Image::finished.
  schlieren::Image Begin(const schlieren::Field& field, const schlieren::Scene& scene,
    double seconds, const schlieren::Monitor& monitor);
  schlieren::Image Resume(double seconds, const schlieren::Monitor& monitor);

  void Cancel() { this->Bench.cancel(); }

  /// Who traces rays, too: see schlieren::Bench.
  void SetWorkers(std::vector<schlieren::Channel*> workers)
  {
    this->Bench.setWorkers(std::move(workers));
  }

  const schlieren::Bench& GetBench() const { return this->Bench; }
  const schlieren::Scene& GetScene() const { return this->Scene; } ///< of the last one

  /// In words that fit in a line; see statusInWords.
  std::string GetStatus(const schlieren::Image& image) const;

  /// What the user should know of its rays: once for the same rays, whatever images are made of them.
  std::vector<std::string> GetWarnings(const schlieren::Image& image);

private:
  schlieren::Image Noted(schlieren::Image image);

  schlieren::Bench Bench;
  schlieren::Scene Scene;
  std::int64_t RaysBefore = 0; // this image
  double RaysPerSecond = 0;    // when rays were traced last
  std::int64_t WarnedOf[3] = { 0, 0, 0 };
};

} // namespace filters
