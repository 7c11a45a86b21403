// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Benches that have one medium together: what is made once, and when images are those of a bench of its own.
#include "AnalyticSources.h"
#include "Fields.h"
#include "PeakMemory.h"
#include "SameImage.h"

#include <array>
#include <cstddef>
#include <stdexcept>
#include <thread>
#include <vector>

namespace schlieren
{

namespace
{

std::shared_ptr<BallsSource> balls()
{
  return std::make_shared<BallsSource>(
    std::vector<Ball>{ { { 0.4, 0.1, 0.2 }, 0.1, 1e-4 }, { { -0.5, -0.2, 0 }, 0.15, 2e-4 } });
}

/// A source that fails to describe its content, or to sample it.
class FailingBalls : public BallsSource
{
public:
  using BallsSource::BallsSource;

  Content contentOf(const Box& box) const override
  {
    failIf(failsContents);
    return BallsSource::contentOf(box);
  }
  void sample(
    const Lattice& lattice, double* refractivity, Place* places, float* distances) const override
  {
    failIf(failsSamples);
    BallsSource::sample(lattice, refractivity, places, distances);
  }

  bool failsContents = false, failsSamples = false;

private:
  static void failIf(bool fails)
  {
    if (fails)
    {
      throw std::runtime_error("lost");
    }
  }
};

Scene sceneTowards(const Vector& direction)
{
  Scene scene = sceneOnCpu(80, 60, direction);
  scene.histogramSize = 8;
  return scene;
}

const Vector front{ 0, 0, -1 }, aside{ -1, 0.3, -0.2 };

/// Benches with media of their own, and as many together.
struct Together
{
  std::shared_ptr<SharedMedia> media = std::make_shared<SharedMedia>();
  Bench first, second, third;

