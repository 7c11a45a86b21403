// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The index models that take several arrays: mixtures of gases, and moist air.
#include "Fixtures.h"

#include "vtkMultiBlockDataSet.h"

#include "Schlieren.h"

#include <limits>
#include <ostream>

namespace
{

constexpr double helium = 1.95e-4;       // K, m^3/kg
constexpr double heliumMass = 0.0040026; // kg/mol
constexpr double air = 2.26e-4;          // K, m^3/kg
constexpr double airMass = 0.0289647;    // kg/mol
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double celsius = 273.15;

double density(const Vec& x) { return 1.2 + 0.3 * x[0]; }
double fraction(const Vec& x) { return 0.5 + 0.4 * x[1]; }
double temperature(const Vec& x) { return 290 + 10 * x[2]; }
double pressure(const Vec& x) { return 100e3 + 5e3 * x[0]; }
double humidity(const Vec& x) { return 0.5 + 0.5 * x[1]; }

using AddArray = std::function<void(const char*, const ScalarField&)>;

void addAll(const AddArray& add)
{
  add("rho", density);
  add("Y_He", fraction);
  add("T", temperature);
  add("p", pressure);
  add("RH", humidity);
}

vtkSmartPointer<vtkImageData> flow(int points = 9)
{
  auto image = cube(points);
  addAll([&](const char* name, const ScalarField& field) { addPointArray(image, name, field); });
  return image;
}

vtkSmartPointer<vtkImageData> flowInCells(int points = 9)
{
  auto image = cube(points);
  addAll([&](const char* name, const ScalarField& field) { addCellArray(image, name, field); });
  return image;
}

void choose(vtkAlgorithm* filter, int index, const char* name)
{
  filter->SetInputArrayToProcess(index, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name);
}

template <class Filter>
void chooseMixture(Filter* filter)
{
  filter->SetIndexModel(vtkRefractiveIndex::GLADSTONE_DALE_MIXTURE);
  choose(filter, vtkRefractiveIndex::DENSITY, "rho");
  filter->AddMixtureArray("Y_He");
  filter->AddMixtureGas("1.95e-4");
  filter->SetBackgroundGas("2.26e-4");
}

template <class Filter>
void chooseCiddor(Filter* filter)
{
  filter->SetIndexModel(vtkRefractiveIndex::CIDDOR);
  choose(filter, vtkRefractiveIndex::TEMPERATURE, "T");
  choose(filter, vtkRefractiveIndex::PRESSURE, "p");
}

vtkSmartPointer<vtkRefractiveIndex> automatic(vtkDataObject* input)
{
  auto filter = vtkSmartPointer<vtkRefractiveIndex>::New();
  filter->SetInputDataObject(input);
  return filter;
}

vtkSmartPointer<vtkRefractiveIndex> mixture(vtkDataObject* input)
{
  auto filter = automatic(input);
  chooseMixture(filter.Get());
  return filter;
}

vtkSmartPointer<vtkRefractiveIndex> ciddor(vtkDataObject* input)
{
  auto filter = automatic(input);
  chooseCiddor(filter.Get());
  return filter;
}

double ciddorOf(const Vec& x, double relativeHumidity)
{
  return schlieren::ciddorRefractivity(
    temperature(x), pressure(x), relativeHumidity, 450, 632.8e-9);
}

double mixtureOf(const Vec& x)
{
  return density(x) * (helium * fraction(x) + air * (1 - fraction(x)));
}

/// The largest error of N anywhere in the output, relative to the truth; there is gas everywhere.
double largestError(vtkRefractiveIndex* filter, const ScalarField& truth)
{
  filter->Update();
  const std::vector<PlacedValue> values = refractivityOf(filter);
  double error = values.empty() ? HUGE_VAL : 0;
  for (const PlacedValue& n : values)
  {
    EXPECT_TRUE(std::isfinite(n.value));
    error = std::max(error, std::abs(n.value / truth(n.place) - 1));
  }
  return error;
}

constexpr double rounding = 1e-15;

} // namespace

