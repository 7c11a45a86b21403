// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Scene::targetError on random scenes: how often the error that an image claims is the one that it has.
//
// SCHLIEREN_ERROR_SCENES: so many scenes, with a line for each; else some whose truths are made in seconds.
// SCHLIEREN_ERROR_FIRST: the number of the first one.
#include "RandomScenes.h"
#include "TrueError.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace schlieren
{

namespace
{

const char* name(Cutoff cutoff)
{
  constexpr const char* names[] = { "knife edge", "shadowgraph", "bright field", "dark field",
    "graded filter", "colour filter", "interferogram", "background", "numerical schlieren" };
  return names[static_cast<int>(cutoff)];
}

const char* name(ErrorSource limit)
{
  constexpr const char* names[] = { "none", "steps", "rays", "voxels", "rounding" };
  return names[static_cast<int>(limit)];
}

double secondsSince(std::chrono::steady_clock::time_point begin)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// An image with a target error.
struct Trial
{
  double target = 0, reached = 0, error = 0, seconds = 0;
  bool isKept() const { return reached <= target; }
  bool isMissed() const { return isKept() && error > target; }
};

/// An image of so many pixels fewer each way, of which each has the mean light of the others, and the path and displacement of
/// the one in its middle. `times` is odd.
Image meanOf(const Image& fine, int times)
{
  Image image = fine;
  image.width /= times;
  image.height /= times;
  image.frame.pixelSize *= times;
  const auto pixels =
    static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  const auto reduce = [&](auto& values, bool isMean)
  {
    using Values = std::remove_reference_t<decltype(values)>;
    const std::size_t channels = values.size() /
      (static_cast<std::size_t>(fine.width) * static_cast<std::size_t>(fine.height));
    Values reduced(channels * pixels);
    const int first = isMean ? 0 : times / 2, end = isMean ? times : times / 2 + 1;
    const double share = isMean ? 1. / (times * times) : 1;
    for (std::size_t at = 0; at < reduced.size(); ++at)
    {
      const int pixel = static_cast<int>(at / channels);
      double sum = 0;
      for (int j = first; j < end; ++j)
      {
        for (int i = first; i < end; ++i)
        {
          const std::size_t of =
            pixelOf(fine, pixel % image.width * times + i, pixel / image.width * times + j);
          sum += static_cast<double>(values[channels * of + at % channels]);
        }
      }
      reduced[at] = static_cast<typename Values::value_type>(share * sum);
    }
    values = std::move(reduced);
  };
  reduce(image.intensity, true);
  reduce(image.color, true);
  reduce(image.blockedFraction, true);
  reduce(image.opticalPathDifference, false);
  reduce(image.backgroundDisplacement, false);
  return image;
}

/// What the settings of an image leave out: bent rays, steps of a quarter, of an integrator that
/// chooses shorter ones for a much finer tolerance, other rays through other points of the pixels, eight times as many (of
/// trees, which take long, four), finer voxels, double precision. Of what is finer than pixels, whose voxels would be too
/// coarse otherwise, it is made with nine times the pixels.
Image truthOf(const RandomData& data, Scene scene, const Image& image)
{
  const Field& field = data.field;
  const double finestStep = field.source ? 0.25 : 0.125;
  constexpr int fewestRays = 16;
  const int more = field.source ? 4 : 8;
  const int times = data.kind == DataKind::TreeFine ? 3 : 1;
  scene.targetError = 0;
  scene.interpolation = Interpolation::Cubic;
  // Rounding in single precision is far below all targets but those of paths.
  const bool isDouble = techniqueOf(scene.cutoff).hasFringes || field.version % 3 == 0;
  scene.precision = isDouble ? Precision::Double : Precision::Single;
  scene.stepSize = std::max(finestStep, 0.25 * image.stepSize);
  scene.mediumTolerance = 2e-4;
  scene.adaptiveTolerance = 1e-7;
  scene.pathModel = PathModel::Refracted;
  scene.integrator = Integrator::Adaptive;
  scene.view.width *= times;
  scene.view.height *= times;
  const int rays =
    std::max(more * std::max(image.samplesPerPixel, image.samplesAtEdges), fewestRays);
  scene.samplesPerPixel = isOfCamera(scene.cutoff) ? 1 : std::max(1, rays / (times * times));
  scene.seed += 1;
  const Image truth = Bench().render(field, scene);
  return times > 1 ? meanOf(truth, times) : truth;
}

/// The optical path of a box full of gas.
PixelArray<double> crossings(const RandomData& data, Scene scene)
{
  scene.targetError = 0;
  scene.cutoff = Cutoff::KnifeEdge;
  scene.samplesPerPixel = 1;
  scene.pathModel = PathModel::Straight;
  return Bench().render(data.everywhere->field, scene).opticalPathDifference;
}

/// How much of the light through pixels' centres bodies stop: 0 or 1.
PixelArray<float> blockedCentres(const RandomData& data, Scene scene)
{
  scene.targetError = 0;
  scene.samplesPerPixel = 1;
  scene.mediumTolerance = 0.01;
  return Bench().render(data.field, scene).blockedFraction;
}

struct SceneResult
{
  DataKind kind{};
  Cutoff cutoff{};
  std::array<Trial, 2> trials; ///< with a target, and half of it
  bool isWorseForLess = false; ///< half of the target has raised the error
};

/// Trees take much longer, and are half as frequent. From a number on every second scene has what is finer than pixels.
DataKind kindOf(int number)
{
  constexpr int onGrids = static_cast<int>(DataKind::TreeBalls), others = dataKinds - 1;
  constexpr int firstFine = 30000;
  if (number >= firstFine && number % 2 == 1)
  {
    return DataKind::TreeFine;
  }
  const int at = number % (onGrids + others);
  return static_cast<DataKind>(at < onGrids ? at : at - onGrids);
}

/// The scene with a number.
SceneResult tryScene(int number, bool isShown)
{
  Random random(static_cast<std::uint64_t>(number) + 1);
  SceneResult result;
  result.kind = kindOf(number);
  constexpr int ofRays = static_cast<int>(Cutoff::PhaseContrast); // which takes waves
  result.cutoff = static_cast<Cutoff>(random.below(ofRays));
  const RandomData data = randomData(result.kind, random);
  Scene scene = randomScene(data, result.cutoff, random);
  scene.targetError = invisibleError(scene.cutoff) * random.logUniform(0.6, 12);

  Bench bench;
  std::array<Image, 2> images;
  for (std::size_t n = 0; n < 2; ++n)
  {
    const auto begin = std::chrono::steady_clock::now();
    images[n] = bench.render(data.field, scene);
    result.trials[n] = { scene.targetError, images[n].accuracy.reached, 0, secondsSince(begin) };
    if (images[n].kScale > 0)
    {
      scene.kScale = images[n].kScale;
    }
    scene.targetError *= 0.5;
  }
  const auto begin = std::chrono::steady_clock::now();
  const Image truth = truthOf(data, scene, images[1]);
  const double seconds = secondsSince(begin);
  const PixelArray<double> crossing = crossings(data, scene);
  const PixelArray<float> blocked =
    techniqueOf(scene.cutoff).hasFringes ? blockedCentres(data, scene) : truth.blockedFraction;
  for (std::size_t n = 0; n < 2; ++n)
  {
    result.trials[n].error = trueError(
      images[n], truth, scene,
      [&](std::size_t pixel) { return crossing[pixel] > 0 && truth.blockedFraction[pixel] < 1; },
      [&](std::size_t pixel) { return blocked[pixel] == 0; });
  }
  // Within what the truth itself lacks.
  const double errorOfTruth = 0.1 * result.trials[0].target;
  result.isWorseForLess = result.trials[1].error > 1.05 * result.trials[0].error + errorOfTruth;
  if (isShown)
  {
    for (std::size_t n = 0; n < 2; ++n)
    {
      const Trial& trial = result.trials[n];
      std::printf("%d;%s;%s;%.3g;%.3g;%.3g;%s;%s;%g;%d;%s;%.2f;%.2f;%.2g;%.2g\n", number,
        name(result.kind), name(result.cutoff), trial.target, trial.reached, trial.error,
        trial.isMissed()    ? "MISSED"
          : !trial.isKept() ? "not kept"
                            : "kept",
        name(images[n].accuracy.limit), images[n].stepSize, images[n].samplesPerPixel,
        images[n].pathModel == PathModel::Straight ? "straight" : "refracted", trial.seconds,
        seconds, images[n].accuracy.largest,
        static_cast<double>(images[n].raysLost) /
          static_cast<double>(std::max<std::int64_t>(1, images[n].raysTraced)));
    }
    std::fflush(stdout);
  }
  return result;
}

/// Of a row of the table.
struct Sum
{
  int images = 0, claimed = 0, missed = 0, worse = 0, tight = 0;
  std::vector<double> effectivities; ///< of errors of a tenth of the target or more
  double seconds = 0;

  void add(const SceneResult& result)
  {
    for (const Trial& trial : result.trials)
    {
      ++images;
      claimed += trial.isKept() ? 1 : 0;
      missed += trial.isMissed() ? 1 : 0;
      seconds += trial.seconds;
      constexpr double tenth = 0.1;
      if (trial.error >= tenth * trial.target)
      {
        tight += trial.isKept() ? 1 : 0;
        effectivities.push_back(trial.reached / trial.error);
      }
    }
    worse += result.isWorseForLess ? 1 : 0;
  }

  double kept() const { return claimed > 0 ? 1 - 1. * missed / claimed : 1; }
  double effective() const
  {
    const auto isGood = [](double ratio) { return ratio >= 0.5 && ratio <= 3; };
    return effectivities.empty() ? 1
                                 : 1. *
        static_cast<double>(std::count_if(effectivities.begin(), effectivities.end(), isGood)) /
        static_cast<double>(effectivities.size());
  }

  void print(const std::string& title)
  {
    std::sort(effectivities.begin(), effectivities.end());
    const auto quantile = [&](double fraction)
    {
      return effectivities.empty() ? 0
                                   : effectivities[static_cast<std::size_t>(
                                       fraction * static_cast<double>(effectivities.size() - 1))];
    };
    std::printf(
      "| %s | %d | %d | %d | %.1f %% | %d | %.2f [%.2f-%.2f] | %.0f %% | %.0f %% | %d | %.2f |\n",
      title.c_str(), images, images - claimed, missed, 100 * kept(),
      static_cast<int>(effectivities.size()), quantile(0.5), quantile(0.05), quantile(0.95),
      100 * effective(), claimed > 0 ? 100. * tight / claimed : 100., worse, seconds / images);
  }
};

int numberIn(const char* variable, int otherwise)
{
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : otherwise;
}

TEST(TargetErrorScenes, KeepTheirTargets)
{
  std::vector<int> numbers{ 2, 3, 5, 8, 9, 12, 42 };
  const bool isLong = std::getenv("SCHLIEREN_ERROR_SCENES") != nullptr;
  if (isLong)
  {
    numbers.resize(static_cast<std::size_t>(numberIn("SCHLIEREN_ERROR_SCENES", 0)));
    std::iota(numbers.begin(), numbers.end(), numberIn("SCHLIEREN_ERROR_FIRST", 0));
    std::printf("scene;data;technique;target;reached;error;result;limit;step;rays;path;seconds;"
                "seconds of the truth;largest;lost;displacement\n");
  }
  Sum all;
  std::map<DataKind, Sum> byKind;
  std::map<Cutoff, Sum> byTechnique;
  for (const int number : numbers)
  {
    SCOPED_TRACE(number);
    const SceneResult result = tryScene(number, isLong);
    all.add(result);
    byKind[result.kind].add(result);
    byTechnique[result.cutoff].add(result);
    if (result.trials[0].isMissed() || result.trials[1].isMissed())
    {
      std::printf("Scene %d misses.\n", number);
    }
  }
  std::printf(
    "| scenes | images | say that they miss | miss silently | claims that are true | "
    "error >= target / 10 | estimate / error: median [5-95 %%] | within 1/2 to 3 | of claims, "
    "error >= target / 10 | worse for half the target | seconds |\n"
    "|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (auto& [kind, sum] : byKind)
  {
    sum.print(schlieren::name(kind));
  }
  for (auto& [cutoff, sum] : byTechnique)
  {
    sum.print(name(cutoff));
  }
  all.print("all");
  // The aim is 0.99 and 0.9: see Documentation/development/accuracy.md for what is reached, and where it fails.
  EXPECT_GE(all.kept(), 0.97);
  constexpr double ofHundreds = 0.88, ofSome = 0.8; // fewer than thirty, of which one is 0.04
  EXPECT_GE(all.effective(), isLong ? ofHundreds : ofSome);
}

/// Whose errors are all at a few pixels, which patches could miss: data of which a long step and half of it are one and the
/// same; a border along a row of pixels, with no ray of four behind it; light of an extended source where a body stops
/// that of its middle.
TEST(TargetErrorScenes, SeeWhatIsRare)
{
  constexpr int thin = 129, border = 1128, umbra = 10095;
  for (const int number : { thin, border, umbra })
  {
    SCOPED_TRACE(number);
    for (const Trial& trial : tryScene(number, false).trials)
    {
      EXPECT_FALSE(trial.isMissed());
      EXPECT_EQ(trial.isKept(), number != umbra);
    }
  }
}

/// On screens, where rays err by their noise, as in cells finer than pixels, or by the width of what they light, as in a
/// column and in plane data.
TEST(TargetErrorScenes, KnowRaysOnScreens)
{
  for (const int number : { 40011, 40092, 40116 })
  {
    SCOPED_TRACE(number);
    const Trial trial = tryScene(number, false).trials[0];
    EXPECT_GT(trial.reached, 0.6 * trial.error);
    EXPECT_LT(trial.reached, 1.5 * trial.error);
  }
}

} // namespace

} // namespace schlieren
