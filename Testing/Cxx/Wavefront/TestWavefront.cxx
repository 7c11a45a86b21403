// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Wavefronts whose aberrations and far fields have closed forms.
#include "Fixtures.h"

#include "vtkTable.h"
#include "vtkWavefront.h"

#include <random>

namespace
{

using Plane = std::function<double(double x, double y)>;

constexpr double diameter = 0.05; // m
constexpr double radius = 0.5 * diameter;
constexpr double wavelength = 632.8e-9;
constexpr int pixels = 256;
constexpr double nowhere = 1e-6; // m, a path of light through the data that says no more

/// An image as wide as the aperture, with this path.
vtkSmartPointer<vtkImageData> imageOf(const Plane& path, int columns = pixels, int rows = pixels)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(columns, rows, 1);
  const double spacing = diameter / pixels;
  image->SetSpacing(spacing, spacing, spacing);
  image->SetOrigin(0.5 * spacing * (1 - columns), 0.5 * spacing * (1 - rows), 0);
  addPointArray(
    image, "OpticalPathDifference", [&](const Vec& x) { return nowhere + path(x[0], x[1]); });
  return image;
}

vtkSmartPointer<vtkWavefront> wavefrontOf(vtkImageData* image)
{
  auto filter = vtkSmartPointer<vtkWavefront>::New();
  filter->SetInputData(image);
  filter->SetApertureDiameter(diameter);
  filter->Update();
  return filter;
}

vtkSmartPointer<vtkWavefront> wavefrontOf(const Plane& path) { return wavefrontOf(imageOf(path)); }

double number(vtkWavefront* filter, const char* name)
{
  vtkTable* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(vtkWavefront::NUMBERS));
  EXPECT_EQ(table->GetNumberOfRows(), 1);
  vtkAbstractArray* column = table->GetColumnByName(name);
  EXPECT_NE(column, nullptr) << name;
  return column ? column->GetVariantValue(0).ToDouble() : std::nan("");
}

/// Noll's coefficients in order, m.
std::vector<double> coefficients(vtkWavefront* filter)
{
  vtkTable* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(vtkWavefront::NUMBERS));
  std::vector<double> found;
  for (vtkIdType i = 0; i < table->GetNumberOfColumns(); ++i)
  {
    if (table->GetColumnName(i)[0] == 'Z')
    {
      found.push_back(number(filter, table->GetColumnName(i)));
    }
  }
  return found;
}

vtkImageData* farField(vtkWavefront* filter)
{
  return vtkImageData::SafeDownCast(filter->GetOutputDataObject(vtkWavefront::FAR_FIELD));
}

/// A value of the far field so many points to the right of its middle.
double beside(vtkWavefront* filter, const char* name, int points)
{
  vtkImageData* field = farField(filter);
  const vtkIdType middle = field->GetNumberOfPoints() / 2;
  return field->GetPointData()->GetArray(name)->GetComponent(middle + points, 0);
}

/// Table I of Noll (1976), as printed.
const std::vector<std::function<double(double r, double t)>> noll = {
  [](double, double) { return 1; },
  [](double r, double t) { return 2 * r * std::cos(t); },
  [](double r, double t) { return 2 * r * std::sin(t); },
  [](double r, double) { return std::sqrt(3.) * (2 * r * r - 1); },
  [](double r, double t) { return std::sqrt(6.) * r * r * std::sin(2 * t); },
  [](double r, double t) { return std::sqrt(6.) * r * r * std::cos(2 * t); },
  [](double r, double t) { return std::sqrt(8.) * (3 * r * r * r - 2 * r) * std::sin(t); },
  [](double r, double t) { return std::sqrt(8.) * (3 * r * r * r - 2 * r) * std::cos(t); },
  [](double r, double t) { return std::sqrt(8.) * r * r * r * std::sin(3 * t); },
  [](double r, double t) { return std::sqrt(8.) * r * r * r * std::cos(3 * t); },
  [](double r, double) { return std::sqrt(5.) * (6 * std::pow(r, 4) - 6 * r * r + 1); },
  [](double r, double t)
  { return std::sqrt(10.) * (4 * std::pow(r, 4) - 3 * r * r) * std::cos(2 * t); },
  [](double r, double t)
  { return std::sqrt(10.) * (4 * std::pow(r, 4) - 3 * r * r) * std::sin(2 * t); },
  [](double r, double t) { return std::sqrt(10.) * std::pow(r, 4) * std::cos(4 * t); },
  [](double r, double t) { return std::sqrt(10.) * std::pow(r, 4) * std::sin(4 * t); },
};

double term(std::size_t index, double x, double y)
{
  return noll[index](std::hypot(x, y) / radius, std::atan2(y, x));
}

} // namespace

