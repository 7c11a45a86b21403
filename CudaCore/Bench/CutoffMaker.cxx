// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/CutoffMaker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace schlieren
{

namespace
{

/// Linear light of n sRGB values evenly spaced from 0 to 1.
template <std::size_t n>
std::array<float, n> linearValues()
{
  std::array<float, n> values;
  for (std::size_t i = 0; i < n; ++i)
  {
    values[i] = static_cast<float>(linearFromSrgb(static_cast<double>(i) / (n - 1)));
  }
  return values;
}

} // namespace

Cutoffs CutoffMaker::patternOf(const Scene& scene, const PixelPlaces& pixels)
{
  const View& view = scene.view;
  const BackgroundPattern& pattern = scene.background;
  const double period =
    pattern.period > 0 ? pattern.period / pixels.sizeBehind : pattern.pixelsPerPeriod;
  switch (pattern.kind)
  {
    case PatternKind::Image:
    {
      const RgbImage& image = *pattern.image;
      return BackgroundImage{ { 1, image.width, image.height, linearImage(pattern.image) },
        2. / view.width, 2. / view.height };
    }
    case PatternKind::Stripes:
    {
      const double contrast = patternContrast(period);
      Carrier carrier =
        contrast > 0 ? Carrier::of(period, pattern.angle, pixels.zeroBehind) : Carrier{};
      carrier.atOrigin = std::remainder(carrier.atOrigin, 1.0); // however far away u = v = 0 is
      return Stripes{ carrier, contrast };
    }
    case PatternKind::Dots:
      break;
  }
  return Dots{ { pixels.zeroBehind[0], pixels.zeroBehind[1] }, period, scene.seed };
}

Cutoffs CutoffMaker::cutoffOf(const Scene& scene, double k, const PixelPlaces& pixels)
{
  if (scene.cutoff == Cutoff::Background)
  {
    return patternOf(scene, pixels);
  }
  if (scene.cutoff == Cutoff::ColorFilter && scene.colorFilter)
  {
    const RgbImage& image = *scene.colorFilter;
    return ColorImage{ k, image.width, image.height, linearImage(scene.colorFilter) };
  }
  image_.reset();
  const CutoffAxis axis = CutoffAxis::at(scene.knifeEdgeAngle, k, scene.cutoffOffset);
  switch (scene.cutoff)
  {
    case Cutoff::KnifeEdge:
      return KnifeEdge{ axis, scene.source.shape == SourceShape::Disc };
    case Cutoff::BrightField:
      return BrightField{ k };
    case Cutoff::DarkField:
      return DarkField{ k };
    case Cutoff::NumericalSchlieren:
      return NumericalSchlieren{ k };
    case Cutoff::GradedFilter:
      table_.clear();
      std::transform(scene.gradedFilter.begin(), scene.gradedFilter.end(),
        std::back_inserter(table_), [](double value) { return static_cast<float>(value); });
      return GradedFilter{ axis, { table_.data(), table_.size() } };
    case Cutoff::ColorFilter:
    {
      // Linear in between, off by no more than 4e-7.
      static const std::array<float, 1025> linear = linearValues<1025>();
      return ColorWheel{ k, { linear.data(), linear.size() } };
    }
    case Cutoff::Interferogram:
      return interferogram(scene, pixels.size);
    case Cutoff::Shadowgraph:
    case Cutoff::PhaseContrast:
    case Cutoff::Background:
      break;
  }
  return Shadowgraph{};
}

Cutoffs CutoffMaker::interferogram(const Scene& scene, double pixelSize)
{
  const Fringes& fringes = scene.fringes;
  const Carrier carrier = fringes.finite
    ? Carrier::of(fringes.spacing / pixelSize, fringes.angle,
        { 0.5 * (scene.view.width - 1), 0.5 * (scene.view.height - 1) })
    : Carrier{};
  return Interferogram{ 1 / scene.wavelength, carrier };
}

Table CutoffMaker::linearImage(const std::shared_ptr<const RgbImage>& image)
{
  if (image_ != image)
  {
    static const std::array<float, 256> linear = linearValues<256>();
    table_.resize(image->rgb.size());
    std::transform(image->rgb.begin(), image->rgb.end(), table_.begin(),
      [](unsigned char value) { return linear[value]; });
    image_ = image;
  }
  return { table_.data(), table_.size() };
}

} // namespace schlieren
