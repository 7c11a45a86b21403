// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneFromFilter.h"

#include "GasChoices.h"
#include "HurriedPicture.h"
#include "RealOptics.h"
#include "RgbPictures.h"

#include "vtkPiecewiseFunction.h"
#include "vtkSchlierenFilter.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace
{

/// Whether an enumeration of the filter has the same values as one of the tracer.
template <class Core, class Enum>
constexpr bool sameValue(Enum value, Core ofCore)
{
  return static_cast<Core>(value) == ofCore;
}

using Self = vtkSchlierenFilter;
static_assert(sameValue(Self::AUTO_PATH, schlieren::PathModel::Auto) &&
  sameValue(Self::STRAIGHT, schlieren::PathModel::Straight) &&
  sameValue(Self::REFRACTED, schlieren::PathModel::Refracted));
static_assert(sameValue(Self::LEAPFROG, schlieren::Integrator::Leapfrog) &&
  sameValue(Self::RK4, schlieren::Integrator::Rk4) &&
  sameValue(Self::ADAPTIVE, schlieren::Integrator::Adaptive) &&
  sameValue(Self::EULER, schlieren::Integrator::Euler));
static_assert(sameValue(Self::QUADRATIC, schlieren::Interpolation::Quadratic) &&
  sameValue(Self::LINEAR, schlieren::Interpolation::Linear) &&
  sameValue(Self::CENTRAL, schlieren::Interpolation::Central) &&
  sameValue(Self::CUBIC, schlieren::Interpolation::Cubic));
static_assert(sameValue(Self::SINGLE, schlieren::Precision::Single) &&
  sameValue(Self::DOUBLE, schlieren::Precision::Double));
static_assert(sameValue(Self::AUTO, schlieren::Device::Auto) &&
  sameValue(Self::CPU, schlieren::Device::Cpu) && sameValue(Self::CUDA, schlieren::Device::Cuda));
static_assert(sameValue(Self::KNIFE_EDGE, schlieren::Cutoff::KnifeEdge) &&
  sameValue(Self::SHADOWGRAPH, schlieren::Cutoff::Shadowgraph) &&
  sameValue(Self::CIRCULAR, schlieren::Cutoff::Circular) &&
  sameValue(Self::CIRCULAR_COMPLEMENT, schlieren::Cutoff::CircularComplement) &&
  sameValue(Self::GRADED_FILTER, schlieren::Cutoff::GradedFilter) &&
  sameValue(Self::COLOR_FILTER, schlieren::Cutoff::ColorFilter) &&
  sameValue(Self::INTERFEROGRAM, schlieren::Cutoff::Interferogram) &&
  sameValue(Self::BACKGROUND_ORIENTED, schlieren::Cutoff::Background) &&
  Self::BACKGROUND_ORIENTED + 1 == schlieren::techniques.size());
static_assert(sameValue(Self::POINT, schlieren::SourceShape::Point) &&
  sameValue(Self::SLIT, schlieren::SourceShape::Slit) &&
  sameValue(Self::DISC, schlieren::SourceShape::Disc));
static_assert(sameValue(Self::DOTS, schlieren::PatternKind::Dots) &&
  sameValue(Self::STRIPES, schlieren::PatternKind::Stripes) &&
  sameValue(Self::PICTURE, schlieren::PatternKind::Picture));
static_assert(sameValue(Self::SHEET, schlieren::FilmEstimator::Sheet) &&
  sameValue(Self::PHOTON, schlieren::FilmEstimator::Photon));
static_assert(sameValue(Self::NO_FILTER, schlieren::NoiseFilter::None) &&
  sameValue(Self::GAUSSIAN, schlieren::NoiseFilter::Gaussian) &&
  sameValue(Self::MEAN, schlieren::NoiseFilter::Mean) &&
  sameValue(Self::CONE, schlieren::NoiseFilter::Cone));

/// Where a graded filter is read off.
constexpr int gradedFilterSamples = 1025;

std::vector<double> gradedFilterFrom(vtkPiecewiseFunction* function)
{
  if (!function || function->GetSize() == 0)
  {
    return { 0, 1 };
  }
  std::vector<double> values(gradedFilterSamples);
  function->GetTable(0, 1, gradedFilterSamples, values.data());
  return values;
}

schlieren::Fringes fringesFrom(
  vtkSchlierenFilter* self, vtkRefractiveIndex* medium, const schlieren::Frame& frame)
{
  schlieren::Fringes fringes;
  fringes.finite = self->GetFringeMode() == vtkSchlierenFilter::FINITE_FRINGES;
  if (fringes.finite)
  {
    fringes.spacing = fringeSpacingFrom(self, frame);
    fringes.angle = self->GetFringeAngle();
  }
  fringes.whiteLight = self->GetWhiteLight();
  if (fringes.whiteLight)
  {
    fringes.dispersion =
      refractivity::dispersionOfGases(medium, metresPerNanometre * self->GetWavelength());
  }
  return fringes;
}

schlieren::BackgroundPattern backgroundFrom(vtkSchlierenFilter* self, RgbPictureReader& pictures)
{
  schlieren::BackgroundPattern pattern;
  pattern.kind = static_cast<schlieren::PatternKind>(self->GetBackgroundPattern());
  if (!(self->GetBackgroundDistance() < 0))
  {
    pattern.distance = self->GetBackgroundDistance();
  }
  pattern.period = self->GetBackgroundPeriod();
  pattern.angle = self->GetBackgroundAngle();
  if (pattern.kind == schlieren::PatternKind::Picture)
  {
    if (!*self->GetBackgroundImage())
    {
      throw std::runtime_error(
        "BackgroundImage is empty, so there is no image behind the flow. Give "
        "the name of one, or set BackgroundPattern to Dots or Stripes.");
    }
    pattern.picture = pictures.read("BackgroundImage", self->GetBackgroundImage());
  }
  return pattern;
}

/// Of the whole picture.
schlieren::View viewFrom(vtkSchlierenFilter* self)
{
  schlieren::View view;
  std::copy_n(self->GetViewDirection(), 3, view.viewDirection.begin());
  std::copy_n(self->GetViewUp(), 3, view.viewUp.begin());
  if (self->GetHasFocalPoint())
  {
    const double* point = self->GetFocalPoint();
    view.focalPoint = schlieren::Vector{ point[0], point[1], point[2] };
  }
  view.parallelScale = self->GetParallelScale();
  view.width = self->GetImageSize()[0];
  view.height = self->GetImageSize()[1];
  return view;
}

} // namespace

