// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Index/IndexModels.h"

#include "Math/Units.h"

#include <algorithm>
#include <cmath>

namespace schlieren
{

namespace
{

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

constexpr double micrometre = 1e-6;

/// How far to the infrared a dispersion formula may be continued, metres.
constexpr double longestContinued = 1.7 * micrometre;

bool isWavelength(double metres) { return std::isfinite(metres) && metres > 0; }

/// s = (1 um / wavelength)^2.
double squaredWaveNumber(double wavelengthMetres)
{
  const double perMicrometre = micrometre / wavelengthMetres;
  return perMicrometre * perMicrometre;
}

double evaluate(const Dispersion& dispersion, double s)
{
  const std::array<double, 4>& c = dispersion.powers;
  double sum = c[0] + s * (c[1] + s * (c[2] + s * c[3]));
  for (const Dispersion::Resonance& resonance : dispersion.resonances)
  {
    if (resonance.strength != 0)
    {
      sum += resonance.strength / (resonance.position - s);
    }
  }
  return sum;
}

/// Ciddor 1996, eq. 1: dry air at 15 C and 101325 Pa with 450 ppm of carbon dioxide.
constexpr Dispersion dryAir{ {}, { { { 5792105e-8, 238.0185 }, { 167917e-8, 57.362 } } } };

/// Ciddor 1996, eq. 3: water vapour at 20 C and 1333 Pa. 1.022 is his correction factor.
constexpr Dispersion waterVapour{
  { 1.022e-8 * 295.235, 1.022e-8 * 2.6422, 1.022e-8 * -0.032380, 1.022e-8 * 0.004028 }, {}
};

/// Density of an ideal gas at 0 C and 101325 Pa, kg/m^3.
constexpr double idealDensity(double molarMass) { return molarMass / 22.413969e-3; }

/// N = 2 pi n alpha (Lorentz-Lorenz, dilute) of an ideal gas at 0 C and 101325 Pa by the static polarizability of a
/// molecule in units of a_0^3, which rises with `dispersion` times s.
constexpr Dispersion ofPolarizability(double polarizability, double dispersion = 0)
{
  constexpr double loschmidt = 2.686780e25, cubicBohr = 1.48184711e-31;
  const double atRest = 2 * pi * loschmidt * cubicBohr * polarizability;
  return { { atRest, atRest * dispersion }, {} };
}

/// The wavelengths of eq. 1 (Peck & Reeder 1972, from 0.23 um), and those of NIST's calculator.
constexpr double shortestOfAir = 0.23 * micrometre;
constexpr double longestOfAir = 1.7 * micrometre;

} // namespace

// Densities are those of the state that a formula is for (0 C and 101325 Pa where nothing else is
// said) after the reference equations of state, as in CoolProp 8.0; taking the ideal gas instead
// would put K of CO2 off by 0.7 % and of SF6 by 1.3 %. Dispersion formulas were checked against the
// refractiveindex.info database, those of air and of water vapour against NIST's calculator.
const std::vector<Gas>& gases()
{
  constexpr double um = micrometre;
  constexpr double sodium = 0.5893 * um;
  static const std::vector<Gas> all = {
    { "air", "air", 28.96410e-3, 1.225458, shortestOfAir, 1.69 * um, dryAir,
      "Ciddor 1996, Appl. Opt. 35, 1566, eqs 1 and 4 (dry, 450 ppm CO2, 15 C)" },
    { "nitrogen", "N2", 28.0134e-3, 1.250386, 0.4679 * um, 2.0587 * um,
      { { 6.8552e-5 }, { { { 3.243157e-2, 144 } } } },
      "Peck & Khanna 1966, J. Opt. Soc. Am. 56, 1059" },
    { "oxygen", "O2", 31.9988e-3, 1.331184, 0.4 * um, 1.8 * um,
      { { 1.181494e-4 }, { { { 9.708931e-3, 75.4 } } } },
      "Zhang et al. 2008, Appl. Opt. 47, 3143; Kren 2011, Appl. Opt. 50, 6484 (20 C)" },
    { "argon", "Ar", 39.948e-3, 1.783956, 0.4679 * um, 2.0587 * um,
      { { 6.7867e-5 }, { { { 3.0182943e-2, 144 } } } },
      "Peck & Fisher 1964, J. Opt. Soc. Am. 54, 1362" },
    // 0.2 % above what the polarizability of the atom (1.38376 a_0^3, ab initio) gives.
    { "helium", "He", 4.002602e-3, 0.1784812, 0.4801 * um, 2.0586 * um,
      { {}, { { { 0.01470091, 423.98 } } } }, "Mansfield & Peck 1969, J. Opt. Soc. Am. 59, 199" },
    // The Sellmeier formula of Bideau-Mehu et al. 1981, as handed on, is 1.5 % below this value and
    // below what the polarizability of the atom gives.
    { "neon", "Ne", 20.1797e-3, 0.899847, sodium, sodium, { { 67e-6 }, {} },
      "Chronological Scientific Tables, Nat. Astron. Observatory of Japan, 2000 (589.3 nm)" },
    { "krypton", "Kr", 83.798e-3, 3.748969, 0.1404 * um, 0.6234 * um,
      { {}, { { { 0.00253637, 65.4742 }, { 0.00273649, 73.698 }, { 0.0620802, 181.08 } } } },
      "Bideau-Mehu et al. 1981, J. Quant. Spectrosc. Radiat. Transf. 25, 395" },
    // Fitted to 0.005 % of N; 0.7 % below what the polarizability of the atom (27.32 a_0^3) gives.
    { "xenon", "Xe", 131.293e-3, 5.898003, 0.3342 * um, 0.6236 * um,
      { { 6.83225e-4, 6.57486e-6, 1.16765e-7 }, {} },
      "Koch 1949, as tabulated by Leonard 1974, At. Data Nucl. Data Tables 14, 21" },
    { "hydrogen", "H2", 2.01588e-3, 0.0898824, 0.1680 * um, 1.6945 * um,
      { {}, { { { 0.0148956, 180.7 }, { 0.0049037, 92 } } } },
      "Peck & Huang 1977, J. Opt. Soc. Am. 67, 1550" },
    // 350 to 1200 nm: the measurements of Erickson 1962 (J. Opt. Soc. Am. 52, 777) behind eq. 3.
    { "water vapour", "H2O", 18.015e-3, 0.00985938, 0.35 * um, 1.2 * um, waterVapour,
      "Ciddor 1996, Appl. Opt. 35, 1566, eqs 3 and 4 (20 C, 1333 Pa)" },
    { "carbon dioxide", "CO2", 44.0095e-3, 1.976813, 0.1807 * um, 1.6945 * um,
      { {},
        { { { 6.99100e-2, 166.175 }, { 1.44720e-3, 79.609 }, { 6.42941e-5, 56.3064 },
          { 5.21306e-5, 46.0196 }, { 1.46847e-6, 0.0584738 } } } },
      "Bideau-Mehu et al. 1973, Opt. Commun. 9, 432" },
    { "carbon monoxide", "CO", 28.0101e-3, 1.250501, sodium, sodium, { { 338e-6 }, {} },
      "Kaye & Laby, Tables of Physical and Chemical Constants, 2.5.7 (589.3 nm; others: 334e-6)" },
    { "methane", "CH4", 16.0425e-3, 0.717459, 0.5290 * um, 0.6585 * um,
      { { 4.2607e-4, 6.1396687e-6 }, {} }, "Loria 1909, Ann. Phys. 334, 605" },
    { "acetylene", "C2H2", 26.0373e-3, idealDensity(26.0373e-3), 0.5461 * um, 0.6708 * um,
      ofPolarizability(22.96, 0.01453),
      "polarizability: Kumar & Meath 1992, Mol. Phys. 75, 311; dispersion: Loria 1909" },
    { "ethylene", "C2H4", 28.0532e-3, idealDensity(28.0532e-3), 0.5230 * um, 0.6677 * um,
      ofPolarizability(27.70, 0.01477),
      "polarizability: Kumar et al. 2007, Can. J. Chem. 85, 724; dispersion: Loria 1909" },
    { "ethane", "C2H6", 30.0690e-3, idealDensity(30.0690e-3), 0.5230 * um, 0.6677 * um,
      ofPolarizability(29.61, 0.0093),
      "polarizability: Jhanwar & Meath 1980, Mol. Phys. 41, 1061; dispersion: Loria 1909" },
    { "propane", "C3H8", 44.0956e-3, idealDensity(44.0956e-3), 0.5230 * um, 0.6677 * um,
      ofPolarizability(42.09, 0.0093),
      "polarizability: Jhanwar & Meath 1980, Mol. Phys. 41, 1061; dispersion of ethane" },
    // A liquid at room temperature: K = 3/2 (n^2 - 1)/(n^2 + 2)/rho (Lorentz-Lorenz) of the liquid
    // at 20 C, n = 1.3876 at 589.3 nm and rho = 683.8 kg/m^3, holds for its vapour to about 1 %.
    { "n-heptane", "C7H16", 100.2019e-3, 1, sodium, sodium, { { 5.172e-4 }, {} },
      "Lorentz-Lorenz law, from the liquid's index and density at 20 C (589.3 nm)" },
    // The authors give refractivities at the density of an ideal gas.
    { "ammonia", "NH3", 17.0305e-3, idealDensity(17.0305e-3), 0.4800 * um, 0.6708 * um,
      { {}, { { { 0.032953, 90.392 } } } },
      "C. & M. Cuthbertson 1914, Phil. Trans. R. Soc. A 213, 1" },
    { "nitric oxide", "NO", 30.0061e-3, 1.3402, sodium, sodium, { { 297e-6 }, {} },
      "CRC Handbook of Chemistry and Physics (589.3 nm)" },
    { "atomic nitrogen", "N", 14.0067e-3, idealDensity(14.0067e-3), sodium, sodium,
      ofPolarizability(7.626), "Alpher & White 1959, Phys. Fluids 2, 153 (shock tube, 5 %)" },
    { "atomic oxygen", "O", 15.9994e-3, idealDensity(15.9994e-3), sodium, sodium,
      ofPolarizability(5.196), "Alpher & White 1959, Phys. Fluids 2, 153 (shock tube, 8 %)" },
    { "sulfur hexafluoride", "SF6", 146.0554e-3, 6.256346, 0.633 * um, 1.3 * um,
      { { 7.1517e-4, 4.996e-6 }, {} },
      "Vukovic et al. 1996, J. Phys. D 29, 634, at two wavelengths, as the formula of Sneep & "
      "Ubachs 2005, J. Quant. Spectrosc. Radiat. Transf. 92, 293 (15 C)" },
  };
  return all;
}

double Gas::constantAt(double wavelengthMetres) const
{
  if (!isWavelength(wavelengthMetres))
  {
    return notANumber;
  }
  const double longest =
    disperses() ? std::max(longestWavelength, longestContinued) : longestWavelength;
  const double known = std::clamp(wavelengthMetres, shortestWavelength, longest);
  return evaluate(dispersion, squaredWaveNumber(known)) / density;
}

const Gas* findGas(std::string_view nameOrFormula)
{
  const std::vector<Gas>& all = gases();
  const auto found = std::find_if(all.begin(), all.end(),
    [&](const Gas& gas) { return gas.name == nameOrFormula || gas.formula == nameOrFormula; });
  return found == all.end() ? nullptr : &*found;
}

double Mixture::constantByMass(const double* fractions) const
{
  double constant = 0, rest = 1;
  for (std::size_t i = 0; i < species.size(); ++i)
  {
    constant += species[i].constant * fractions[i];
    rest -= fractions[i];
  }
  return constant + background.constant * rest;
}

double Mixture::constantByVolume(const double* fractions) const
{
  double refraction = 0, mass = 0, rest = 1; // per mole of the mixture
  for (std::size_t i = 0; i < species.size(); ++i)
  {
    const double fraction = species[i].molarMass * fractions[i];
    refraction += species[i].constant * fraction;
    mass += fraction;
    rest -= fractions[i];
  }
  const double fraction = background.molarMass * rest;
  mass += fraction;
  return mass > 0 ? (refraction + background.constant * fraction) / mass : notANumber;
}

namespace
{

constexpr double freezing = 273.15; // 0 C in K

constexpr double coldest = -40;   // C
constexpr double hottest = 100;   // C
constexpr double lowest = 80e3;   // Pa
constexpr double highest = 120e3; // Pa

/// Up to where the polynomials in pressure are followed, Pa: as in NIST's calculator.
constexpr double highestFollowed = 140e3;

double clampedCelsius(double kelvin) { return std::clamp(kelvin - freezing, coldest, hottest); }

} // namespace

bool isWithinCiddorRange(double temperatureKelvin, double pressurePascal)
{
  return coldest + freezing <= temperatureKelvin && temperatureKelvin <= hottest + freezing &&
    lowest <= pressurePascal && pressurePascal <= highest;
}

bool isWithinCiddorWavelengths(double wavelengthMetres)
{
  return 0.3 * micrometre <= wavelengthMetres && wavelengthMetres <= longestOfAir;
}

double saturationVapourPressure(double temperatureKelvin)
{
  const double T = temperatureKelvin;
  if (!(T > 0))
  {
    return notANumber;
  }
  return T < freezing
    ? std::pow(10, 12.537 - 2663.5 / T)
    : std::exp((1.2378847e-5 * T - 1.9121316e-2) * T + 33.93711047 - 6.3431645e3 / T);
}

double waterVapourFraction(double temperatureKelvin, double pressurePascal, double relativeHumidity)
{
  if (relativeHumidity <= 0)
  {
    return 0; // most fields are dry: spare them the exponential
  }
  const double t = clampedCelsius(temperatureKelvin);
  const double p = std::min(pressurePascal, highestFollowed);
  const double enhancement = 1.00062 + 3.14e-8 * p + 5.6e-7 * t * t;
  const double saturated =
    std::min(enhancement * saturationVapourPressure(temperatureKelvin) / pressurePascal, 1.);
  return std::min(relativeHumidity * saturated, 1.);
}

double compressibility(double temperatureKelvin, double pressurePascal, double waterFraction)
{
  const double x = waterFraction;
  const double t = clampedCelsius(temperatureKelvin);
  const double q =
    std::min(pressurePascal, highestFollowed) / std::max(temperatureKelvin, coldest + freezing);
  const double A = 1.58123e-6 + t * (-2.9331e-8 + t * 1.1043e-10) +
    x * (5.707e-6 - 2.051e-8 * t + x * (1.9898e-4 - 2.376e-6 * t));
  const double D = 1.83e-11 - 0.765e-8 * x * x;
  return 1 - q * (A - q * D);
}

MoistAir MoistAir::at(double wavelengthMetres, double co2PartsPerMillion)
{
  if (!isWavelength(wavelengthMetres) || !(co2PartsPerMillion >= 0))
  {
    return { notANumber, notANumber };
  }
  const double s = squaredWaveNumber(std::clamp(wavelengthMetres, shortestOfAir, longestOfAir));
  const double carbonDioxide = 1 + 0.534e-6 * (co2PartsPerMillion - 450); // eq. 2

  constexpr double dryT = 288.15, dryP = 101325, vapourT = 293.15, vapourP = 1333;
  return { evaluate(dryAir, s) * carbonDioxide * compressibility(dryT, dryP, 0) * dryT / dryP,
    evaluate(waterVapour, s) * compressibility(vapourT, vapourP, 1) * vapourT / vapourP };
}

double MoistAir::refractivity(
  double temperatureKelvin, double pressurePascal, double relativeHumidity) const
{
  if (!(temperatureKelvin > 0) || !(pressurePascal >= 0) || std::isnan(relativeHumidity))
  {
    return notANumber;
  }
  if (pressurePascal == 0)
  {
    return 0 * dry; // NaN where the air itself is
  }
  const double x = waterVapourFraction(temperatureKelvin, pressurePascal, relativeHumidity);
  const double Z = compressibility(temperatureKelvin, pressurePascal, x);
  const double n = pressurePascal / (Z * temperatureKelvin) * ((1 - x) * dry + x * vapour);
  return std::isfinite(n) ? n : notANumber;
}

double ciddorRefractivity(double temperatureKelvin, double pressurePascal, double relativeHumidity,
  double co2PartsPerMillion, double wavelengthMetres)
{
  return MoistAir::at(wavelengthMetres, co2PartsPerMillion)
    .refractivity(temperatureKelvin, pressurePascal, relativeHumidity);
}

namespace
{

constexpr double boiling = 373.15; // at 101325 Pa, K

/// Kell 1975, eq. 16: kg/m^3 at 101325 Pa of t in C.
double densityOfWater(double t)
{
  return (999.83952 +
           t *
             (16.945176 +
               t *
                 (-7.9870401e-3 + t * (-46.170461e-6 + t * (105.56302e-9 + t * -280.54253e-12))))) /
    (1 + 16.879850e-3 * t);
}

} // namespace

bool isLiquidWater(double temperatureKelvin)
{
  return temperatureKelvin >= freezing && temperatureKelvin <= boiling;
}

bool isWithinWaterWavelengths(double wavelengthMetres)
{
  return wavelengthMetres >= 0.2 * micrometre && wavelengthMetres <= 1.9 * micrometre;
}

double waterRefractivity(double temperatureKelvin, double wavelengthMetres)
{
  if (!(temperatureKelvin > 0) || !isWavelength(wavelengthMetres))
  {
    return notANumber;
  }
  const double kelvins = std::clamp(temperatureKelvin, freezing, boiling);
  const double density = densityOfWater(kelvins - freezing) / 1000;
  const double temperature = kelvins / 273.15;
  const double wavelength = wavelengthMetres / (0.589 * micrometre),
               square = wavelength * wavelength;
  constexpr double ultraviolet = 0.2292020, infrared = 5.432937;
  // (n^2 - 1) / (n^2 + 2)
  const double refraction = density *
    (0.244257733 + 9.74634476e-3 * density - 3.73234996e-3 * temperature +
      2.68678472e-4 * square * temperature + 1.58920570e-3 / square +
      2.45934259e-3 / (square - ultraviolet * ultraviolet) +
      0.900704920 / (square - infrared * infrared) - 1.66626219e-2 * density * density);
  return std::sqrt((2 * refraction + 1) / (1 - refraction)) - 1;
}

} // namespace schlieren
