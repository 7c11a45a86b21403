// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqCutoffPlane.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

constexpr double side = 200, range = 1e-3; // a pixel is 1e-5 radians

using Plane = pqCutoffPlane;

Plane plane() { return { QRectF(10, 20, side, side), range }; }

pqCutoff knifeEdge(double angle = 0, double offset = 0)
{
  pqCutoff cutoff;
  cutoff.Kind = pqCutoff::KnifeEdge;
  cutoff.HasEdge = true;
  cutoff.K = 1000;
  cutoff.Angle = angle;
  cutoff.Offset = offset;
  return cutoff;
}

/// Where the mouse is that many pixels right of and above the middle.
QPointF at(double u, double v) { return { 110 + u, 120 - v }; }

} // namespace

TEST(CutoffPlane, RightAndUpAreDeflectionsToTheRightAndUp)
{
  const QPointF pixel = plane().pixelAt({ 2e-4, 5e-4 });
  EXPECT_DOUBLE_EQ(pixel.x(), at(20, 50).x());
  EXPECT_DOUBLE_EQ(pixel.y(), at(20, 50).y());
  const QPointF back = plane().deflectionAt(pixel);
  EXPECT_NEAR(back.x(), 2e-4, 1e-18);
  EXPECT_NEAR(back.y(), 5e-4, 1e-18);
}

TEST(CutoffPlane, AKnifeEdgePassesHalfAtItsEdgeAndAllBeyondFullScale)
{
  // I = 1/2 - offset + k e along 90 degrees: up.
  const pqCutoff cutoff = knifeEdge(90, 0.25);
  EXPECT_NEAR(cutoff.transmission({ 0, 0 }), 0.25, 1e-12);
  EXPECT_NEAR(cutoff.transmission({ 5e-4, 0.25e-3 }), 0.5, 1e-12);
  EXPECT_NEAR(cutoff.deflectionOf(0.5), 0.25e-3, 1e-15);
  EXPECT_EQ(cutoff.transmission({ 0, 0.76e-3 }), 1);
  EXPECT_EQ(cutoff.transmission({ 0, -0.26e-3 }), 0);
}

TEST(CutoffPlane, AnEdgeFromTheOtherSideStopsWhatPassedAndPassesWhatStopped)
{
  const double light = knifeEdge(0, 0.1).transmission({ 2e-4, 0 });
  EXPECT_NEAR(knifeEdge(180, -0.1).transmission({ 2e-4, 0 }), 1 - light, 1e-12);
}

TEST(CutoffPlane, OfADiscAnEdgeLeavesTheSegmentOfACircle)
{
  pqCutoff cutoff = knifeEdge();
  cutoff.IsOfDisc = true;
  EXPECT_NEAR(cutoff.transmission({ 0, 0 }), 0.5, 1e-12);
  // A chord at a quarter of the diameter cuts off 1/3 - sqrt(3)/(4 pi).
  EXPECT_NEAR(cutoff.transmission({ -0.25e-3, 0 }), 1 / 3. - std::sqrt(3.) / (4 * M_PI), 1e-12);
}

TEST(CutoffPlane, StopsDependOnTheDistanceAlone)
{
  pqCutoff cutoff = knifeEdge();
  cutoff.Kind = pqCutoff::BrightField;
  cutoff.HasEdge = false;
  EXPECT_NEAR(cutoff.transmission({ 3e-4, -4e-4 }), 0.5, 1e-12);
  cutoff.Kind = pqCutoff::DarkField;
  EXPECT_NEAR(cutoff.transmission({ -6e-4, 0 }), 0.6, 1e-12);
  cutoff.Kind = pqCutoff::NumericalSchlieren;
  EXPECT_NEAR(cutoff.transmission({ 0, 6e-4 }), std::exp(-3.), 1e-9);
}

TEST(CutoffPlane, TheMouseFindsLinesAndTheHandleThatTurns)
{
  const pqCutoff cutoff = knifeEdge(0, 0.1); // edge at 1e-4, full scale at -4e-4 and 6e-4
  EXPECT_EQ(plane().handleAt(cutoff, at(10, 60)), Plane::EdgeLine);
  EXPECT_EQ(plane().handleAt(cutoff, at(17, -60)), Plane::EdgeLine);
  EXPECT_EQ(plane().handleAt(cutoff, at(-40, 3)), Plane::DarkLine);
  EXPECT_EQ(plane().handleAt(cutoff, at(60, 3)), Plane::BrightLine);
  EXPECT_EQ(plane().handleAt(cutoff, at(84, 0)), Plane::TurnHandle);
  EXPECT_EQ(plane().handleAt(cutoff, at(30, 0)), Plane::NoHandle);
  pqCutoff none = cutoff;
  none.Kind = pqCutoff::NoCutoff;
  EXPECT_EQ(plane().handleAt(none, at(10, 60)), Plane::NoHandle);
  pqCutoff blind = cutoff;
  blind.K = 0;
  EXPECT_EQ(plane().handleAt(blind, at(0, 0)), Plane::NoHandle);
}