// Merzkirch 1987: every gas refracts as if alone, N = rho (K_He Y + K_air (1 - Y)).
TEST(Mixture, OfTwoGasesByMass) { EXPECT_LT(largestError(mixture(flow()), mixtureOf), rounding); }

// Two species and a background.
TEST(Mixture, OfThreeGases)
{
  auto image = flow();
  addPointArray(image, "Y_CO2", [](const Vec& x) { return 0.05 + 0.05 * x[2]; });
  auto filter = mixture(image);
  filter->AddMixtureArray("Y_CO2");
  filter->AddMixtureGas("2.3e-4");
  EXPECT_LT(largestError(filter,
              [](const Vec& x)
              {
                const double second = 0.05 + 0.05 * x[2];
                return density(x) *
                  (helium * fraction(x) + 2.3e-4 * second + air * (1 - fraction(x) - second));
              }),
    rounding);
}

// Volumes weigh by molar mass: half helium, half air has K = 2.22e-4, not the mean 2.105e-4.
TEST(Mixture, OfVolumes)
{
  auto filter = mixture(flow());
  filter->SetFractionType(vtkRefractiveIndex::VOLUME);
  filter->ClearMixtureGases();
  filter->AddMixtureGas("1.95e-4 0.0040026");
  filter->SetBackgroundGas("  2.26E-4\t28.9647e-3 "); // any spaces and ways to write numbers
  EXPECT_LT(largestError(filter,
              [](const Vec& x)
              {
                const double light = heliumMass * fraction(x);
                const double heavy = airMass * (1 - fraction(x));
                return density(x) * (helium * light + air * heavy) / (light + heavy);
              }),
    rounding);
  filter->Update();
  const vtkIdType centre = 364; // rho = 1.2, X = 1/2
  EXPECT_NEAR(arrayOf(filter, "Refractivity")->GetComponent(centre, 0), 1.2 * 2.22e-4, 1.2 * 3e-7);
}

// N = sum K_i rho_i over the partial densities.
TEST(Mixture, OfPartialDensities)
{
  auto data = flow();
  addPointArray(data, "rho_He", [](const Vec& x) { return density(x) * fraction(x); });
  auto filter = automatic(data);
  filter->SetIndexModel(vtkRefractiveIndex::GLADSTONE_DALE_MIXTURE);
  filter->AddMixtureArray("rho_He");
  filter->AddMixtureGas("1.95e-4");
  filter->SetBackgroundGas("2.26e-4");
  EXPECT_LT(largestError(filter, mixtureOf), 2 * rounding);
  filter->SetDensityScale(2);
  EXPECT_LT(largestError(filter, [](const Vec& x) { return 2 * mixtureOf(x); }), 2 * rounding);
}

// rho = p / (R T sum Y_i / M_i), by volume p sum X_i M_i / (R T).
TEST(Mixture, OfTemperatureAndPressureIsAnIdealGas)
{
  auto data = flow();
  data->GetPointData()->RemoveArray("rho");
  data->GetPointData()->RemoveArray("RH");
  const auto gas = [](const char* name) { return schlieren::findGas(name); };
  const double one = gas("He")->constantAt(632.8e-9), other = gas("air")->constantAt(632.8e-9);
  const double M = gas("He")->molarMass, airM = gas("air")->molarMass;
  const auto truth = [&](double pascals, const Vec& x)
  {
    const double y = fraction(x);
    return pascals / (8.31446261815324 * temperature(x)) * (one * y + other * (1 - y)) /
      (y / M + (1 - y) / airM);
  };
  auto filter = automatic(data);
  EXPECT_LT(
    largestError(filter, [&](const Vec& x) { return truth(pressure(x), x); }), 4 * rounding);
  EXPECT_STREQ(filter->GetArraysUsed(),
    "Temperature: 'T'; Pressure: 'p'; fractions: 'Y_He'; density: that of an ideal gas.");
  filter->SetUniformPressure(5e4);
  EXPECT_LT(largestError(filter, [&](const Vec& x) { return truth(5e4, x); }), 4 * rounding);
  filter->SetUniformPressure(0);
  filter->SetIndexModel(vtkRefractiveIndex::GLADSTONE_DALE_MIXTURE);
  filter->AddMixtureArray("Y_He");
  filter->AddMixtureGas("He");
  filter->SetFractionType(1);
  EXPECT_LT(largestError(filter,
              [&](const Vec& x)
              {
                const double X = fraction(x);
                return pressure(x) / (8.31446261815324 * temperature(x)) *
                  (one * X * M + other * (1 - X) * airM);
              }),
    4 * rounding);
  // A gas of the user's own is no mixture.
  auto single = automatic(data);
  single->SetGas("helium");
  EXPECT_LT(largestError(single, [](const Vec& x) { return ciddorOf(x, 0); }), rounding);
}

