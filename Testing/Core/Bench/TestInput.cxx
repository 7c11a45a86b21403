// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// What cannot be done is reported in one message, and the bench works on afterwards.
#include "Fields.h"
#include "Messages.h"

#include <algorithm>
#include <limits>

namespace schlieren
{

namespace
{

struct Mistake
{
  const char* label;
  const char* says; ///< part of the message
  std::function<void(Field&, Scene&)> make;
};

using Change = std::function<void(Field&, Scene&)>;

Change graded(const std::vector<double>& filter)
{
  return [filter](Field&, Scene& scene)
  {
    scene.cutoff = Cutoff::GradedFilter;
    scene.gradedFilter = filter;
  };
}

Change colored(const RgbImage& image)
{
  return [image](Field&, Scene& scene)
  {
    scene.cutoff = Cutoff::ColorFilter;
    scene.colorFilter = std::make_shared<RgbImage>(image);
  };
}

/// Of an interferogram with finite fringes.
template <typename OfScene>
Change fringes(const OfScene& change)
{
  return [change](Field&, Scene& scene)
  {
    scene.cutoff = Cutoff::Interferogram;
    scene.fringes.finite = true;
    change(scene);
  };
}

std::vector<Mistake> mistakes()
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {
    { "no pixels", "ImageSize", [](Field&, Scene& s) { s.view.width = 0; } },
    { "negative height", "ImageSize", [](Field&, Scene& s) { s.view.height = -3; } },
    { "huge image", "ImageSize", [](Field&, Scene& s) { s.view.height = 1 << 20; } },
    { "no direction", "ViewDirection is (0, 0, 0)",
      [](Field&, Scene& s) {
        s.view.viewDirection = { 0, 0, 0 };
      } },
    { "parallel up", "parallel",
      [](Field&, Scene& s) {
        s.view.viewUp = { 0, 0, 3 };
      } },
    { "no up", "ViewUp",
      [](Field&, Scene& s) {
        s.view.viewUp = { 0, 0, 0 };
      } },
    { "NaN direction", "not finite", [=](Field&, Scene& s) { s.view.viewDirection[1] = nan; } },
    { "NaN focal point", "not finite",
      [=](Field&, Scene& s) {
        s.view.focalPoint = Vector{ 0, nan, 0 };
      } },
    { "negative zoom", "ParallelScale", [](Field&, Scene& s) { s.view.parallelScale = -1; } },
    { "negative k", "KScale", [](Field&, Scene& s) { s.kScale = -1; } },
    { "NaN k", "KScale", [=](Field&, Scene& s) { s.kScale = nan; } },
    { "NaN angle", "KnifeEdgeAngle", [=](Field&, Scene& s) { s.knifeEdgeAngle = nan; } },
    { "NaN offset", "CutoffOffset", [=](Field&, Scene& s) { s.cutoffOffset = nan; } },
    { "short filter", "GradedFilter", graded({ 1 }) },
    { "no filter", "GradedFilter", graded({}) },
    { "filter that amplifies", "GradedFilter is 1.5", graded({ 0, 1.5 }) },
    { "filter below darkness", "GradedFilter is -0.1", graded({ 0, -0.1, 1 }) },
    { "filter of NaN", "GradedFilter", graded({ nan, 1 }) },
    { "image without pixels", "ColorFilter", colored({ 0, 0, {} }) },
    { "image cut short", "ColorFilter", colored({ 2, 1, { 1, 2, 3 } }) },
    { "image of negative size", "ColorFilter", colored({ -1, -1, { 1, 2, 3 } }) },
    { "no wavelength", "Wavelength", fringes([](Scene& s) { s.wavelength = 0; }) },
    { "negative wavelength", "Wavelength", fringes([](Scene& s) { s.wavelength = -5e-7; }) },
    { "wavelength of NaN", "Wavelength", fringes([=](Scene& s) { s.wavelength = nan; }) },
    { "endless wavelength", "Wavelength", fringes([](Scene& s) { s.wavelength = HUGE_VAL; }) },
    { "fringes without spacing", "FringeSpacing", fringes([](Scene&) {}) },
    { "fringes of NaN", "FringeSpacing", fringes([=](Scene& s) { s.fringes.spacing = nan; }) },
    { "fringes aslant of NaN", "FringeAngle",
      fringes(
        [=](Scene& s)
        {
          s.fringes.spacing = 1;
          s.fringes.angle = nan;
        }) },
    { "negative histogram", "HistogramSize", [](Field&, Scene& s) { s.histogramSize = -1; } },
    { "huge histogram", "HistogramSize", [](Field&, Scene& s) { s.histogramSize = 1 << 30; } },
    { "negative source", "SourceWidth", [](Field&, Scene& s) { s.source.width = -1; } },
    { "endless source", "SourceLength", [](Field&, Scene& s) { s.source.length = HUGE_VAL; } },
    { "screen in the flow", "ScreenDistance", [](Field&, Scene& s) { s.screenDistance = -2; } },
    { "screen beyond floats", "ScreenDistance", [](Field&, Scene& s) { s.screenDistance = 1e31; } },
    { "short steps in single precision", "Precision",
      [](Field&, Scene& s)
      {
        s.precision = Precision::Single;
        s.stepSize = 0.005;
      } },
    { "data beyond floats", "LengthScale", [](Field& f, Scene&) { f.grid.spacing[1] = 1e40; } },
    { "data as thin as nothing", "their points are only",
      [](Field& f, Scene&)
      {
        f.grid.spacing[0] = 1e-20;
        f.grid.origin[0] = 0;
      } },
    { "data that vanish", "LengthScale", [](Field& f, Scene&) { f.grid.spacing[2] = 1e-40; } },
    { "points that cannot be distinguished", "origin",
      [](Field& f, Scene&) { f.grid.origin[0] = 1e15 * f.grid.spacing[0]; } },
    { "nothing outside", "ExitRefractivity",
      [](Field&, Scene& s)
      {
        s.exitInto = ExitInto::Custom;
        s.exitRefractivity = -1;
      } },
    { "anything outside", "ExitRefractivity",
      [=](Field&, Scene& s)
      {
        s.exitInto = ExitInto::Custom;
        s.exitRefractivity = nan;
      } },
    { "no samples", "SamplesPerPixel", [](Field&, Scene& s) { s.samplesPerPixel = 0; } },
    { "no error allowed", "adaptiveTolerance", [](Field&, Scene& s) { s.adaptiveTolerance = 0; } },
    { "any error allowed", "adaptiveTolerance", [](Field&, Scene& s) { s.adaptiveTolerance = 2; } },
    { "no step", "StepSize", [](Field&, Scene& s) { s.stepSize = 0; } },
    { "step too short to end", "StepSize", [](Field&, Scene& s) { s.stepSize = 1e-9; } },
    { "step past the flow", "StepSize", [](Field&, Scene& s) { s.stepSize = 100; } },
    { "NaN step", "StepSize", [=](Field&, Scene& s) { s.stepSize = nan; } },
    { "negative threads", "threads", [](Field&, Scene& s) { s.threads = -1; } },
    { "flat grid", "1 point(s) along its y axis",
      [](Field& f, Scene&) {
        f.grid.dimensions = { 64, 1, 8 };
      } },
    { "empty grid", "0 point(s)",
      [](Field& f, Scene&) {
        f.grid.dimensions = { 0, 0, 0 };
      } },
    { "no spacing", "spacing along its z axis", [](Field& f, Scene&) { f.grid.spacing[2] = 0; } },
    { "NaN spacing", "spacing", [=](Field& f, Scene&) { f.grid.spacing[0] = nan; } },
    { "NaN origin", "origin", [=](Field& f, Scene&) { f.grid.origin[0] = nan; } },
    { "sheared axes", "direction matrix", [](Field& f, Scene&) { f.grid.direction[1] = 0.5; } },
    { "negative length", "LengthScale", [](Field& f, Scene&) { f.lengthScale = -1; } },
    { "impossible ambient", "ambient", [](Field& f, Scene&) { f.ambient = -1; } },
    { "implausible ambient", "ambient", [](Field& f, Scene&) { f.ambient = 1e30; } },
    { "NaN ambient", "ambient", [=](Field& f, Scene&) { f.ambient = nan; } },
    { "no samples at all", "float or double", [](Field& f, Scene&) { f.singles = nullptr; } },
  };
}

TEST(Input, EachMistakeIsReportedAndForgotten)
{
  const SampledField<float> good(cube(8, 1), [](double x, double, double) { return 1e-4 * x; });
  Scene scene;
  scene.device = Device::Cpu;
  scene.view.width = scene.view.height = 12;
  Bench bench;
  const Image reference = bench.render(good.field, scene);
  for (const Mistake& mistake : mistakes())
  {
    SCOPED_TRACE(mistake.label);
    Field badField = good.field;
    Scene badScene = scene;
    mistake.make(badField, badScene);
    expectError(messageOf([&] { bench.render(badField, badScene); }), mistake.says);
    EXPECT_EQ(bench.render(good.field, scene).intensity, reference.intensity);
  }
}

void expectFieldError(double value, const char* says)
{
  SampledField<double> bad(cube(6, 1), [](double x, double, double) { return 1e-4 * x; });
  std::fill(bad.samples.begin() + 7, bad.samples.end(), value);
  if (!std::isfinite(value))
  {
    std::fill(bad.samples.begin(), bad.samples.end(), value);
  }
  expectError(messageOf(bad.field, Scene()), says);
}

TEST(Input, FieldsThatAreNoMedium)
{
  expectFieldError(std::numeric_limits<double>::quiet_NaN(), "invalid everywhere");
  expectFieldError(std::numeric_limits<double>::infinity(), "invalid everywhere");
  expectFieldError(101325, "index model");
  expectFieldError(-1, "index model");
}

TEST(Input, CudaWithoutADeviceIsAnError)
{
  if (cudaAvailable())
  {
    GTEST_SKIP() << "a CUDA device is there";
  }
  const SampledField<float> good(cube(8, 1), [](double x, double, double) { return 1e-4 * x; });
  Scene scene;
  scene.view.width = scene.view.height = 12;
  scene.device = Device::Cuda;
  expectError(messageOf(good.field, scene), "no CUDA device can be used");
  scene.device = Device::Auto;
  EXPECT_EQ(Bench().render(good.field, scene).device, Device::Cpu);
}

} // namespace

} // namespace schlieren
