// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What each cutoff makes of a field that bends all light alike, against its formula, and what comes with the
// image.
#include "Fixtures.h"

#include "vtkBase64Utilities.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkMath.h"

#include <limits>

namespace
{

using Filter = vtkSchlierenFilter;

constexpr double ambient = 3e-4;
constexpr int pixels = 16;

/// The cube from -1 to 1, in which N grows so that light is bent by `eps` along x and y.
vtkSmartPointer<vtkImageData> bending(double epsX, double epsY)
{
  auto image = cube(16);
  const double perDepth = (1 + ambient) / 2;
  addPointArray(
    image, "N", [=](const Vec& x) { return ambient + perDepth * (epsX * x[0] + epsY * x[1]); });
  return image;
}

/// Looks at the middle of it, away from the cube's faces.
vtkSmartPointer<Filter> benchOf(vtkImageData* image, int cutoff, double k)
{
  auto filter = bench(image, pixels);
  filter->SetAmbientRefractivity(ambient);
  filter->SetParallelScale(0.5);
  filter->SetCutoff(cutoff);
  filter->SetAutoKScale(false);
  filter->SetKScale(k);
  return filter;
}

constexpr double epsX = 2e-5, epsY = 3e-5;
const double eps = std::hypot(epsX, epsY);

/// Of the image's middle, with every pixel of it the same.
double intensityOf(Filter* filter)
{
  filter->Update();
  const std::vector<double> values = valuesOf(filter, "Intensity");
  const double middle = values[pixels / 2 * pixels + pixels / 2];
  EXPECT_NEAR(*std::max_element(values.begin(), values.end()), middle, 1e-3);
  EXPECT_NEAR(*std::min_element(values.begin(), values.end()), middle, 1e-3);
  return middle;
}

std::array<int, 3> colorOf(Filter* filter)
{
  filter->Update();
  vtkDataArray* color = arrayOf(filter, "Color");
  if (!color)
  {
    ADD_FAILURE() << "There is no Color";
    return {};
  }
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetScalars(), color);
  std::array<int, 3> bytes;
  for (int channel = 0; channel < 3; ++channel)
  {
    bytes[static_cast<std::size_t>(channel)] =
      static_cast<int>(color->GetComponent(pixels / 2 * pixels + pixels / 2, channel));
  }
  return bytes;
}

void expectColor(
  const std::array<int, 3>& found, const std::array<double, 3>& expected, const char* what)
{
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    EXPECT_NEAR(found[channel], expected[channel], 1.1) << what << ", channel " << channel;
  }
}

} // namespace

TEST(Cutoffs, AKnifeEdgeLetsAHalfLessTheOffsetAndKEpsPass)
{
  auto filter = benchOf(bending(epsX, epsY), Filter::KNIFE_EDGE, 5000);
  for (const double degrees : { 0., 30., 90., 200. })
  {
    const double angle = vtkMath::RadiansFromDegrees(degrees);
    const double expected = 0.5 + 5000 * (epsX * std::cos(angle) + epsY * std::sin(angle));
    filter->SetKnifeEdgeAngle(degrees);
    filter->SetInvertCutoff(false);
    filter->SetCutoffOffset(0);
    EXPECT_NEAR(intensityOf(filter), expected, 1e-3) << degrees;
    filter->SetCutoffOffset(0.125);
    EXPECT_NEAR(intensityOf(filter), expected - 0.125, 1e-3) << degrees;
    EXPECT_NEAR(fieldValue(filter, "UndisturbedLevel"), 0.375, 1e-6);
    filter->SetInvertCutoff(true);
    EXPECT_NEAR(intensityOf(filter), 1 - (expected - 0.125), 1e-3) << degrees;
  }
}