TEST(Mixture, OfCells) { EXPECT_LT(largestError(mixture(flowInCells()), mixtureOf), rounding); }

TEST(Mixture, OfBlocksThatHaveAllArrays)
{
  auto left = flow(), right = flow(), without = flow(), cells = flowInCells();
  right->SetOrigin(1, -1, -1);
  cells->SetOrigin(3, -1, -1);
  without->SetOrigin(5, -1, -1);
  without->GetPointData()->RemoveArray("Y_He");
  for (vtkImageData* image : { left.Get(), right.Get() })
  {
    addPointArray(image, "rho", [](const Vec&) { return 1.2; });
    addPointArray(image, "Y_He", [](const Vec&) { return 0.25; });
  }
  addCellArray(cells, "rho", [](const Vec&) { return 1.2; });
  addCellArray(cells, "Y_He", [](const Vec&) { return 0.25; });
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, left);
  blocks->SetBlock(1, right);
  blocks->SetBlock(2, cells);
  blocks->SetBlock(3, without);
  auto filter = mixture(blocks);
  EXPECT_LT(
    largestError(filter, [](const Vec&) { return 1.2 * (0.25 * helium + 0.75 * air); }), 1e-12);
  EXPECT_EQ(refractivityOf(filter).size(), 2u * 729 + 512); // the last block has none
}

TEST(Mixture, OfBlocksThatHaveOneArrayEachIsAMistake)
{
  auto first = flow(), second = flow();
  first->GetPointData()->RemoveArray("Y_He");
  second->GetPointData()->RemoveArray("rho");
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, first);
  blocks->SetBlock(1, second);
  auto filter = mixture(blocks);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  ASSERT_EQ(complaints->Errors.size(), 1u);
  EXPECT_NE(complaints->Errors[0].find("No block"), std::string::npos) << complaints->Errors[0];
  EXPECT_TRUE(isEmpty(filter));
}

TEST(Mixture, ThatExceedsOneIsWarnedOfOnce)
{
  auto image = flow();
  vtkDataArray* y = image->GetPointData()->GetArray("Y_He");
  y->SetComponent(0, 0, 1.005); // rounding
  y->SetComponent(1, 0, 1.02);
  y->SetComponent(2, 0, notANumber);
  auto filter = mixture(image);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_TRUE(complaints->Errors.empty());
  ASSERT_EQ(complaints->Warnings.size(), 1u);
  EXPECT_NE(complaints->Warnings[0].find("0.137 %"), std::string::npos) // 1 of 728
    << complaints->Warnings[0];
  EXPECT_TRUE(std::isfinite(refractivityOf(filter)[1].value));
  EXPECT_TRUE(std::isnan(refractivityOf(filter)[2].value));
}

TEST(Ciddor, OfFields)
{
  EXPECT_LT(largestError(ciddor(flow()), [](const Vec& x) { return ciddorOf(x, 0); }), rounding);
  EXPECT_LT(
    largestError(ciddor(flowInCells()), [](const Vec& x) { return ciddorOf(x, 0); }), 1e-14);
}

TEST(Ciddor, HumidityIsAnArrayOrANumber)
{
  auto filter = ciddor(flow());
  filter->SetRelativeHumidity(0.8);
  EXPECT_LT(largestError(filter, [](const Vec& x) { return ciddorOf(x, 0.8); }), rounding);
  choose(filter, vtkRefractiveIndex::HUMIDITY, "RH");
  EXPECT_LT(largestError(filter, [](const Vec& x) { return ciddorOf(x, humidity(x)); }), rounding);
  choose(filter, vtkRefractiveIndex::HUMIDITY, "None");
  EXPECT_LT(largestError(filter, [](const Vec& x) { return ciddorOf(x, 0.8); }), rounding);
}