TEST(Wavefront, SingleZernikeTermsAreRecovered)
{
  constexpr double a = 1e-7;
  for (std::size_t index = 0; index < noll.size(); ++index)
  {
    auto filter = wavefrontOf([&](double x, double y) { return a * term(index, x, y); });
    std::vector<double> found = coefficients(filter);
    ASSERT_EQ(found.size(), noll.size());
    found[0] -= nowhere;
    for (std::size_t other = 0; other < noll.size(); ++other)
    {
      EXPECT_NEAR(found[other] / a, other == index ? 1 : 0, 1e-6) << index + 1 << " " << other + 1;
    }
  }
}

TEST(Wavefront, TermsOfASumAddUpInTheirSquares)
{
  std::vector<double> given;
  for (std::size_t index = 0; index < noll.size(); ++index)
  {
    given.push_back(1e-8 * (1 + static_cast<double>(index * 7 % 5)));
  }
  const Plane sum = [&](double x, double y)
  {
    double value = 0;
    for (std::size_t index = 0; index < noll.size(); ++index)
    {
      value += given[index] * term(index, x, y);
    }
    return value;
  };
  auto filter = wavefrontOf(sum);
  const std::vector<double> found = coefficients(filter);
  double squares = 0;
  for (std::size_t index = 1; index < noll.size(); ++index)
  {
    EXPECT_NEAR(found[index] / given[index], 1, 1e-6);
    squares += index > 2 ? given[index] * given[index] : 0;
  }
  EXPECT_NEAR(number(filter, "OPDrms") / std::sqrt(squares), 1, 3e-3);

  filter->SetZernikeTerms(66); // the others are not there
  filter->Update();
  const std::vector<double> all = coefficients(filter);
  ASSERT_EQ(all.size(), 66u);
  for (std::size_t index = 1; index < all.size(); ++index)
  {
    EXPECT_NEAR(all[index] / 1e-8, index < noll.size() ? given[index] / 1e-8 : 0, 1e-6);
  }
}

TEST(Wavefront, PlaneWavefrontHasAnAiryPattern)
{
  auto image = imageOf([](double, double) { return 0; });
  for (const double lengthScale : { 1., 0.01 })
  {
    vtkNew<vtkDoubleArray> scale;
    scale->SetName("LengthScale");
    scale->InsertNextValue(lengthScale);
    image->GetFieldData()->AddArray(scale);
    auto filter = wavefrontOf(image);
    EXPECT_NEAR(number(filter, "StrehlRatio"), 1, 1e-9);
    EXPECT_NEAR(number(filter, "StrehlMarechal"), 1, 1e-9);
    EXPECT_NEAR(beside(filter, "PointSpread", 0), 1, 1e-9);
    // 1 - J0^2 - J1^2 at the first zero of J1.
    EXPECT_NEAR(number(filter, "EncircledEnergy"), 0.8378, 0.002);

    const double width = wavelength / (lengthScale * diameter);
    const double angle = farField(filter)->GetSpacing()[0];
    const auto airy = [&](double angles)
    {
      const double v = pi * angles / width;
      const double ratio = 2 * std::cyl_bessel_j(1., v) / v;
      return ratio * ratio;
    };
    int darkest = 1;
    for (int points = 1; points < 40; ++points)
    {
      EXPECT_NEAR(beside(filter, "PointSpread", points), airy(points * angle), 2e-3);
      const double v = pi * points * angle / width;
      const double j0 = std::cyl_bessel_j(0., v), j1 = std::cyl_bessel_j(1., v);
      EXPECT_NEAR(beside(filter, "EncircledEnergy", points), 1 - j0 * j0 - j1 * j1, 0.02);
      if (points * angle < 1.5 * width &&
        beside(filter, "PointSpread", points) < beside(filter, "PointSpread", darkest))
      {
        darkest = points;
      }
    }
    EXPECT_NEAR(darkest * angle / width, 1.21967, 0.5 * angle / width);
    EXPECT_LT(beside(filter, "PointSpread", darkest), 1e-3);
  }
}

TEST(Wavefront, StrehlOfDefocusIsItsClosedForm)
{
  double coarsest = 0;
  for (const double rms : { 0.05, 0.2, 0.4 }) // wavelengths
  {
    auto filter = wavefrontOf([&](double x, double y) { return rms * wavelength * term(3, x, y); });
    const double phase = 2 * pi * rms;
    EXPECT_NEAR(number(filter, "OPDrms") / (rms * wavelength), 1, 2e-3);
    EXPECT_NEAR(number(filter, "StrehlMarechal"), std::exp(-phase * phase), 2e-3);
    if (rms < 0.3) // further on, the axis is not where it is brightest
    {
      const double u = std::sqrt(3.) * phase;
      EXPECT_NEAR(number(filter, "StrehlRatio"), std::pow(std::sin(u) / u, 2), 2e-3);
    }
    if (rms < 0.1)
    {
      EXPECT_NEAR(number(filter, "StrehlRatio"), number(filter, "StrehlMarechal"), 0.01);
    }
    coarsest = farField(filter)->GetSpacing()[0] * diameter / wavelength;
    EXPECT_GT(beside(filter, "EncircledEnergy", 128), 0.95) << rms;
    filter->RemoveFocusOn();
    filter->Update();
    EXPECT_NEAR(number(filter, "StrehlRatio"), 1, 1e-6);
  }
  EXPECT_NEAR(coarsest, 0.125, 1e-9);
}

