// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Fixtures.h"

#include <map>

namespace
{

using Filter = vtkSchlierenFilter;

constexpr int presets[] = { Filter::INTERACTIVE, Filter::FINE, Filter::PUBLICATION,
  Filter::REFERENCE, Filter::AUTOMATIC };

/// What the filter's properties are, by the names that Quality knows them by.
std::map<std::string, double> settingsOf(Filter* filter)
{
  return { { "PathModel", filter->GetPathModel() }, { "StepSize", filter->GetStepSize() },
    { "HomogeneityTolerance", filter->GetHomogeneityTolerance() },
    { "SamplesPerPixel", filter->GetSamplesPerPixel() },
    { "FilmEstimator", filter->GetFilmEstimator() }, { "Precision", filter->GetPrecision() },
    { "MediumTolerance", filter->GetMediumTolerance() },
    { "TargetError", filter->GetTargetError() },
    { "AutoTargetError", filter->GetAutoTargetError() } };
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
  EXPECT_EQ(Filter::GetQualityValue(Filter::FINE, 99), 0);
}

TEST(Quality, ChoicesAreClampedToWhatThereIs)
{
  vtkNew<Filter> filter;
  filter->SetPathModel(99);
  EXPECT_EQ(filter->GetPathModel(), Filter::REFRACTED);
  filter->SetPathModel(-1);
  EXPECT_EQ(filter->GetPathModel(), Filter::STRAIGHT);
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