TEST(CutoffPlane, TheEdgeIsWhereItIsDragged)
{
  for (const double angle : { 0., 30., 135., 270. })
  {
    const pqCutoff start = knifeEdge(angle);
    const QPointF normal = start.normal();
    const QPointF to = at(20 * normal.x(), 20 * normal.y());
    const pqCutoff dragged = plane().dragged(start, Plane::EdgeLine, at(0, 0), to, false);
    EXPECT_NEAR(dragged.Offset, 0.2, 1e-12) << angle;
    EXPECT_NEAR(dragged.transmission(plane().deflectionAt(to)), 0.5, 1e-9) << angle;
    EXPECT_EQ(dragged.K, start.K);
  }
}

TEST(CutoffPlane, FullScaleIsWhereItIsDraggedAndUndisturbedLightAsBrightAsBefore)
{
  const pqCutoff start = knifeEdge(0, 0.1);
  const pqCutoff bright = plane().dragged(start, Plane::BrightLine, at(60, 0), at(30, 0), false);
  EXPECT_NEAR(bright.deflectionOf(1), 3e-4, 1e-9);
  EXPECT_EQ(bright.Offset, start.Offset);
  const pqCutoff dark = plane().dragged(start, Plane::DarkLine, at(-40, 0), at(-80, 0), false);
  EXPECT_NEAR(dark.deflectionOf(0), -8e-4, 1e-9);
  // Not through the middle: the line stays a pixel away.
  const pqCutoff through = plane().dragged(start, Plane::BrightLine, at(60, 0), at(-60, 0), false);
  EXPECT_NEAR(through.deflectionOf(1), 1e-5, 1e-8);
}

TEST(CutoffPlane, AtTheEndOfItsWayALineInTheMiddleHasNoScale)
{
  const pqCutoff start = knifeEdge(0, 0.5); // dark is what is not deflected
  EXPECT_EQ(plane().dragged(start, Plane::DarkLine, at(0, 0), at(30, 0), false).K, start.K);
}

TEST(CutoffPlane, TurningTakesAnglesFrom0To360InStepsOf15WhereRequested)
{
  const auto turned = [](double start, double degrees, bool inSteps)
  {
    const double angle = (start + degrees) * M_PI / 180;
    const pqCutoff cutoff = knifeEdge(start);
    return plane()
      .dragged(cutoff, Plane::TurnHandle, plane().turnHandle(cutoff),
        at(50 * std::cos(angle), 50 * std::sin(angle)), inSteps)
      .Angle;
  };
  EXPECT_NEAR(turned(0, 40.26, false), 40.3, 1e-9);
  EXPECT_NEAR(turned(30, -70, false), 320, 1e-9);
  EXPECT_NEAR(turned(0, 40, true), 45, 1e-9);
  EXPECT_NEAR(turned(350, 9, true), 0, 1e-9);
}

TEST(CutoffPlane, TheSizeOfStopsAndFiltersIsDraggedByTheirRim)
{
  pqCutoff wheel = knifeEdge();
  wheel.Kind = pqCutoff::ColorFilter;
  wheel.HasEdge = false;
  wheel.K = 2000; // 50 pixels
  EXPECT_EQ(plane().handleAt(wheel, at(30, 40)), Plane::SizeHandle);
  EXPECT_EQ(plane().handleAt(wheel, at(50, 50)), Plane::NoHandle);
  EXPECT_NEAR(
    plane().dragged(wheel, Plane::SizeHandle, at(30, 40), at(48, 64), false).K, 1250, 1e-9);
  pqCutoff square = wheel;
  square.IsSquare = true;
  EXPECT_EQ(plane().handleAt(square, at(50, 50)), Plane::SizeHandle);
  EXPECT_NEAR(
    plane().dragged(square, Plane::SizeHandle, at(50, 50), at(25, 25), false).K, 4000, 1e-9);
}

TEST(CutoffPlane, RangesAreRoundAndOneStepApart)
{
  EXPECT_DOUBLE_EQ(Plane::roundRange(0.0013, 0), 0.002);
  EXPECT_DOUBLE_EQ(Plane::roundRange(0.002, 0), 0.002);
  EXPECT_DOUBLE_EQ(Plane::roundRange(0.0051, 0), 0.01);
  double grown = 1e-6;
  for (const double next : { 2e-6, 5e-6, 1e-5, 2e-5 })
  {
    grown = Plane::roundRange(grown, 1);
    EXPECT_DOUBLE_EQ(grown, next);
  }
  for (const double next : { 1e-5, 5e-6, 2e-6, 1e-6, 5e-7 })
  {
    grown = Plane::roundRange(grown, -1);
    EXPECT_DOUBLE_EQ(grown, next);
  }
}

TEST(CutoffPlane, NumbersHaveAsManyDigitsAsRequested)
{
  EXPECT_DOUBLE_EQ(rounded(1234.56, 4), 1235);
  EXPECT_DOUBLE_EQ(rounded(-0.00123456, 3), -0.00123);
  EXPECT_DOUBLE_EQ(rounded(987654, 2), 990000);
  EXPECT_EQ(rounded(0, 3), 0);
}