// A pressure that is the same everywhere takes the place of the array, also where humidity is one.
TEST(Ciddor, PressureIsAnArrayOrANumber)
{
  constexpr double pascals = 9e4;
  const auto expected = [](const Vec& x)
  { return schlieren::ciddorRefractivity(temperature(x), pascals, humidity(x), 450, 632.8e-9); };
  auto image = flow();
  auto filter = ciddor(image);
  filter->SetUniformPressure(pascals);
  choose(filter, vtkRefractiveIndex::HUMIDITY, "RH");
  EXPECT_LT(largestError(filter, expected), rounding);

  // Of a temperature alone it makes air without any choice.
  vtkNew<vtkImageData> warm;
  warm->CopyStructure(image);
  warm->GetPointData()->AddArray(image->GetPointData()->GetArray("T"));
  auto filterOfOne = automatic(warm);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filterOfOne));
  filterOfOne->Update();
  ASSERT_EQ(complaints->Errors.size(), 1u);
  EXPECT_NE(complaints->Errors[0].find("UniformPressure"), std::string::npos)
    << complaints->Errors[0];
  filterOfOne->SetUniformPressure(pascals);
  EXPECT_LT(largestError(filterOfOne,
              [](const Vec& x)
              { return schlieren::ciddorRefractivity(temperature(x), pascals, 0, 450, 632.8e-9); }),
    rounding);
  filterOfOne->SetUniformPressure(-1);
  filterOfOne->Update();
  ASSERT_EQ(complaints->Errors.size(), 2u); // as for 0
  EXPECT_NE(complaints->Errors[1].find("UniformPressure"), std::string::npos)
    << complaints->Errors[1];
  auto wrong = ciddor(image);
  wrong->SetUniformPressure(-1);
  complaints = vtkSmartPointer<Complaints>::Take(new Complaints(wrong));
  wrong->Update();
  ASSERT_EQ(complaints->Errors.size(), 1u);
  EXPECT_NE(complaints->Errors[0].find("no pressure"), std::string::npos) << complaints->Errors[0];
}

TEST(Ciddor, ScalesAndWavelengthCount)
{
  auto image = cube(4);
  addPointArray(image, "T [degR]", [](const Vec&) { return 293.15 * 1.8; }); // degrees Rankine
  addPointArray(image, "p", [](const Vec&) { return 1013.25; });             // hPa
  auto filter = ciddor(image);
  choose(filter, vtkRefractiveIndex::TEMPERATURE, "T [degR]");
  filter->SetPressureScale(100);
  filter->SetWavelength(532);
  EXPECT_LT(
    largestError(filter,
      [](const Vec&) { return schlieren::ciddorRefractivity(293.15, 101325, 0, 450, 532e-9); }),
    1e-14);
}

// As an index model, or as the gas of Auto beside a density, of points or cells, in degrees of a kind.
TEST(Water, OfATemperature)
{
  const auto expected = [](const Vec& x)
  { return schlieren::waterRefractivity(temperature(x), 632.8e-9); };
  for (const auto& image : { flow(), flowInCells() })
  {
    for (const bool byGas : { false, true })
    {
      auto filter = automatic(image);
      byGas ? filter->SetGas("water") : filter->SetIndexModel(vtkRefractiveIndex::WATER);
      EXPECT_LT(largestError(filter, expected), 1e-14);
      EXPECT_STREQ(filter->GetArraysUsed(), "Temperature: 'T'.");
    }
  }
  auto celsiusImage = cube(4);
  addPointArray(celsiusImage, "T (C)", [](const Vec& x) { return 20 + x[0]; });
  auto filter = automatic(celsiusImage);
  filter->SetGas("water");
  filter->SetWavelength(532);
  EXPECT_LT(
    largestError(filter,
      [](const Vec& x) { return schlieren::waterRefractivity(20 + celsius + x[0], 532e-9); }),
    1e-14);

  auto steam = cube(4);
  addPointArray(steam, "T", [](const Vec& x) { return x[0] < 0 ? 300 : 500; });
  filter = automatic(steam);
  filter->SetGas("water");
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_TRUE(complaints->Warnings.empty() && complaints->Errors.empty());
  EXPECT_EQ(std::string(filter->GetArraysUsed())
              .rfind("Temperature: 'T'. 50 % of the points lie outside 0 to 100 C", 0),
    0u)
    << filter->GetArraysUsed();
}

