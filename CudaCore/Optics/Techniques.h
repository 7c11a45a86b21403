// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The table of imaging techniques: what each value of Cutoff has. The stages, the filter and its panel take it from
// here.
#pragma once

#include <array>
#include <cstddef>

namespace schlieren
{

/// What makes light and dark of where light is bent to. eps: direction cosines along u and v; e = eps .
/// (cos angle, sin angle), along the knife edge's normal; k: Scene::kScale. Each ray's light is limited to
/// 0 ... 1; where the medium concentrates rays on a pixel, the pixel's intensity exceeds 1.
enum class Cutoff
{
  KnifeEdge,    ///< I = 1/2 - offset + k e; undisturbed light: 1/2 - offset
  Shadowgraph,  ///< I = 1 for every ray: where rays land makes the image
  BrightField,  ///< I = 1 - k |eps|: dark where light is bent; undisturbed: 1
  DarkField,    ///< I = k |eps|; undisturbed: 0
  GradedFilter, ///< I = Scene::gradedFilter at 1/2 - offset + k e
  ColorFilter, ///< the colour at k eps of Scene::colorFilter, or of a wheel: hue is the direction of eps,
               ///< saturation min(1, k |eps|)
  Interferogram, ///< I = (1 + cos(2 pi OPD / wavelength + carrier)) / 2; undisturbed: 1 without a carrier
  Background, ///< what a camera sees of a pattern behind the flow (BOS): the light of the place where its ray
              ///< meets the pattern. Undisturbed: the pattern's mean
  NumericalSchlieren, ///< I = exp(-5 k |eps|); undisturbed: 1
  PhaseContrast ///< a plate delays undisturbed light (Scene::phasePlate), of waves; of rays I = 1
};

/// Where the light that a technique records comes from.
enum class RecordedPlane
{
  Focus,     ///< a plane in the flow, Scene::focusOffset from its middle
  Screen,    ///< behind the flow, Scene::screenDistance from it
  Background ///< a camera looks at Scene::background, with rays that go backwards
};

/// When an image has colours of its own.
enum class Coloring
{
  None,
  Always,
  OfBackgroundImage, ///< where the pattern is PatternKind::Image
};

struct Technique
{
  Cutoff cutoff;
  const char* name; ///< as users read it
  /// The k |eps| that automatic k makes of strong deflections: 1/2 where light can become more or less than in the middle,
  /// else 1. 0: k is not used.
  double fullScale;
  bool hasEdge;    ///< a straight one, with an angle, an offset and another side
  bool hasFringes; ///< of the optical path, over a carrier
  RecordedPlane plane;
  Coloring coloring;

  constexpr bool hasK() const { return fullScale > 0; }
  /// Whether it shows where the squares that rays light lie beside each other: on a screen, and as fringes.
  constexpr bool showsSquares() const { return plane == RecordedPlane::Screen || hasFringes; }
};

/// The table, in the order of Cutoff.
constexpr std::array<Technique, 10> techniques = { {
  // cutoff, name, full scale, edge, fringes, plane, colours
  { Cutoff::KnifeEdge, "Knife Edge", 0.5, true, false, RecordedPlane::Focus, Coloring::None },
  { Cutoff::Shadowgraph, "Shadowgraph", 0, false, false, RecordedPlane::Screen, Coloring::None },
  { Cutoff::BrightField, "Bright Field", 1, false, false, RecordedPlane::Focus, Coloring::None },
  { Cutoff::DarkField, "Dark Field", 1, false, false, RecordedPlane::Focus, Coloring::None },
  { Cutoff::GradedFilter, "Graded Filter", 0.5, true, false, RecordedPlane::Focus, Coloring::None },
  { Cutoff::ColorFilter, "Color Filter", 1, false, false, RecordedPlane::Focus, Coloring::Always },
  { Cutoff::Interferogram, "Interferogram", 0, false, true, RecordedPlane::Focus, Coloring::None },
  { Cutoff::Background, "Background Oriented", 0, false, false, RecordedPlane::Background,
    Coloring::OfBackgroundImage },
  { Cutoff::NumericalSchlieren, "Numerical Schlieren", 1, false, false, RecordedPlane::Focus,
    Coloring::None },
  { Cutoff::PhaseContrast, "Phase Contrast", 0, false, false, RecordedPlane::Focus,
    Coloring::None },
} };

constexpr const Technique& techniqueOf(Cutoff cutoff)
{
  return techniques[static_cast<std::size_t>(cutoff)];
}

/// The error of an image that cannot be seen, in the unit of Scene::targetError: a grey level of 256, or a fiftieth of a
/// fringe or of a pixel.
constexpr double unseenError(const Technique& technique)
{
  return technique.hasFringes || technique.plane == RecordedPlane::Background ? 0.02 : 0.004;
}

/// Whether rays go backwards, from a camera to what is behind the flow.
constexpr bool isOfCamera(Cutoff cutoff)
{
  return techniqueOf(cutoff).plane == RecordedPlane::Background;
}

constexpr bool areInOrder()
{
  for (std::size_t i = 0; i < techniques.size(); ++i)
  {
    if (techniques[i].cutoff != static_cast<Cutoff>(i))
    {
      return false;
    }
  }
  return true;
}
static_assert(areInOrder(), "techniqueOf looks them up by their number");

} // namespace schlieren
