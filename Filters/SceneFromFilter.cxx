// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneFromFilter.h"

#include "vtkSchlierenFilter.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

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

} // namespace

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
int threadsFrom(vtkSchlierenFilter* self)
{
  const char* limit = std::getenv("VTK_SMP_MAX_THREADS");
  return self->GetNumberOfThreads() > 0 || !limit ? self->GetNumberOfThreads()
                                                  : std::max(0, std::atoi(limit));
}

//------------------------------------------------------------------------------
schlieren::Scene sceneFrom(vtkSchlierenFilter* self)
{
  schlieren::Scene scene;
  scene.view = viewFrom(self);
  scene.cutoff = self->GetCutoff() == vtkSchlierenFilter::SHADOWGRAPH
    ? schlieren::Cutoff::Shadowgraph
    : schlieren::Cutoff::KnifeEdge;
  scene.knifeEdgeAngle = self->GetKnifeEdgeAngle();
  scene.invertCutoff = self->GetInvertCutoff();
  if (!self->GetAutoKScale())
  {
    scene.kScale = self->GetKScale();
  }
  if (!(self->GetScreenDistance() < 0)) // NaN too, which the core then reports
  {
    scene.screenDistance = self->GetScreenDistance();
  }
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
  scene.device = static_cast<schlieren::Device>(self->GetDevice());
  scene.threads = threadsFrom(self);
  return scene;
}