TEST(Water, MistakesAreOneMessageEach)
{
  const auto automaticOf = [](vtkDataObject* input)
  {
    auto filter = automatic(input);
    filter->SetGas("water");
    return filter;
  };
  const auto heal = [](vtkRefractiveIndex* filter)
  {
    filter->SetIndexModel(vtkRefractiveIndex::AUTO);
    filter->SetWavelength(632.8);
  };
  expectOneMessage(
    automaticOf(flow()).Get(),
    [](vtkRefractiveIndex* filter) { filter->SetIndexModel(vtkRefractiveIndex::GLADSTONE_DALE); },
    { "Gas is water", "IndexModel to Water" }, heal);
  expectOneMessage(
    automaticOf(flow()).Get(), [](vtkRefractiveIndex* filter) { filter->SetWavelength(3000); },
    { "Wavelength is 3000 nm", "200 and 1900 nm" }, heal);
  auto cold = cube(4);
  addPointArray(cold, "T", [](const Vec& x) { return 20 + x[0]; });
  auto filter = automaticOf(cold);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  ASSERT_EQ(complaints->Errors.size(), 1u);
  EXPECT_NE(complaints->Errors[0].find("'T' is not in kelvins"), std::string::npos);
}

namespace
{

/// N of an electron density, m^-3, from the constants of nature (CODATA 2018).
double refractivityOfElectrons(double density, double wavelength)
{
  constexpr double charge = 1.602176634e-19, mass = 9.1093837015e-31,
                   permittivity = 8.8541878128e-12, speed = 299792458;
  const double frequency = 2 * M_PI * speed / wavelength;
  const double critical = permittivity * mass * frequency * frequency / (charge * charge);
  return std::sqrt(1 - density / critical) - 1;
}

double electrons(const Vec& x) { return 1e25 * (2 + x[0] + x[1]); }

} // namespace

// N of electrons and of a gas beside them add up, of points and of cells; which arrays, and in what unit, their names say.
TEST(ElectronDensity, AloneAndBesideAGas)
{
  for (const bool isOfCells : { false, true })
  {
    const auto add = isOfCells ? [](vtkDataSet* data, const char* name, const ScalarField& field)
    { addCellArray(data, name, field); }
                               : [](vtkDataSet* data, const char* name, const ScalarField& field)
    { addPointArray(data, name, field); };
    auto image = cube(5);
    add(image, "ne [cm^-3]", [](const Vec& x) { return 1e-6 * electrons(x); });
    auto filter = automatic(image);
    filter->SetGladstoneDaleConstant(air);
    filter->SetWavelength(532);
    EXPECT_LT(largestError(
                filter, [](const Vec& x) { return refractivityOfElectrons(electrons(x), 532e-9); }),
      1e-8);
    EXPECT_STREQ(filter->GetArraysUsed(), "IndexArray: 'ne [cm^-3]' times 1e+06.");

    add(image, "rho", density);
    const auto both = [](const Vec& x)
    { return refractivityOfElectrons(electrons(x), 532e-9) + air * density(x); };
    image->Modified();
    EXPECT_LT(largestError(filter, both), 1e-8);
    EXPECT_STREQ(filter->GetArraysUsed(), "IndexArray: 'ne [cm^-3]' times 1e+06; Density: 'rho'.");
    filter->SetInputArrayToProcess(vtkRefractiveIndex::DENSITY, 0, 0,
      isOfCells ? vtkDataObject::FIELD_ASSOCIATION_CELLS : vtkDataObject::FIELD_ASSOCIATION_POINTS,
      "rho"); // chosen, as ParaView does
    EXPECT_LT(largestError(filter, both), 1e-8);
    filter->SetIndexModel(vtkRefractiveIndex::GLADSTONE_DALE);
    EXPECT_LT(largestError(filter, [](const Vec& x) { return air * density(x); }), 1e-14);
  }
}