TEST(Cutoffs, AnInterferogramIsTheCosineOfThePath)
{
  auto image = cube(64);
  addPointArray(image, "N", GaussianColumn{ 1e-5, 0.3 });
  auto filter = bench(image, 256); // small pixels, over which light is a mean
  filter->SetCutoff(Filter::INTERFEROGRAM);
  filter->SetLengthScale(0.5);
  filter->SetWavelength(500);
  filter->SetParallelScale(0.9);
  filter->Update();
  const std::vector<double> path = valuesOf(filter, "OpticalPathDifference");
  std::vector<double> expected;
  for (const double metres : path)
  {
    expected.push_back(0.5 * (1 + std::cos(2 * pi * metres / 500e-9)));
  }
  EXPECT_GT(largest(path), 5 * 500e-9); // fringes
  EXPECT_LT(relativeDifference(valuesOf(filter, "Intensity"), expected), 0.02);
  EXPECT_EQ(fieldValue(filter, "UndisturbedLevel"), 1);
  EXPECT_EQ(fieldValue(filter, "KScale"), 0);
  EXPECT_EQ(std::string(filter->GetSensitivity()).find("a fringe is 500 nm"), 0u);
}

// A camera's rays bend towards denser gas: on their way of 2 through the data as if all at once in its
// middle, 1 before the side where they leave for the pattern.
TEST(Cutoffs, ABackgroundIsSeenWhereRaysMeetIt)
{
  auto filter = benchOf(bending(0.002, -0.004), Filter::BACKGROUND_ORIENTED, 1);
  filter->SetBackgroundPattern(Filter::STRIPES);
  filter->SetBackgroundPeriod(1.2);
  filter->SetFringeAngle(90);
  for (const double distance : { -1., 5. })
  {
    filter->SetBackgroundDistance(distance);
    filter->Update();
    const double lever = 1 + (distance < 0 ? 2 : distance); // by default one depth
    vtkDataArray* displacement = arrayOf(filter, "BackgroundDisplacement");
    ASSERT_NE(displacement, nullptr);
    EXPECT_STREQ(displacement->GetInformation()->Get(vtkDataArray::UNITS_LABEL()), "data units");
    for (vtkIdType i = 0; i < displacement->GetNumberOfTuples(); ++i)
    {
      EXPECT_NEAR(displacement->GetComponent(i, 0), 0.002 * lever, 2e-3 * 0.002 * lever);
      EXPECT_NEAR(displacement->GetComponent(i, 1), -0.004 * lever, 2e-3 * 0.004 * lever);
      // The mean over a pixel.
      const double width = pi * filter->GetOutput()->GetSpacing()[1] / 1.2;
      const double contrast = std::sin(width) / width;
      const auto stripes = [contrast](double y)
      { return 0.5 * (1 + contrast * std::cos(2 * pi * y / 1.2)); };
      const double y = filter->GetOutput()->GetPoint(i)[1];
      EXPECT_NEAR(arrayOf(filter, "Background")->GetComponent(i, 0), stripes(y), 2e-3);
      // Where a stripe is brightest, light of rays is limited to 1.
      EXPECT_NEAR(
        arrayOf(filter, "Intensity")->GetComponent(i, 0), stripes(y - 0.004 * lever), 4e-3);
    }
  }
  filter->SetCutoff(Filter::KNIFE_EDGE);
  filter->Update();
  EXPECT_EQ(arrayOf(filter, "Background"), nullptr);
  EXPECT_EQ(arrayOf(filter, "BackgroundDisplacement"), nullptr);
}

// The colours of an image behind the flow are those of the file.
TEST(Cutoffs, ABackgroundImageFillsWhatIsSeen)
{
  auto filter = benchOf(bending(0, 0), Filter::BACKGROUND_ORIENTED, 1);
  filter->SetBackgroundPattern(Filter::PICTURE);
  filter->SetBackgroundImage(
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAAD"
    "ElEQVR4nGP4L6AAAANBATCX20YHAAAAAElFTkSuQmCC");
  expectColor(colorOf(filter), { 255, 16, 32 }, "the one pixel");
}

