// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/ProgressiveImage.h"

#include <utility>

namespace schlieren
{

ProgressiveImage::ProgressiveImage(const FilmSettings& settings)
  : settings_(settings)
  , centres_(settings.width, settings.height, settings.threads)
{
}

void ProgressiveImage::begin(const Exposure& exposure)
{
  exposure_ = exposure;
  films_ = filmsOf(settings_, exposure.cutoff, exposure.maxRays);
  if (exposure.projection.pupilTilt > 0)
  {
    centres_.wantAll();
  }
  if (settings_.isOfCamera)
  {
    undisturbed_.emplace(settings_, exposure_);
  }
}

bool ProgressiveImage::add(
  const TracedPass& traced, const Pass& pass, Rays rays, const Monitor& monitor)
{
  const bool isLast = passes_ + 1 == settings_.samplesPerPixel;
  // A camera's rays stay in their pixels, where their light leaves no gaps.
  const bool isShownSoFar = monitor.paused && !isLast && pass.side < 1 && !settings_.isOfCamera;
  if (traced.onDevice)
  {
    if (!filmOnDevice_)
    {
      isOnDevice_ = true;
      filmOnDevice_ = std::make_unique<CudaFilm>(*films_);
    }
    filmOnDevice_->expose(
      *traced.onDevice, pass, exposure_.cutoff, exposure_.projection, exposure_.margin);
    if (isShownSoFar)
    {
      filmSoFar().add(*traced.onDevice, pass, exposure_);
    }
    ++passes_;
    return true;
  }
  waiting_.push_back({ pass, traced.exits.data() });
  if (rays == Rays::Go || isLast || monitor.paused || nextRow_ > 0)
  {
    counts_.add(exposeFrom(nextRow_, waiting_, exposure_.cutoff, exposure_.projection,
      exposure_.margin, settings_.threads, *films_, monitor));
    if (nextRow_ > 0)
    {
      waiting_.pop_back();
      return false;
    }
    if (isShownSoFar)
    {
      filmSoFar().add(waiting_, exposure_, settings_.threads);
    }
    if (!isLast || monitor.paused)
    {
      centres_.add(waiting_);
      waiting_.clear();
    }
  }
  ++passes_;
  return true;
}

ProgressiveImage::SoFar& ProgressiveImage::filmSoFar()
{
  if (!soFar_)
  {
    soFar_.emplace(SoFar{ filmsOf(settings_, exposure_.cutoff, exposure_.maxRays) });
  }
  return *soFar_;
}

void ProgressiveImage::SoFar::add(
  std::vector<TracedRays> rays, const Exposure& exposure, int threads)
{
  for (TracedRays& ofPass : rays)
  {
    ofPass.pass.side = 1;
  }
  expose(rays, exposure.cutoff, exposure.projection, exposure.margin, threads, films);
  passes += static_cast<std::int64_t>(rays.size());
}

void ProgressiveImage::SoFar::add(const CudaPass& rays, Pass pass, const Exposure& exposure)
{
  if (!onDevice)
  {
    onDevice = std::make_unique<CudaFilm>(films);
  }
  pass.side = 1;
  onDevice->expose(rays, pass, exposure.cutoff, exposure.projection, exposure.margin);
  ++passes;
}

bool ProgressiveImage::completeUndisturbed(const Monitor& monitor)
{
  while (undisturbed_ && undisturbed_->passes() < passes_)
  {
    if (!undisturbed_->addPass(isOnDevice_ ? Device::Cuda : Device::Cpu, monitor))
    {
      return false;
    }
  }
  return true;
}

bool ProgressiveImage::isWhole() const
{
  return passes_ > 0 && nextRow_ == 0 && (!undisturbed_ || undisturbed_->passes() == passes_);
}

void ProgressiveImage::developCounts(Image& image)
{
  if (filmOnDevice_)
  {
    counts_ = filmOnDevice_->develop(*films_);
  }
  image.samples = static_cast<int>(passes_);
  image.undisturbedLevel = undisturbedLevel(exposure_.cutoff);
  image.raysTraced = counts_.crossed;
  image.stepsTaken = counts_.steps;
  image.raysBlocked = counts_.blocked;
  image.raysLost = counts_.lost;
  image.saturatedFraction = counts_.saturatedFraction();
}

void ProgressiveImage::developCentres(Image& image) const
{
  if (filmOnDevice_)
  {
    filmOnDevice_->developCentres(image);
  }
  else
  {
    centres_.develop(waiting_, image);
  }
}

Image ProgressiveImage::centres() const
{
  Image image;
  image.width = settings_.width;
  image.height = settings_.height;
  developCentres(image);
  return image;
}

void ProgressiveImage::developUndisturbed(Image& image)
{
  if (undisturbed_)
  {
    image.background = undisturbed_->develop();
    image.backgroundDisplacement = backgroundDisplacement(image, exposure_.projection);
    image.patternPixel = 1 / exposure_.projection.perDataUnit;
  }
}

void ProgressiveImage::develop(Image& image)
{
  developCounts(image);
  if (soFar_ && passes_ < settings_.samplesPerPixel)
  {
    if (soFar_->onDevice)
    {
      soFar_->onDevice->develop(soFar_->films);
    }
    schlieren::develop(soFar_->films, soFar_->passes, settings_.threads, image);
  }
  else
  {
    schlieren::develop(*films_, passes_, settings_.threads, image);
  }
  smooth(settings_, image);
  developCentres(image);
  developUndisturbed(image);
}

bool ProgressiveImage::finish(Image& image, const Monitor& monitor)
{
  developCounts(image);
  schlieren::develop(*films_, passes_, settings_.threads, image);
  films_.reset(); // all that follows wants memory, too
  soFar_.reset();
  smooth(settings_, image);
  developCentres(image);
  filmOnDevice_.reset();
  if (!completeUndisturbed(monitor))
  {
    return false;
  }
  developUndisturbed(image);
  return true;
}

} // namespace schlieren