// Light does not enter where they are above the critical density; which unit is not known, or not meant, is said.
TEST(ElectronDensity, Mistakes)
{
  auto image = cube(5);
  addPointArray(image, "ne", [](const Vec& x) { return x[0] < 0 ? 1e25 : 1e28; });
  auto filter = automatic(image);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  ASSERT_EQ(complaints->Warnings.size(), 1u);
  EXPECT_NE(
    complaints->Warnings[0].find("critical one, 2.7841e+27 m^-3 at this Wavelength, in 60 %"),
    std::string::npos)
    << complaints->Warnings[0];
  EXPECT_TRUE(std::isnan(arrayOf(filter, "Refractivity")->GetComponent(4, 0)));

  addPointArray(image, "ne [1e19/m3]", electrons);
  addPointArray(image, "few", [](const Vec& x) { return 1e10 * (2 + x[0]); });
  filter = automatic(image);
  filter->SetIndexModel(vtkRefractiveIndex::ELECTRON_DENSITY);
  expectOneMessage(
    filter.Get(),
    [](vtkRefractiveIndex* f) { choose(f, vtkRefractiveIndex::INDEX_ARRAY, "ne [1e19/m3]"); },
    { "unit in the name of the electron density 'ne [1e19/m3]'", "Calculator" },
    [](vtkRefractiveIndex* f) { choose(f, vtkRefractiveIndex::INDEX_ARRAY, "ne"); });
  auto few = automatic(image);
  few->SetIndexModel(vtkRefractiveIndex::ELECTRON_DENSITY);
  choose(few.Get(), vtkRefractiveIndex::INDEX_ARRAY, "few");
  complaints = vtkSmartPointer<Complaints>::Take(new Complaints(few));
  few->Update();
  ASSERT_EQ(complaints->Warnings.size(), 1u);
  EXPECT_NE(complaints->Warnings[0].find("too low to bend light"), std::string::npos);
}

// A plasma of 1e19 cm^-3 in 532 nm: the integral of N along the axis is that of the closed form, to a thousandth.
TEST(ElectronDensity, PathThroughAPlasma)
{
  auto image = cube(81, 4);
  addPointArray(image, "ne", [](const Vec& x) { return 1e25 * std::exp(-dot(x, x)); });
  auto filter = bench(image, 33);
  filter->SetIndexModel(vtkRefractiveIndex::AUTO);
  filter->SetInputArrayToProcess(vtkRefractiveIndex::INDEX_ARRAY, 0, 0, 0, "");
  filter->SetWavelength(532);
  filter->SetLengthScale(1e-3);
  filter->Update();
  const std::vector<double> path = valuesOf(filter, "OpticalPathDifference");
  EXPECT_NEAR(2 * M_PI * path[path.size() / 2] / 532e-9, -26.5837, 2e-3);
}

// A line beside the arrays, and nothing to be warned of; percents of humidity are.
TEST(Ciddor, OutsideItsRangeIsSaidBesideTheArrays)
{
  auto image = flow(10);
  vtkDataArray* t = image->GetPointData()->GetArray("T");
  for (int i = 0; i < 250; ++i)
  {
    t->SetComponent(i, 0, 1500);
  }
  auto filter = bench(image);
  chooseCiddor(filter.Get());
  filter->SetGas("nitrogen"); // needs no word on fractions
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_FALSE(isEmpty(filter));
  auto other = bench(image); // which takes the medium of the first
  chooseCiddor(other.Get());
  other->SetGas("nitrogen");
  other->Update();
  for (vtkSchlierenFilter* each : { filter.Get(), other.Get() })
  {
    const std::string used = each->GetArraysUsed();
    EXPECT_EQ(used.rfind("Temperature: 'T'; Pressure: 'p'. 25 % of the points", 0), 0u) << used;
  }
  EXPECT_TRUE(complaints->Warnings.empty());

  addPointArray(image, "percent", [](const Vec&) { return 40; });
  choose(filter.Get(), vtkRefractiveIndex::HUMIDITY, "percent");
  filter->Update();
  filter->SetKnifeEdgeAngle(90);
  filter->Update(); // uses what there is, and repeats nothing
  EXPECT_TRUE(complaints->Errors.empty());
  ASSERT_EQ(complaints->Warnings.size(), 1u);
  EXPECT_NE(complaints->Warnings[0].find("percents by 100"), std::string::npos)
    << complaints->Warnings[0];
}

