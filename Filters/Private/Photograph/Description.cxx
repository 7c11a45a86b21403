// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photograph/Description.h"

#include "NumberText.h"
#include "PhotographSettings.h"

#include <cmath>
#include <string>

namespace filters
{

namespace
{

std::string percent(double fraction) { return textOf(100 * fraction, 2) + " %"; }

} // namespace

void describe(
  Compared& result, const Grid& image, const PhotographSettings& settings, bool isFitted)
{
  auto& sentences = result.sentences;
  sentences.push_back("The photograph has " + textOf(result.scale) +
    " data units per pixel, is turned by " + textOf(result.rotation, 4) +
    " degrees, and its middle is at " + textOf(result.middle[0]) + ", " + textOf(result.middle[1]) +
    ".");
  if (settings.FitPlace == PhotographSettings::FIT_FLOW)
  {
    sentences.emplace_back("Warning: it was placed by its flow, which hides where shocks and other "
                           "features lie elsewhere than simulated.");
    result.notes.emplace_back("photograph placed by its flow: shifts are hidden");
  }
  if (!isFitted)
  {
    sentences.emplace_back(
      "There is no light in it that a camera and a cutoff could be fitted to: its values are all "
      "the same, or saturated.");
    return;
  }
  const auto& cutoff = result.cutoff;
  const auto about = [](double value, double uncertainty)
  { return textOf(value, 4) + " +- " + textOf(value * uncertainty, 2) + " per rad"; };
  if (std::isfinite(cutoff.contrast))
  {
    const std::string contrast = about(cutoff.contrast, result.contrastUncertainty);
    sentences.push_back("Its contrast, the relative change of the light, is " + contrast + ".");
    result.notes.push_back("photograph: contrast " + contrast);
  }
  if (result.lacksFringes)
  {
    sentences.emplace_back("No fringes are found in it: light without them explains it as well. "
                           "Correct the place, or set MirrorRadius to what shows the flow.");
  }
  if (std::isfinite(cutoff.fringeContrast))
  {
    const std::string fringes = cutoff.fringeSpacing > 0
      ? "are " + textOf(cutoff.fringeSpacing, 4) + " data units apart at " +
        textOf(cutoff.fringeAngle, 4) + " degrees"
      : "are infinite";
    sentences.push_back("Its fringes " + fringes + ", with a contrast of " +
      textOf(cutoff.fringeContrast, 3) + " and a phase of " + textOf(cutoff.fringePhase, 3) +
      " fringes at the image's middle, up to whole ones.");
    if (!result.isTiltKnown)
    {
      sentences.emplace_back("The sign of the reference beam's tilt and phase is not seen: fringes "
                             "at 180 degrees more, with the opposite phase, fit as well.");
    }
    result.notes.push_back("photograph: fringes " + fringes);
  }
  if (cutoff.isAngleHidden)
  {
    sentences.push_back("Light is deflected along one direction only, so the cutoff's angle is not "
                        "seen; the numbers are those of a cutoff at " +
      textOf(cutoff.angle, 4) + " degrees.");
  }
  else if (std::isfinite(cutoff.angle))
  {
    sentences.push_back("The cutoff's angle is " + textOf(cutoff.angle, 4) + " +- " +
      textOf(result.angleUncertainty, 2) + " degrees.");
  }
  if (std::isfinite(cutoff.offset) && !result.isKKnown)
  {
    sentences.push_back("k and offset cannot be separated: all light passes the edge at " +
      percent(result.fullFraction) + " of the points, and 1 % are needed.");
    result.notes.emplace_back("k and offset cannot be separated");
  }
  else if (std::isfinite(cutoff.k))
  {
    sentences.push_back("k is " + about(cutoff.k, result.kUncertainty) +
      (std::isfinite(cutoff.offset) ? ", the offset " + textOf(cutoff.offset, 3) +
            "; all light passes the edge at " + percent(result.fullFraction) + " of the points."
                                    : "."));
    result.notes.push_back("photograph: k = " + about(cutoff.k, result.kUncertainty));
  }
  sentences.push_back("The black level is " + textOf(result.black, 3) + ".");
  if (result.shift)
  {
    const std::string shift = textOf(result.shiftMedian, 3) + " data units (" +
      textOf(result.shiftMedian / image.spacing[0], 2) + " pixels of the image)";
    sentences.push_back("Half of its features lie within " + shift +
      " of where they are simulated, 95 % within " + textOf(result.shiftLarge, 3) + ".");
    result.notes.push_back("features: half within " + shift);
  }
  sentences.push_back("Photograph and simulated image differ by " + textOf(result.residual, 2) +
    " of white (root mean square), with a correlation of " + textOf(result.correlation, 4) + ".");
}

} // namespace filters
