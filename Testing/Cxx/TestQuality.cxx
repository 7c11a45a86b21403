// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Fixtures.h"

#include <map>

namespace
{

using Filter = vtkSchlierenFilter;

constexpr int presets[] = { Filter::INTERACTIVE, Filter::DRAFT, Filter::PUBLICATION,
  Filter::REFERENCE };

/// What the filter's properties are, by the names that Quality knows them by.
std::map<std::string, double> settingsOf(Filter* filter)
{
  return { { "PathModel", filter->GetPathModel() }, { "Integrator", filter->GetIntegrator() },
    { "StepSize", filter->GetStepSize() },
    { "HomogeneityTolerance", filter->GetHomogeneityTolerance() },
    { "Interpolation", filter->GetInterpolation() },
    { "SamplesPerPixel", filter->GetSamplesPerPixel() },
    { "FilmEstimator", filter->GetFilmEstimator() }, { "Precision", filter->GetPrecision() },
    { "AdaptiveTolerance", filter->GetAdaptiveTolerance() },
    { "PathTolerance", filter->GetPathTolerance() },
    { "MediumTolerance", filter->GetMediumTolerance() } };
}

std::map<std::string, double> settingsOf(int preset)
{
  std::map<std::string, double> settings;
  for (int i = 0; Filter::GetQualitySetting(i); ++i)
  {
    settings[Filter::GetQualitySetting(i)] = Filter::GetQualityValue(preset, i);
  }
  return settings;
}

vtkSmartPointer<vtkImageData> columnImage(int points)
{
  auto image = cube(points);
  addPointArray(image, "N", GaussianColumn());
  return image;
}

} // namespace

TEST(Quality, IsInteractiveUnlessSet)
{
  vtkNew<Filter> filter;
  EXPECT_EQ(filter->GetQuality(), Filter::INTERACTIVE);
  EXPECT_EQ(settingsOf(filter), settingsOf(Filter::INTERACTIVE));
}

TEST(Quality, APresetSetsAllSettings)
{
  vtkNew<Filter> filter;
  for (const int preset : presets)
  {
    for (const int before : presets)
    {
      filter->SetQuality(before);
      filter->SetQuality(preset);
      EXPECT_EQ(settingsOf(filter), settingsOf(preset)) << preset;
      EXPECT_EQ(filter->GetQuality(), preset);
    }
  }
}

TEST(Quality, AnotherValueOfAnySettingMakesItCustom)
{
  const std::map<std::string, std::function<void(Filter*)>> changes = {
    { "PathModel", [](Filter* f) { f->SetPathModel(Filter::STRAIGHT); } },
    { "Integrator", [](Filter* f) { f->SetIntegrator(Filter::EULER); } },
    { "StepSize", [](Filter* f) { f->SetStepSize(0.3); } },
    { "HomogeneityTolerance", [](Filter* f) { f->SetHomogeneityTolerance(0.3); } },
    { "Interpolation", [](Filter* f) { f->SetInterpolation(Filter::CENTRAL); } },
    { "SamplesPerPixel", [](Filter* f) { f->SetSamplesPerPixel(7); } },
    { "FilmEstimator", [](Filter* f) { f->SetFilmEstimator(Filter::PHOTON); } },
    { "Precision", [](Filter* f) { f->SetPrecision(1 - f->GetPrecision()); } },
    { "AdaptiveTolerance", [](Filter* f) { f->SetAdaptiveTolerance(0.3); } },
    { "PathTolerance", [](Filter* f) { f->SetPathTolerance(0.3); } },
    { "MediumTolerance", [](Filter* f) { f->SetMediumTolerance(0.3); } }
  };
  for (const int preset : presets)
  {
    std::size_t settings = 0;
    for (; Filter::GetQualitySetting(static_cast<int>(settings)); ++settings)
    {
      const std::string name = Filter::GetQualitySetting(static_cast<int>(settings));
      vtkNew<Filter> filter;
      filter->SetQuality(preset);
      const auto before = settingsOf(filter);
      changes.at(name)(filter);
      EXPECT_EQ(filter->GetQuality(), Filter::CUSTOM) << name;
      auto expected = before;
      expected[name] = settingsOf(filter)[name];
      EXPECT_NE(expected[name], before.at(name)) << name;
      EXPECT_EQ(settingsOf(filter), expected) << name;
    }
    EXPECT_EQ(settings, changes.size());
  }
}

TEST(Quality, CustomAndWhatIsNoneLeaveTheSettings)
{
  vtkNew<Filter> filter;
  filter->SetQuality(Filter::PUBLICATION);
  filter->SetStepSize(0.3);
  const auto before = settingsOf(filter);
  const vtkMTimeType time = filter->GetMTime();
  for (const int quality : { static_cast<int>(Filter::CUSTOM), -1, 99 })
  {
    filter->SetQuality(quality);
    EXPECT_EQ(settingsOf(filter), before) << quality;
    EXPECT_EQ(Filter::GetQualityValue(quality, 0), 0) << quality;
  }
  EXPECT_EQ(filter->GetMTime(), time);
  EXPECT_EQ(Filter::GetQualitySetting(-1), nullptr);
  EXPECT_EQ(Filter::GetQualitySetting(99), nullptr);
  EXPECT_EQ(Filter::GetQualityValue(Filter::DRAFT, 99), 0);
}

TEST(Quality, ChoicesAreClampedToWhatThereIs)
{
  vtkNew<Filter> filter;
  filter->SetPathModel(99);
  EXPECT_EQ(filter->GetPathModel(), Filter::DIFFERENCE);
  filter->SetIntegrator(-1);
  EXPECT_EQ(filter->GetIntegrator(), Filter::LEAPFROG);
  filter->SetInterpolation(99);
  EXPECT_EQ(filter->GetInterpolation(), Filter::CUBIC);
}

TEST(Quality, EveryPresetTracesItsRays)
{
  for (const int preset : presets)
  {
    auto filter = bench(columnImage(64), 12);
    filter->SetQuality(preset);
    filter->SetDevice(Filter::CPU);
    filter->Update();
    EXPECT_GE(fieldValue(filter, "RaysTraced"), 12 * 12 * settingsOf(preset)["SamplesPerPixel"]);
    EXPECT_EQ(fieldValue(filter, "RaysLost"), 0) << preset;
    EXPECT_GT(fieldValue(filter, "StepsTaken"), 0);
    // The deflection is the mean over pixels that are half as wide as the column.
    EXPECT_LT(compareWithColumn(filter, GaussianColumn()).opticalPath, 0.1) << preset;
  }
}

TEST(Quality, EveryInterpolationMakesAImageOfItsOwn)
{
  std::vector<std::vector<double>> images;
  for (const int interpolation :
    { Filter::QUADRATIC, Filter::LINEAR, Filter::CENTRAL, Filter::CUBIC })
  {
    auto filter = bench(columnImage(24), 20);
    filter->SetInterpolation(interpolation);
    filter->Update();
    images.push_back(valuesOf(filter, "Deflection"));
    // Linear has one gradient for a cell: off by h / (2 s) where the largest is 0.429.
    const double limit = interpolation == Filter::LINEAR ? 0.34 : 0.2;
    EXPECT_LT(compareWithColumn(filter, GaussianColumn()).deflection, limit) << interpolation;
    for (std::size_t other = 0; other + 1 < images.size(); ++other)
    {
      EXPECT_NE(images.back(), images[other]) << interpolation << " and " << other;
    }
  }
}
