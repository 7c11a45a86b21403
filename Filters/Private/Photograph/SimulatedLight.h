// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The light of a simulated image for another cutoff, without another image: from its deflection or its optical path alone.
#pragma once

#include "Photograph/Fringes.h"
#include "Photograph/Plane.h"

#include <array>
#include <limits>
#include <string>
#include <vector>

class vtkImageData;

namespace filters
{

/**
 * The light of an image relative to what undisturbed light has behind the same cutoff, by which a photograph differs from one
 * without flow. Behind a knife edge, I = clip(1/2 - offset + k e.d) of the deflection e along the edge's normal d, so
 * I / I0 = clip(1 + contrast e.d, 0, 1 / (1/2 - offset)) with the contrast k / (1/2 - offset): the offset is seen only where
 * the edge lets all light pass.
 *
 * Parameters that a fit may change are numbers without bounds; see inWords for what they stand for:
 * - Knife Edge: ln contrast, artanh(offset / 0.48), angle;
 * - Graded Filter: ln of the factor to k, angle; the filter lies where it is simulated;
 * - Bright Field and Dark Field: ln k;
 * - Interferogram in light of one wavelength: artanh contrast, phase and tilts of its Fringes; the light is relative to bright
 *   fringes;
 * - other techniques: none; the light is Intensity.
 *
 * Where light is deflected along one direction only, all angles show the same but for the contrast, which takes up the cosine: a
 * fit changes the contrast and leaves the angle as it is.
 */
class SimulatedLight
{
public:
  /// Throws std::runtime_error where the arrays of an image of vtkSchlierenFilter are not there.
  explicit SimulatedLight(vtkImageData* image);

  using Parameters = std::vector<double>;
  /// The image's own.
  const Parameters& start() const { return this->Start; }
  /// Those that a fit should begin with: the edge on four sides, as nobody knows on which it was; on two where the angle is not
  /// seen, across the deflection if the image's edge lies along it. Of fringes the image's own, and those that are found in the
  /// photograph's light `seen`, where `known` is 1, and in that without flow, which may be empty.
  std::vector<Parameters> starts(
    const Plane& seen, const Plane& withoutFlow, const Plane& known) const;
  /// How many of the parameters, from the first on, a fit may change.
  std::size_t free() const { return this->Start.size() - (this->IsAngleHidden ? 1 : 0); }

  /// Returns the light relative to undisturbed light. Behind a Dark Field, which is dark without flow, it is
  /// relative to full light.
  Plane light(const Parameters& parameters) const;
  /// Whether a photograph without flow has that undisturbed light: it is dark behind a Dark Field, and may have fringes.
  bool isBrightWithoutFlow() const
  {
    return this->Is != Technique::DarkField && !this->hasFringes();
  }

  bool hasFringes() const { return this->Is == Technique::Interferogram; }
  /// Fringes with the opposite tilt and phase, which look the same without flow; and without any contrast.
  static Parameters mirrored(const Parameters& ofFringes);
  static bool areSame(const Parameters& ofFringes, const Parameters& others);
  static Parameters withoutContrast(const Parameters& ofFringes);

  /// Whether the fit has a contrast and an offset, which cannot always be separated.
  bool hasOffset() const { return this->Is == Technique::KnifeEdge; }
  /// Returns whether all light passes the edge at a point.
  std::vector<bool> isFull(const Parameters& parameters) const;

  /// What the parameters stand for; of what a technique does not have, NaN.
  struct Values
  {
    double contrast;            ///< relative change of the light per radian
    double k;                   ///< per radian
    double offset;              ///< of the knife edge, 0 to 1/2 further in
    double angle;               ///< degrees
    bool isAngleHidden = false; ///< whether the others hold for this angle, which is not seen
    double fringeContrast = std::numeric_limits<double>::quiet_NaN(); ///< 0 to 1, of light
    double fringePhase = 0; ///< at the image's middle, 0 to 1; 0 where undisturbed light is bright
    double fringeSpacing = 0; ///< data units; 0 with less than a quarter of a fringe in the image
    double fringeAngle = 0;   ///< as FringeAngle, 0 to 360 degrees
  };
  Values values(const Parameters& parameters) const;

  /// 1 where no ray of a pixel has ended in a solid.
  const Plane& open() const { return this->Open; }

private:
  enum class Technique
  {
    KnifeEdge,
    GradedFilter,
    BrightField,
    DarkField,
    Interferogram,
    Other
  };

  Technique Is = Technique::Other;
  Parameters Start;
  bool IsAngleHidden = false;
  double DeflectionAngle = 0; // of the direction along which light is deflected most, radians
  double KScale = 0;
  std::array<Plane, 2> Deflection;
  Plane Open;
  Plane Intensity; // of other techniques, relative to undisturbed light
  std::vector<double>
    Filter; // of a graded filter: light by the deflection, from Range[0] to Range[1]
  std::array<double, 2> Range{};
  Plane Turns;                      // of the optical path, wavelengths without whole ones
  std::array<double, 2> HalfSize{}; // from the middle to the last point, data units
};

} // namespace filters