// A temperature that cannot be is a solid, not a hole in the sums.
TEST(Ciddor, NoSuchGasIsSolid)
{
  auto image = flow();
  image->GetPointData()->GetArray("T")->SetComponent(5, 0, 0);
  auto filter = ciddor(image);
  filter->Update();
  EXPECT_TRUE(std::isnan(refractivityOf(filter)[5].value));
  EXPECT_TRUE(std::isfinite(refractivityOf(filter)[6].value));
}

// What RefractiveIndex has made is used as it stands, whatever the second filter's model, where its arrays are gone.
TEST(Gases, AComputedRefractivityIsHandedOn)
{
  auto first = ciddor(flow());
  first->Update();
  vtkNew<vtkImageData> alone;
  alone->CopyStructure(vtkImageData::SafeDownCast(first->GetOutputDataObject(0)));
  alone->GetPointData()->AddArray(arrayOf(first, "Refractivity"));
  auto second = mixture(alone);
  second->Update();
  EXPECT_EQ(valuesOf(second, "Refractivity"), valuesOf(first, "Refractivity"));
}

namespace
{

using Index = vtkRefractiveIndex;

struct Mistake
{
  const char* name;
  bool ofCiddor;
  std::function<void(Index*)> make;
  std::vector<std::string> words;
  std::function<void(Index*)> correct;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

void addSecond(Index* f, const char* name)
{
  f->AddMixtureArray(name);
  f->AddMixtureGas("air");
}

std::function<void(Index*)> setGas(const char* gas)
{
  return [gas](Index* f)
  {
    f->ClearMixtureGases();
    f->AddMixtureGas(gas);
  };
}

std::function<void(Index*)> setVolumes(const char* gas, const char* background)
{
  return [gas, background](Index* f)
  {
    f->SetFractionType(Index::VOLUME);
    f->SetBackgroundGas(background);
    setGas(gas)(f);
  };
}

void backToOne(Index* f)
{
  f->ClearMixtureArrays();
  f->AddMixtureArray("Y_He");
  setGas("helium")(f);
}

/// A gas that is none, and what the message says to do.
Mistake noGas(const char* name, const char* text)
{
  return { name, false, setGas(text),
    { std::string("MixtureGases holds '") + text + "'", "not in the table", "helium (He)",
      "such as 2.3e-4 0.044" },
    backToOne };
}

std::vector<Mistake> mistakes()
{
  return {
    { "NoSuchFraction", false, [](Index* f) { addSecond(f, "Y_Ar"); },
      { "no array 'Y_Ar'", "MixtureArrays", "rho", "Y_He" }, backToOne },
    { "NoSuchDensity", false, [](Index* f) { choose(f, Index::DENSITY, "RHO"); },
      { "no array 'RHO'", "Density", "Y_He" }, [](Index* f) { choose(f, Index::DENSITY, "rho"); } },
    { "FractionsOfCells", false, [](Index* f) { addSecond(f, "Y_cells"); },
      { "points (Density 'rho', MixtureArrays 'Y_He')", "cells (MixtureArrays 'Y_cells')" },
      backToOne },
    { "Vectors", false, [](Index* f) { addSecond(f, "U"); },
      { "'U' has 3 components", "MixtureArrays" }, backToOne },
    { "NoGases", false, [](Index* f) { f->ClearMixtureGases(); },
      { "MixtureArrays and MixtureGases differ in length (1 and 0)" }, backToOne },
    { "TooManyGases", false, [](Index* f) { f->AddMixtureGas("1e-4"); },
      { "MixtureGases differ in length (1 and 2)" }, backToOne },
    noGas("Empty", ""),
    noGas("Custom", "Custom"),
    noGas("NanConstant", "nan"),
    noGas("InfiniteConstant", "1e999"),
    noGas("DecimalComma", "2,3e-4"),
    noGas("CommaBetween", "2.3e-4, 0.044"),
    noGas("Unit", "2.3e-4 m3/kg"),
    noGas("NanMolarMass", "2.3e-4 nan"),
    noGas("ThreeNumbers", "2.3e-4 0.044 1"),
    { "NegativeConstant", false, setGas("-1e-4"), { "MixtureGases holds '-1e-4'", "negative" },
      backToOne },
    { "NegativeBackground", false, [](Index* f) { f->SetBackgroundGas("-1 0.03"); },
      { "BackgroundGas holds '-1 0.03'", "negative" },
      [](Index* f) { f->SetBackgroundGas("N2"); } },
    { "NanDensityScale", false, [](Index* f) { f->SetDensityScale(notANumber); },
      { "DensityScale", "finite" }, [](Index* f) { f->SetDensityScale(1); } },
    { "NoMolarMass", false, setVolumes("2.3e-4", "air"),
      { "MixtureGases holds '2.3e-4'", "kg/mol, such as 2.3e-4 0.044", "FractionType to Mass" },
      setVolumes("2.3e-4 0.044", "air") },
    { "NoBackgroundMolarMass", false, setVolumes("He", "2.3e-4"),
      { "BackgroundGas holds '2.3e-4'", "kg/mol" }, setVolumes("He", "2.3e-4 0.044") },
    { "ZeroMolarMass", false, setVolumes("2.3e-4 0", "air"),
      { "MixtureGases holds '2.3e-4 0'", "positive" }, setVolumes("2.3e-4 0.044", "air") },
    { "NoSuchPressure", true, [](Index* f) { choose(f, Index::PRESSURE, "P"); },
      { "no array 'P'", "Pressure", "T" }, [](Index* f) { choose(f, Index::PRESSURE, "p"); } },
    { "NoSuchHumidity", true, [](Index* f) { choose(f, Index::HUMIDITY, "dew"); },
      { "no array 'dew'", "Humidity" }, [](Index* f) { choose(f, Index::HUMIDITY, "RH"); } },
    { "HumidityInPercent", true, [](Index* f) { f->SetRelativeHumidity(50); },
      { "RelativeHumidity is 50", "between 0 and 1" },
      [](Index* f) { f->SetRelativeHumidity(0.5); } },
    { "NanHumidity", true, [](Index* f) { f->SetRelativeHumidity(notANumber); },
      { "RelativeHumidity" }, [](Index* f) { f->SetRelativeHumidity(0); } },
    { "WavelengthInMetres", true, [](Index* f) { f->SetWavelength(632.8e-9); },
      { "Wavelength", "300 and 1700 nm" }, [](Index* f) { f->SetWavelength(632.8); } },
    { "NanWavelength", true, [](Index* f) { f->SetWavelength(notANumber); }, { "Wavelength", "nm" },
      [](Index* f) { f->SetWavelength(300); } },
    { "InfinitePressureScale", true, [](Index* f) { f->SetPressureScale(HUGE_VAL); },
      { "PressureScale", "finite" }, [](Index* f) { f->SetPressureScale(1); } },
  };
}

class GasMistakes : public testing::TestWithParam<Mistake>
{
};

} // namespace

TEST_P(GasMistakes, OneMessageAnEmptyImageAndThenAllIsWell)
{
  const Mistake& mistake = GetParam();
  auto image = flow();
  addCellArray(image, "Y_cells", fraction);
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("U");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(vectors);

  auto filter = mistake.ofCiddor ? ciddor(image) : mixture(image);
  expectOneMessage(filter.Get(), mistake.make, mistake.words, mistake.correct);
}

INSTANTIATE_TEST_SUITE_P(Gases, GasMistakes, testing::ValuesIn(mistakes()),
  [](const testing::TestParamInfo<Mistake>& mistake) { return mistake.param.name; });
