// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RealOptics.h"

#include "vtkMath.h"
#include "vtkSchlierenFilter.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace
{

using Filter = vtkSchlierenFilter;

/// From a diverging source to the middle of the data, and from fringe to fringe, by default.
constexpr double depthsToSource = 10;
constexpr double fringesInPicture = 10;

std::string textOf(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

[[noreturn]] void refuse(
  const char* property, double value, const std::string& unit, const std::string& advice)
{
  throw std::runtime_error(
    std::string(property) + " is " + textOf(value) + " " + unit + ", " + advice);
}

void requirePositive(
  const char* property, double value, const std::string& unit, const std::string& owner)
{
  if (!(value > 0) || !std::isfinite(value))
  {
    refuse(property, value, unit, "but it has to be positive. Set it to that of " + owner + ".");
  }
}

void requireSize(const char* property, double value)
{
  if (!(value >= 0) || !std::isfinite(value))
  {
    refuse(property, value, "mm", "which is no size. Set it to 0 or more.");
  }
}

} // namespace

//------------------------------------------------------------------------------
bool usesK(vtkSchlierenFilter* self) { return Filter::CutoffHasK(self->GetCutoff()); }

//------------------------------------------------------------------------------
bool choosesK(vtkSchlierenFilter* self)
{
  return usesK(self) && !self->GetKFromOptics() && self->GetAutoKScale();
}

//------------------------------------------------------------------------------
void setSensitivity(vtkSchlierenFilter* self, schlieren::Scene& scene)
{
  scene.cutoffOffset = self->GetCutoffOffset();
  if (self->GetKFromOptics())
  {
    requirePositive("FocalLength", self->GetFocalLength(), "m", "the second mirror");
    requirePositive("SourceWidth", self->GetSourceWidth(), "mm", "the source's image");
    if (!std::isfinite(self->GetCutoffPosition()))
    {
      refuse("CutoffPosition", self->GetCutoffPosition(), "mm",
        "which is no place. Set it to how far the edge is in, 0 for the middle.");
    }
    scene.kScale = self->GetKScaleOfOptics();
    scene.cutoffOffset = self->GetCutoffOffsetOfOptics();
  }
  else if (!self->GetAutoKScale())
  {
    scene.kScale = self->GetKScale();
  }
}

//------------------------------------------------------------------------------
std::string kInWords(double k, bool isKept)
{
  return (isKept ? "k locked at " : "k = ") + textOf(k);
}

//------------------------------------------------------------------------------
std::string sensitivityInWords(vtkSchlierenFilter* self, double k, bool isKept)
{
  if (Filter::CutoffHasFringes(self->GetCutoff()))
  {
    return self->GetWhiteLight()
      ? "white light: a fringe of each colour is its wavelength of optical path"
      : "a fringe is " + textOf(self->GetWavelength()) +
        " nm of optical path: Wavelength, in the group Medium";
  }
  if (!usesK(self) || !(k > 0))
  {
    return "";
  }
  const double focalLength = self->GetFocalLength();
  // From the light that nothing bends to the brightest or the darkest.
  const schlieren::Technique& technique =
    schlieren::techniqueOf(static_cast<schlieren::Cutoff>(self->GetCutoff()));
  std::string words = kInWords(k, isKept) + ": full scale is a deflection of " +
    textOf(1e3 * technique.fullScale / k) + " mrad";
  if (focalLength > 0)
  {
    words += "; optics: " + textOf(focalLength) + " m focal length, source " +
      textOf(focalLength / k / metresPerMillimetre) + " mm wide";
  }
  if (self->GetKFromOptics() && technique.hasEdge)
  {
    words += ", the edge " + textOf(self->GetCutoffPosition()) + " mm in (offset " +
      textOf(self->GetCutoffOffsetOfOptics()) + ")";
  }
  return words;
}

//------------------------------------------------------------------------------
schlieren::LightSource lightSourceFrom(vtkSchlierenFilter* self, const schlieren::Frame& frame)
{
  schlieren::LightSource source;
  if (self->GetLightSource() == Filter::DIVERGING)
  {
    const double distance = self->GetSourceDistance();
    source.distance = distance == 0 ? depthsToSource * (frame.exit - frame.entry) : distance;
  }
  source.shape = static_cast<schlieren::SourceShape>(self->GetSourceShape());
  if (source.shape != schlieren::SourceShape::Point)
  {
    requirePositive("FocalLength", self->GetFocalLength(), "m", "the mirrors");
    requireSize("SourceWidth", self->GetSourceWidth());
    source.width = metresPerMillimetre * self->GetSourceWidth() / self->GetFocalLength();
  }
  if (source.shape == schlieren::SourceShape::Slit)
  {
    requireSize("SourceLength", self->GetSourceLength());
    source.length = metresPerMillimetre * self->GetSourceLength() / self->GetFocalLength();
  }
  return source;
}

//------------------------------------------------------------------------------
double fringeSpacingFrom(vtkSchlierenFilter* self, const schlieren::Frame& frame)
{
  const double angle = self->GetBeamAngle();
  if (!(angle >= 0 && angle <= 180))
  {
    refuse("BeamAngle", angle, "degrees",
      "but beams cross at 0 to 180 degrees. Set it to that, or to 0 and give FringeSpacing.");
  }
  if (angle > 0)
  {
    const double wavelength = metresPerNanometre * self->GetWavelength();
    return wavelength / (2 * std::sin(vtkMath::RadiansFromDegrees(angle) / 2)) /
      self->GetLengthScale();
  }
  return self->GetFringeSpacing() == 0
    ? frame.pixelSize * self->GetImageSize()[1] / fringesInPicture
    : self->GetFringeSpacing();
}