TEST(Wavefront, FarFieldIsWiderWhereLightIs)
{
  // Of geometric optics, the edge of a defocused beam is at 8 sqrt(3) rms / D.
  constexpr double rms = 1.5; // wavelengths
  auto filter = wavefrontOf([&](double x, double y) { return rms * wavelength * term(3, x, y); });
  const double width = wavelength / diameter;
  const double angle = farField(filter)->GetSpacing()[0];
  EXPECT_NEAR(angle / width, 0.25, 1e-9);
  const int edge = static_cast<int>(8 * std::sqrt(3.) * rms * width / angle);
  EXPECT_GT(beside(filter, "EncircledEnergy", edge + 12), 0.95);
  EXPECT_NEAR(beside(filter, "EncircledEnergy", edge / 2), 0.25, 0.05);
}

TEST(Wavefront, StrehlOfGaussianNoiseIsMarechals)
{
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, 0.06 * wavelength);
  auto filter = wavefrontOf([&](double, double) { return normal(random); });
  const double phase = 2 * pi * 0.06;
  EXPECT_NEAR(number(filter, "StrehlRatio"), std::exp(-phase * phase), 3e-3);
  EXPECT_NEAR(number(filter, "StrehlMarechal"), std::exp(-phase * phase), 3e-3);
}

TEST(Wavefront, BrightestPlaceIsFoundBetweenPoints)
{
  // Coma has its peak beside the axis. The truth is a sum over all pixels at many angles.
  const Plane path = [](double x, double y) { return 0.25 * wavelength * term(7, x, y); };
  auto filter = wavefrontOf(path);
  vtkDataArray* residual = arrayOf(filter, "ResidualWavefront");
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  double brightest = 0;
  for (double angle = -1.5; angle < 1.5; angle += 0.008) // wavelengths over the diameter
  {
    double real = 0, imaginary = 0, count = 0;
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      const double value = residual->GetComponent(i, 0);
      if (std::isfinite(value))
      {
        const double phase =
          2 * pi * (value / wavelength - angle * image->GetPoint(i)[0] / diameter);
        real += std::cos(phase);
        imaginary += std::sin(phase);
        ++count;
      }
    }
    brightest = std::max(brightest, (real * real + imaginary * imaginary) / (count * count));
  }
  EXPECT_NEAR(number(filter, "StrehlRatio"), brightest, 5e-5); // the best point: 3e-4 less
}

TEST(Wavefront, TiltAndFocusAreRemoved)
{
  constexpr double right = 3e-6, up = -2e-6, curvature = 1e-4;
  auto filter = wavefrontOf(
    [&](double x, double y) { return right * x + up * y + curvature * (x * x + y * y); });
  EXPECT_NEAR(number(filter, "TiltRight") / right, 1, 1e-6);
  EXPECT_NEAR(number(filter, "TiltUp") / up, 1, 1e-6);
  const double focus = curvature * radius * radius / (2 * std::sqrt(3.));
  EXPECT_NEAR(number(filter, "Z4 Defocus") / focus, 1, 1e-6);
  EXPECT_NEAR(number(filter, "OPDrms") / focus, 1, 2e-3);
  filter->RemoveFocusOn();
  filter->Update();
  EXPECT_LT(number(filter, "OPDrms"), 1e-6 * focus);
  EXPECT_LT(number(filter, "PeakToValley"), 1e-6 * focus);
}

// A layer of air whose density is 1.2 + 0.2 x + 0.005 cos(kx x) cos(kz z), 50 mm thick, at 1000 nm. The numbers are those of
// NumPy's least squares and Fourier transform.
TEST(Wavefront, LayerBeforeABeam)
{
  constexpr double perDensity = 2.26e-4 * 0.05;
  auto filter = wavefrontOf(
    [](double x, double y)
    {
      return perDensity *
        (0.2 * x + 5e-3 * std::cos(2 * pi * x / 0.03) * std::cos(2 * pi * y / 0.04));
    });
  filter->SetWavelength(1000);
  filter->Update();
  EXPECT_NEAR(number(filter, "OPDrms") / 2.85954e-8, 1, 2e-6);
  EXPECT_NEAR(number(filter, "StrehlRatio"), 0.968168, 1e-6);
  EXPECT_NEAR(number(filter, "StrehlMarechal"), 0.968234, 1e-6);
  EXPECT_NEAR(number(filter, "TiltRight") / (0.2 * perDensity), 1, 1e-3);
}

