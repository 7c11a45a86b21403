// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The tracer against the reference tracer: images of each technique.
#include "ReferenceMedia.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace schlieren
{

namespace
{

using namespace reference;

struct Named
{
  const char* name;
  Scene scene;
  double ofTubes; ///< the error that ray tubes may make
};

/// A view so near that light varies little from pixel to pixel.
Scene nearScene(const Vector& direction)
{
  Scene scene = exactScene(direction);
  scene.view.parallelScale = 0.04;
  scene.view.width = 5;
  scene.view.height = 4;
  scene.kScale = 15;
  return scene;
}

/// Where light is spread evenly, as it is in focus, what ray tubes add is of fourth order in the pixels. Else light that is
/// spread evenly over a cell of rays is wrong by up to an eighth of how much its density changes from cell to cell.
constexpr double even = 1e-6;
/// Light is made steeper, so that its interpolation has the right means, but no more than 1 or less than 0.
constexpr double crests = 2e-4;

/// Each technique.
std::vector<Named> techniquesIn(const Vector& direction)
{
  std::vector<Named> all;
  const auto add = [&](const char* name, double ofTubes, const std::function<void(Scene&)>& set)
  {
    Scene scene = nearScene(direction);
    set(scene);
    all.push_back({ name, scene, ofTubes });
  };
  add("knife edge", even,
    [](Scene& scene)
    {
      scene.knifeEdgeAngle = 30;
      scene.cutoffOffset = 0.05;
    });
  add("inverted knife edge", 5e-6,
    [](Scene& scene)
    {
      scene.invertCutoff = true;
      scene.focusOffset = 0.7;
    });
  add("knife edge and disc", even,
    [](Scene& scene)
    {
      scene.knifeEdgeAngle = 75;
      scene.cutoffOffset = -0.1;
      scene.source.shape = SourceShape::Disc;
      scene.source.width = 0.01;
    });
  add("graded filter", even,
    [](Scene& scene)
    {
      scene.cutoff = Cutoff::GradedFilter;
      scene.gradedFilter = { 0.1, 0.3, 0.9, 0.6, 0.7 };
      scene.knifeEdgeAngle = -60;
    });
  add("circular", even, [](Scene& scene) { scene.cutoff = Cutoff::Circular; });
  add("circular complement", even, [](Scene& scene) { scene.cutoff = Cutoff::CircularComplement; });
  add("numerical schlieren", even, [](Scene& scene) { scene.cutoff = Cutoff::NumericalSchlieren; });
  add("colour wheel", even, [](Scene& scene) { scene.cutoff = Cutoff::ColorFilter; });
  add("shadowgraph", 1.5e-3,
    [](Scene& scene)
    {
      scene.cutoff = Cutoff::Shadowgraph;
      scene.screenDistance = 6;
    });
  add("shadowgraph of a point source", 1e-4,
    [](Scene& scene)
    {
      scene.cutoff = Cutoff::Shadowgraph;
      scene.source.distance = 5;
    });
  add("shadowgraph with a perspective", 1e-4,
    [](Scene& scene)
    {
      scene.cutoff = Cutoff::Shadowgraph;
      scene.view.viewAngle = 3;
    });
  add("interferogram", crests,
    [](Scene& scene)
    {
      scene.cutoff = Cutoff::Interferogram;
      scene.wavelength = 1e-4;
    });
  add("interferogram with finite fringes", crests,
    [](Scene& scene)
    {
      scene.cutoff = Cutoff::Interferogram;
      scene.wavelength = 2e-4;
      scene.fringes.finite = true;
      scene.fringes.spacing = 1.5;
      scene.fringes.angle = 25;
      scene.focusOffset = 0.5;
    });
  add("interferogram of a point source", crests,
    [](Scene& scene)
    {
      scene.cutoff = Cutoff::Interferogram;
      scene.wavelength = 1e-4;
      scene.source.distance = 5;
      scene.focusOffset = 0.5;
    });
  add("interferogram with a perspective", crests,
    [](Scene& scene)
    {
      scene.cutoff = Cutoff::Interferogram;
      scene.wavelength = 1e-4;
      scene.view.viewAngle = 3;
    });
  add("stripes", even,
    [](Scene& scene)
    {
      scene.cutoff = Cutoff::Background;
      scene.background.kind = PatternKind::Stripes;
      scene.background.period = 0.9;
      scene.background.angle = -30;
      scene.background.distance = 10;
    });
  add("stripes with a perspective", 2e-6,
    [](Scene& scene)
    {
      scene.cutoff = Cutoff::Background;
      scene.background.kind = PatternKind::Stripes;
      scene.background.period = 2.7; // three times as far away as the image's plane
      scene.background.angle = 90;
      scene.view.viewAngle = 3;
    });
  add("dots", 1e-2,
    [](Scene& scene)
    {
      scene.cutoff = Cutoff::Background;
      scene.background.period = 0.4;
    });
  return all;
}

/// Splats are sums over rays, and differ by rounding alone.
TEST(ReferenceTechniques, OfSplats)
{
  const Medium medium = polynomial(0.02);
  for (const Vector& direction : { Vector{ 0, 0, -1 }, oblique })
  {
    for (Named technique : techniquesIn(direction))
    {
      SCOPED_TRACE(technique.name);
      technique.scene.filmEstimator = FilmEstimator::Photon;
      EXPECT_LT(differenceOf(medium, technique.scene), 1e-6);
    }
  }
}

/// All light of a pass is of one point of the source.
TEST(ReferenceTechniques, OfExtendedSources)
{
  const Medium medium = polynomial(0.02);
  for (const SourceShape shape : { SourceShape::Slit, SourceShape::Disc })
  {
    for (const Cutoff cutoff : { Cutoff::KnifeEdge, Cutoff::Shadowgraph, Cutoff::Interferogram })
    {
      for (const bool isNear : { false, true })
      {
        SCOPED_TRACE(static_cast<int>(cutoff));
        Scene scene = nearScene(oblique);
        scene.filmEstimator = FilmEstimator::Photon;
        scene.samplesPerPixel = 3;
        scene.cutoff = cutoff;
        scene.knifeEdgeAngle = 20;
        scene.focusOffset = 0.4;
        scene.screenDistance = 1;
        scene.wavelength = 1e-3;
        scene.source.shape = shape;
        scene.source.width = 0.03;
        scene.source.length = 0.02;
        scene.source.distance = isNear ? std::optional<double>(4) : std::nullopt;
        EXPECT_LT(differenceOf(medium, scene), 1e-6);
      }
    }
  }
}

/// All light of a pass is of one point of the camera's aperture.
TEST(ReferenceTechniques, OfApertures)
{
  const Medium medium = polynomial(0.02);
  for (const Cutoff cutoff : { Cutoff::KnifeEdge, Cutoff::Interferogram, Cutoff::Background })
  {
    SCOPED_TRACE(static_cast<int>(cutoff));
    Scene scene = nearScene(oblique);
    scene.filmEstimator = FilmEstimator::Photon;
    scene.samplesPerPixel = 3;
    scene.cutoff = cutoff;
    scene.focusOffset = 0.4;
    scene.wavelength = 1e-3;
    scene.background.kind = PatternKind::Stripes;
    scene.background.period = 2;
    scene.view.viewAngle = 3;
    scene.lens.aperture = 0.1;
    EXPECT_LT(differenceOf(medium, scene), 1e-6);
  }
}

/// To first order, a path through a flow in focus is as long on the film as that straight through the flow.
TEST(ReferenceTechniques, OfStraightInterferograms)
{
  const Medium medium = ball(1e-3, Interpolation::Cubic, 48);
  Scene scene = nearScene({ 0, 0, -1 });
  scene.cutoff = Cutoff::Interferogram;
  scene.filmEstimator = FilmEstimator::Photon;
  scene.view.focalPoint = Vector{ 0.3, -0.05, 0.05 }; // where it is steepest
  scene.focusOffset = 0.05;
  scene.pathModel = PathModel::Straight;
  // It is off by eps^2 / 2 of the ball's width, 0.02 fringes. That of the data's depth would be 0.2.
  EXPECT_LT(differenceOf(medium, scene), 0.1);
}

TEST(ReferenceTechniques, OfRayTubes)
{
  const Medium medium = polynomial(0.02);
  for (Named& technique : techniquesIn({ 0, 0, -1 }))
  {
    SCOPED_TRACE(technique.name);
    technique.scene.wavelength *= 10; // wider than pixels
    EXPECT_LT(differenceOf(medium, technique.scene), technique.ofTubes);
  }
}

} // namespace

} // namespace schlieren