// What a view shows behind the flow: its bytes, where nothing bends light, and nothing is traced for another scene.
TEST(Cutoffs, AScenesBytesAreKept)
{
  auto filter = benchOf(bending(0, 0), Filter::BACKGROUND_ORIENTED, 1);
  filter->SetBackgroundPattern(Filter::SCENE);
  vtkNew<vtkImageData> scene;
  scene->SetDimensions(pixels, pixels, 1);
  scene->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* bytes = vtkUnsignedCharArray::SafeDownCast(scene->GetPointData()->GetScalars());
  for (vtkIdType i = 0; i < bytes->GetNumberOfValues(); ++i)
  {
    bytes->SetValue(i, static_cast<unsigned char>(i % 3 * 60 + i / (3 * pixels)));
  }
  filter->SetBackgroundScene(scene, -1);
  filter->Update();
  vtkDataArray* color = arrayOf(filter, "Color");
  ASSERT_NE(color, nullptr);
  ASSERT_EQ(color->GetNumberOfValues(), bytes->GetNumberOfValues());
  for (vtkIdType i = 0; i < bytes->GetNumberOfValues(); ++i)
  {
    EXPECT_NEAR(color->GetComponent(i / 3, static_cast<int>(i % 3)), bytes->GetValue(i), 1) << i;
  }

  const vtkMTimeType time = filter->GetMTime();
  filter->SetBackgroundScene(scene, -1);
  EXPECT_EQ(filter->GetMTime(), time);
  const vtkTypeInt64 rays = filter->GetTotalRaysTraced();
  bytes->Fill(200);
  filter->SetBackgroundScene(scene, 3);
  EXPECT_GT(filter->GetMTime(), time);
  filter->Update();
  EXPECT_EQ(filter->GetTotalRaysTraced(), rays);
  EXPECT_NEAR(arrayOf(filter, "Color")->GetComponent(0, 0), 200, 1);
}

TEST(Cutoffs, LightAndSaturationAreAccountedFor)
{
  auto filter = benchOf(bending(epsX, 0), Filter::KNIFE_EDGE, 5000);
  EXPECT_NEAR(intensityOf(filter), 0.6, 1e-3);
  EXPECT_EQ(fieldValue(filter, "SaturatedShare"), 0);
  const double emitted = fieldValue(filter, "LightEmitted");
  EXPECT_NEAR(fieldValue(filter, "LightOnFilm") + fieldValue(filter, "LightOutside"), emitted,
    1e-6 * emitted);
  EXPECT_NEAR(
    fieldValue(filter, "LightOnFilm"), 0.6, 0.01); // of the light that the pixels could have
  filter->SetKScale(1e6);
  EXPECT_EQ(intensityOf(filter), 1);
  EXPECT_EQ(fieldValue(filter, "SaturatedShare"), 1);
}

// A bin has its place at its centre; all rays of this field belong to one.
TEST(Cutoffs, TheHistogramHasTheRaysWhereTheyMeetTheCutoff)
{
  auto filter = benchOf(bending(epsX, -epsY), Filter::KNIFE_EDGE, 1);
  filter->SetSamplesPerPixel(3);
  filter->Update();
  auto* histogram = vtkImageData::SafeDownCast(filter->GetOutputDataObject(Filter::HISTOGRAM_PORT));
  vtkDataArray* rays = histogram->GetPointData()->GetArray("Rays");
  ASSERT_NE(rays, nullptr);
  ASSERT_EQ(rays->GetNumberOfTuples(), 256 * 256);
  double sum = 0, u = 0, v = 0;
  for (vtkIdType i = 0; i < rays->GetNumberOfTuples(); ++i)
  {
    const double count = rays->GetComponent(i, 0);
    sum += count;
    u += count * histogram->GetPoint(i)[0];
    v += count * histogram->GetPoint(i)[1];
  }
  EXPECT_EQ(sum, 3 * pixels * pixels);
  EXPECT_NEAR(u / sum, epsX, 0.51 * histogram->GetSpacing()[0]);
  EXPECT_NEAR(v / sum, -epsY, 0.51 * histogram->GetSpacing()[1]);
  EXPECT_LT(histogram->GetBounds()[1], 4 * epsY) << "Most bins are empty";
  EXPECT_STREQ(rays->GetInformation()->Get(vtkDataArray::UNITS_LABEL()), "1");
}