//------------------------------------------------------------------------------
schlieren::Frame frameFrom(vtkSchlierenFilter* self, const schlieren::Grid& grid)
{
  const schlieren::View view = viewFrom(self);
  const schlieren::Frame frame = schlieren::frameOf(grid, view);
  const int reduction = self->GetPreviewReduction();
  return reduction > 1 ? schlieren::frameOf(grid, hurriedView(view, frame, reduction)) : frame;
}

//------------------------------------------------------------------------------
int threadsFrom(vtkSchlierenFilter* self)
{
  const char* limit = std::getenv("VTK_SMP_MAX_THREADS");
  return self->GetNumberOfThreads() > 0 || !limit ? self->GetNumberOfThreads()
                                                  : std::max(0, std::atoi(limit));
}

//------------------------------------------------------------------------------
schlieren::Scene sceneFrom(vtkSchlierenFilter* self, vtkRefractiveIndex* medium,
  const schlieren::Grid& grid, RgbPictureReader& pictures)
{
  schlieren::Scene scene;
  scene.view = viewFrom(self);
  const schlieren::Frame frame = schlieren::frameOf(grid, scene.view);
  scene.source = lightSourceFrom(self, frame);
  scene.cutoff = static_cast<schlieren::Cutoff>(self->GetCutoff());
  scene.knifeEdgeAngle = self->GetKnifeEdgeAngle();
  scene.invertCutoff = self->GetInvertCutoff();
  // What another cutoff needs may hold anything.
  if (usesK(self))
  {
    setSensitivity(self, scene);
  }
  switch (scene.cutoff)
  {
    case schlieren::Cutoff::GradedFilter:
      scene.gradedFilter = gradedFilterFrom(self->GetGradedFilter());
      break;
    case schlieren::Cutoff::ColorFilter:
      if (*self->GetColorFilterImage())
      {
        scene.colorFilter = pictures.read("ColorFilterImage", self->GetColorFilterImage());
      }
      break;
    case schlieren::Cutoff::Interferogram:
      scene.wavelength = metresPerNanometre * self->GetWavelength();
      scene.fringes = fringesFrom(self, medium, frame);
      break;
    case schlieren::Cutoff::Background:
      scene.background = backgroundFrom(self, pictures);
      break;
    default:
      break;
  }
  if (!(self->GetScreenDistance() < 0)) // NaN too, which the core then reports
  {
    scene.screenDistance = self->GetScreenDistance();
  }
  scene.focusOffset = self->GetFocusOffset();
  scene.filmEstimator = static_cast<schlieren::FilmEstimator>(self->GetFilmEstimator());
  scene.noiseFilter = static_cast<schlieren::NoiseFilter>(self->GetNoiseFilter());
  scene.noiseFilterRadius = self->GetNoiseFilterRadius();
  scene.histogramSize = self->GetHistogramSize();
  scene.memoryBudget = static_cast<std::size_t>(self->GetMemoryBudget()) << 20;
  scene.samplesPerPixel = self->GetSamplesPerPixel();
  scene.seed = static_cast<std::uint32_t>(self->GetSeed());
  scene.pathModel = static_cast<schlieren::PathModel>(self->GetPathModel());
  scene.integrator = static_cast<schlieren::Integrator>(self->GetIntegrator());
  scene.stepSize = self->GetStepSize();
  scene.homogeneityTolerance = self->GetHomogeneityTolerance();
  scene.interpolation = static_cast<schlieren::Interpolation>(self->GetInterpolation());
  scene.precision = static_cast<schlieren::Precision>(self->GetPrecision());
  scene.adaptiveTolerance = self->GetAdaptiveTolerance();
  scene.pathTolerance = self->GetPathTolerance();
  scene.mediumTolerance = self->GetMediumTolerance();
  scene.mediumMemory = static_cast<std::size_t>(self->GetMediumMemory()) << 20;
  scene.device = static_cast<schlieren::Device>(self->GetDevice());
  scene.threads = threadsFrom(self);
  if (self->GetPreviewReduction() > 1)
  {
    hurry(scene, frame, self->GetPreviewReduction());
  }
  return scene;
}