TEST(Wavefront, LargestApertureHasLightThroughTheDataEverywhere)
{
  // Data from column 30 to 89 and row 20 to 59, with still gas in the middle, and a body.
  const double pixel = diameter / pixels;
  const auto place = [&](double x, int points) { return x / pixel + 0.5 * (points - 1); };
  auto image = imageOf([](double, double) { return -nowhere; }, 128, 96);
  addPointArray(image, "OpticalPathDifference",
    [&](const Vec& x)
    {
      const double column = place(x[0], 128), row = place(x[1], 96);
      const bool isInData = 29.5 < column && column < 89.5 && 19.5 < row && row < 59.5;
      const bool isStill = 40.5 < column && column < 50.5 && 30.5 < row && row < 50.5;
      return isInData && !isStill ? nowhere : 0;
    });
  addPointArray(image, "BlockedFraction",
    [&](const Vec& x)
    { return std::hypot(place(x[0], 128) - 80, place(x[1], 96) - 40) < 4.5 ? 1 : 0; });
  vtkNew<vtkWavefront> filter;
  filter->SetInputData(image);
  filter->Update();
  // As high as the data: 40 rows, of which the middle one of a circle is that of a pixel.
  EXPECT_NEAR(number(filter, "ApertureDiameter") / pixel, 39, 1e-9);
  const double row = place(number(filter, "ApertureY"), 96);
  const double column = place(number(filter, "ApertureX"), 128);
  EXPECT_TRUE(std::abs(row - 39) < 1e-6 || std::abs(row - 40) < 1e-6) << row;
  EXPECT_GT(column - 19.5, 29.4);
  EXPECT_LT(column + 19.5, 76);

  filter->SetApertureShape(vtkWavefront::APERTURE_SQUARE);
  filter->Update();
  EXPECT_NEAR(number(filter, "ApertureDiameter") / pixel, 40, 1e-9);
  EXPECT_EQ(number(filter, "AperturePixels"), 1600);
  EXPECT_NEAR(place(number(filter, "ApertureY"), 96), 39.5, 1e-6);
}

TEST(Wavefront, MistakesAreOneMessage)
{
  const Plane flat = [](double, double) { return 0; };
  auto good = imageOf(flat);
  auto filter = wavefrontOf(good);
  using Self = vtkWavefront;
  const auto bring = [&](Self* of)
  {
    of->SetInputData(good);
    of->SetApertureDiameter(diameter);
    of->SetApertureCenter(0, 0);
  };
  const auto expectMessage = [&](vtkImageData* image, double size,
                               const std::vector<double>& middle,
                               const std::vector<std::string>& words)
  {
    expectOneMessage(
      filter.Get(),
      [&](Self* of)
      {
        of->SetInputData(image);
        of->SetApertureDiameter(size);
        of->SetApertureCenter(middle[0], middle[1]);
      },
      words, bring);
  };
  auto none = imageOf(flat);
  none->GetPointData()->Initialize();
  expectMessage(none, 0, { 0, 0 }, { "no point array OpticalPathDifference", "Schlieren" });
  expectMessage(imageOf([](double, double) { return std::nan(""); }), 0, { 0, 0 }, { "No pixel" });
  expectMessage(imageOf([](double, double) { return -nowhere; }), 0, { 0, 0 }, { "No pixel" });
  expectMessage(imageOf(flat, 1, 1), 0, { 0, 0 }, { "too few pixels (1)", "15 Zernike terms" });
  expectMessage(imageOf(flat, 100, 1), 0, { 0, 0 }, { "too few pixels" });
  expectMessage(good, diameter, { 0.2 * diameter, 0 }, { "beyond the image", "ApertureCenter" });
  expectMessage(good, diameter, { 9, 9 }, { "covers no pixel", "ApertureCenter" });
  expectMessage(good, diameter, { std::nan(""), 0 }, { "covers no pixel" });
  auto half = imageOf([](double x, double) { return x < 0 ? std::nan("") : 0; });
  expectMessage(half, diameter, { 0, 0 }, { "no light through the data at 50 %", "Diameter" });
  auto body = imageOf(flat);
  addPointArray(
    body, "BlockedFraction", [](const Vec& x) { return std::abs(x[0]) < 0.002 ? 1 : 0; });
  expectMessage(body, diameter, { 0, 0 }, { "no light through the data", "ApertureCenter" });
}