  Together()
  {
    for (Bench* bench : { &first, &second, &third })
    {
      bench->setMedia(media);
    }
  }
  std::int64_t builds() const
  {
    return first.work().mediumBuilds + second.work().mediumBuilds + third.work().mediumBuilds;
  }
};

/// The same images as one bench makes that looks at all views, one after the other.
void expectImagesOfOneBench(const Field& field)
{
  Together together;
  Bench one;
  const Scene scenes[] = { sceneTowards(front), sceneTowards(aside),
    sceneTowards({ 0.2, -0.5, -1 }) };
  Bench* benches[] = { &together.first, &together.second, &together.third };
  for (std::size_t n = 0; n < 3; ++n)
  {
    SCOPED_TRACE(n);
    expectSameImage(benches[n]->render(field, scenes[n]), one.render(field, scenes[n]));
    EXPECT_EQ(together.media->count(), 1);
  }
  EXPECT_EQ(together.builds(), 1);
  EXPECT_EQ(benches[0]->work().mediumBuilds, 1);
}

/// Goes on to the end, as something else is done before each piece.
template <class Meanwhile>
Image inPieces(Bench& bench, const Field& field, const Scene& scene, const Meanwhile& meanwhile)
{
  Monitor soon;
  soon.paused = [] { return true; };
  Image image = bench.render(field, scene, soon);
  for (int piece = 0; !image.finished; ++piece)
  {
    meanwhile(piece);
    image = bench.resume(soon);
  }
  return image;
}

TEST(SharedMedia, OneMediumForAllViewsOfAnImage) { expectImagesOfOneBench(blobField().field); }

TEST(SharedMedia, OneMediumForAllViewsOfASource) { expectImagesOfOneBench(fieldOf(balls())); }

TEST(SharedMedia, WhatTheMediumDependsOnMakesAnother)
{
  const SampledField<float> data = blobField(), others = blobField();
  Together together;
  const Scene scene = sceneTowards(front);
  together.first.render(data.field, scene);
  const auto expectOther = [&](const char* what, const Field& field, const Scene& of)
  {
    SCOPED_TRACE(what);
    Bench bench;
    bench.setMedia(together.media);
    expectSameImage(bench.render(field, of), Bench().render(field, of));
    EXPECT_EQ(bench.work().mediumBuilds, 1);
    EXPECT_EQ(together.media->count(), 2);
  };
  expectOther("data", others.field, scene);
  Field field = data.field;
  ++field.version;
  expectOther("version", field, scene);
  field = data.field;
  field.ambient = 1e-5;
  expectOther("ambient", field, scene);
  Scene other = scene;
  other.interpolation = Interpolation::Cubic;
  expectOther("interpolation", data.field, other);
  other = scene;
  other.precision = Precision::Double;
  expectOther("precision", data.field, other);

  const Field ofSource = fieldOf(balls());
  together.first.render(ofSource, scene);
  other = scene;
  other.mediumTolerance = 0.02;
  expectOther("tolerance", ofSource, other);
  other = scene;
  other.mediumMemory /= 2;
  expectOther("memory", ofSource, other);
}

TEST(SharedMedia, WhatCouldNotBeMadeIsMadeOnceItCanBe)
{
  const SampledField<float> before = blobField();
  const Scene scene = sceneTowards(front);
  const std::vector<Ball> ofSource{ { { 0.4, 0.1, 0.2 }, 0.1, 1e-4 } };
  const Image expected = Bench().render(fieldOf(std::make_shared<BallsSource>(ofSource)), scene);
  for (const bool ofContents : { true, false })
  {
    SCOPED_TRACE(ofContents ? "contents" : "samples");
    const auto source = std::make_shared<FailingBalls>(ofSource);
    const Field field = fieldOf(source);
    (ofContents ? source->failsContents : source->failsSamples) = true;
    Together together;
    together.first.render(before.field, scene);
    for (Bench* bench : { &together.first, &together.first, &together.second })
    {
      EXPECT_THROW(bench->render(field, scene), std::runtime_error);
      EXPECT_FALSE(bench->isUnfinished());
    }
    source->failsContents = source->failsSamples = false;
    expectSameImage(together.first.render(field, scene), expected);
    expectSameImage(together.second.render(field, scene), expected);
    expectSameImage(
      together.first.render(before.field, scene), Bench().render(before.field, scene));
  }
}

TEST(SharedMedia, GoesWithItsLastUser)
{
  const SampledField<float> data = blobField(192); // much larger than what threads take
  const Scene scene = sceneTowards(front);
  const auto media = std::make_shared<SharedMedia>();
  auto first = std::make_unique<Bench>(), second = std::make_unique<Bench>();
  const PeakMemory ofOne;
  first->setMedia(media);
  first->render(data.field, scene);
  const std::size_t bytes = ofOne.bytes();
  EXPECT_GT(bytes, data.samples.size() * sizeof(float));

  // Another view takes what its rays do, and no medium.
  const PeakMemory ofAnother;
  second->setMedia(media);
  second->render(data.field, scene);
  EXPECT_LT(ofAnother.bytes() + data.samples.size() * sizeof(float), bytes);
  EXPECT_EQ(second->work().mediumBuilds, 0);

  first.reset();
  EXPECT_EQ(media->count(), 1);
  second->render(data.field, sceneTowards(aside));
  EXPECT_EQ(second->work().mediumBuilds, 0);
  second.reset();
  EXPECT_EQ(media->count(), 0);
}

TEST(SharedMedia, AnImageInPiecesIsTheSameWhateverOthersDoMeanwhile)
{
  const Scene scene = sceneTowards(front);
  // Of an image nothing changes.
  {
    const SampledField<float> data = blobField();
    Together together;
    const Image image = inPieces(together.first, data.field, scene,
      [&](int) { together.second.render(data.field, sceneTowards(aside)); });
    expectSameImage(image, Bench().render(data.field, scene));
  }
  // Voxels that another view adds: the image is that of the tree as it is then, as a whole.
  const Field field = fieldOf(balls());
  Scene close = sceneTowards(front);
  close.view.parallelScale = 0.05;
  close.view.focalPoint = Vector{ 0.4, 0.1, 0.2 };
  Bench alone;
  alone.render(field, scene);
  alone.render(field, close);
  const Image expected = alone.render(field, scene);
  for (const int at : { 0, 3 })
  {
    Together together;
    const Image image = inPieces(together.first, field, scene,
      [&](int piece)
      {
        if (piece == at)
        {
          together.second.render(field, close);
        }
      });
    expectSameImage(image, expected);
    EXPECT_EQ(together.builds(), 1);
  }
}

TEST(SharedMedia, CutoffsNeedNoTracingUntilVoxelsAreNew)
{
  const Field field = fieldOf(balls());
  Together together;
  Scene scene = sceneTowards(front);
  together.first.render(field, scene);
  together.second.render(field, scene);
  const std::int64_t rays = together.first.work().raysTraced;
  scene.knifeEdgeAngle = 90;
  together.first.render(field, scene);
  EXPECT_EQ(together.first.work().raysTraced, rays);
}

TEST(SharedMedia, ViewsThatDoNotFitTogetherHaveTheirOwn)
{
  const Field field = fieldOf(balls());
  Scene left = sceneTowards(front), right = left;
  left.view.parallelScale = right.view.parallelScale = 0.2;
  left.view.focalPoint = Vector{ -0.5, -0.2, 0 };
  right.view.focalPoint = Vector{ 0.4, 0.1, 0.2 };
  left.mediumTolerance = right.mediumTolerance = 1e-3;
  const std::int64_t ofLeft = Bench().render(field, left).medium.bytes;
  const std::int64_t ofRight = Bench().render(field, right).medium.bytes;
  left.mediumMemory = right.mediumMemory =
    static_cast<std::size_t>(1.3 * static_cast<double>(std::max(ofLeft, ofRight)));
  ASSERT_GT(ofLeft + ofRight, static_cast<std::int64_t>(left.mediumMemory));
  Together together;
  together.first.render(field, left);
  const Image ofSecond = together.second.render(field, right);
  EXPECT_EQ(together.builds(), 2);
  expectSameImage(ofSecond, Bench().render(field, right));
  EXPECT_LE(statedError(ofSecond.medium), right.mediumTolerance);
  // They do not throw each other's voxels away.
  const std::int64_t rays = together.first.work().raysTraced;
  left.knifeEdgeAngle = right.knifeEdgeAngle = 90;
  together.first.render(field, left);
  together.second.render(field, right);
  EXPECT_EQ(together.first.work().raysTraced, rays);
  EXPECT_EQ(together.builds(), 2);
}

TEST(SharedMedia, MemoryThatIsShortForOneViewIsSharedByItsLikes)
{
  const Field field = fieldOf(balls());
  Scene scene = sceneTowards(front);
  scene.view.width = scene.view.height = 300;
  scene.mediumTolerance = 1e-4;
  const MediumStatistics needed = Bench().render(field, scene).medium;
  scene.mediumMemory = static_cast<std::size_t>(needed.bytes / 4);
  Together together;
  EXPECT_LT(together.first.render(field, scene).medium.voxels, needed.voxels / 2);
  together.second.render(field, scene);
  together.third.render(field, scene);
  EXPECT_EQ(together.builds(), 1);
}

// A window may draw another view while it shows the progress of one.
TEST(SharedMedia, ABenchThatAnotherOneCallsHasItsOwn)
{
  const Field field = fieldOf(balls());
  Together together;
  int called = 0;
  Monitor monitor;
  monitor.progress = [&](double)
  {
    if (called++ == 0)
    {
      expectSameImage(together.second.render(field, sceneTowards(aside)),
        Bench().render(field, sceneTowards(aside)));
    }
  };
  expectSameImage(together.first.render(field, sceneTowards(front), monitor),
    Bench().render(field, sceneTowards(front)));
  EXPECT_GT(called, 0);
  EXPECT_EQ(together.builds(), 2);
}

TEST(SharedMedia, ThreadsDoNotMeetInAMedium)
{
  const Field field = fieldOf(balls());
  const std::array<double, 4> views{ 0., 0.3, -0.7, 1. };
  const auto errorOf = [&field](Bench& bench, double x) {
    return statedError(bench.render(field, sceneTowards({ x, 0.1, -1 })).medium);
  };
  std::vector<double> alone;
  for (const double x : views)
  {
    Bench bench;
    alone.push_back(errorOf(bench, x));
  }
  Together together;
  std::vector<std::thread> threads;
  for (Bench* bench : { &together.first, &together.second, &together.third })
  {
    threads.emplace_back(
      [&, bench]
      {
        for (std::size_t view = 0; view < views.size(); ++view)
        {
          EXPECT_LE(errorOf(*bench, views[view]), 1.0001 * alone[view]);
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
}

} // namespace

} // namespace schlieren
