// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Gas states to refractivity N = n - 1. Scalars in SI units, host only. A state that cannot be (a
// temperature at or below zero, a negative pressure, NaN) has the refractivity NaN, which the
// medium takes for a solid.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

namespace schlieren
{

// Gladstone-Dale

/// Gladstone & Dale 1863: N = K rho, with K in m^3/kg and rho in kg/m^3. The Lorentz-Lorenz law
/// (n^2 - 1)/(n^2 + 2) = 2/3 K rho differs from it by the factor 1 + N/6, less than 1e-3 of N below
/// 20 times the density of the atmosphere.
inline double gladstoneDaleRefractivity(double constant, double density)
{
  return constant * density;
}

/// Refractivity of a gas as a function of s = (1 um / vacuum wavelength)^2, at one density:
/// N = powers[0] + powers[1] s + powers[2] s^2 + powers[3] s^3 + sum strength / (resonance - s).
struct Dispersion
{
  struct Resonance
  {
    double strength; ///< um^-2
    double position; ///< um^-2
  };

  std::array<double, 4> powers;
  std::array<Resonance, 5> resonances; ///< unused ones have no strength
};

/// A gas and its Gladstone-Dale constant K(wavelength) = N(wavelength) / density.
struct Gas
{
  std::string_view name;
  std::string_view formula;
  double molarMass;          ///< kg/mol
  double density;            ///< kg/m^3, of the state that the dispersion formula is for
  double shortestWavelength; ///< metres, in vacuum: of what was measured
  double longestWavelength;  ///< metres; equal to the shortest where one wavelength is all we have
  Dispersion dispersion;     ///< refractivity at `density`
  std::string_view source;

  /// Whether K is known to depend on wavelength; else it is that of the one wavelength measured.
  constexpr bool disperses() const { return shortestWavelength < longestWavelength; }

  /// K in m^3/kg. Formulas with resonances in the ultraviolet only go flat towards the infrared and
  /// are continued up to 1.7 um where measurements end earlier. Otherwise K keeps the value of the
  /// nearest wavelength that was measured. NaN for a wavelength that is not positive.
  double constantAt(double wavelengthMetres) const;
};

/// All gases whose constants we can give a source for.
const std::vector<Gas>& gases();

/// The gas of this name or chemical formula, spelled as in gases(); null where there is none.
const Gas* findGas(std::string_view nameOrFormula);

// Mixtures

/// A gas in a mixture.
struct Component
{
  double constant; ///< Gladstone-Dale K, m^3/kg
  double molarMass =
    std::numeric_limits<double>::quiet_NaN(); ///< kg/mol; for volume fractions only
};

/// A mixture of species whose fractions are given and of a background gas that fills the rest.
/// Fractions are not clipped: numerical overshoot of a species is taken from the background, which
/// keeps N linear in the fields. One fraction is passed for each species.
///
/// Every gas refracts as if alone, so N = sum K_i rho_i over the partial densities rho_i = rho Y_i
/// (Merzkirch 1987, Flow Visualization, ch. 3) and the mixture has N = K rho with K = sum K_i Y_i.
/// Volume (that is, mole) fractions X_i have to be converted: Y_i = X_i M_i / sum X_j M_j.
/// Weighting K by X_i itself, as eq. 5 of Brownlee et al. does, is right for equal molar masses
/// only: half helium, half air by volume has K = 2.22e-4, not 2.11e-4 m^3/kg.
struct Mixture
{
  std::vector<Component> species;
  Component background;

  /// K = sum K_i Y_i + K_background (1 - sum Y_i).
  double constantByMass(const double* fractions) const;

  /// K = sum K_i M_i X_i / sum M_i X_i, the background's X being 1 - sum X_i. NaN where a molar
  /// mass is missing or the mixture's is not positive.
  double constantByVolume(const double* fractions) const;
};

// Moist air
//
// P. E. Ciddor, Refractive index of air: new equations for the visible and near infrared, Appl.
// Opt. 35, 1566-1573 (1996). Used there for -40 to 100 C and 80 to 120 kPa, with the
// compressibility and the saturation vapour pressure of Davis 1992 (Metrologia 29, 67: the BIPM
// equation of 1981/91).

/// Whether temperature and pressure lie where Ciddor states his equations to hold.
bool isWithinCiddorRange(double temperatureKelvin, double pressurePascal);

/// Whether the wavelength in vacuum lies where the equations are used: from 0.3 um (Ciddor) to
/// 1.7 um (Stone & Zimmerman, NIST Engineering Metrology Toolbox).
bool isWithinCiddorWavelengths(double wavelengthMetres);

/// Vapour pressure of saturation in Pa, as Ciddor has it: over water (Davis 1992) from 0 C up, over
/// ice (Marti & Mauersberger 1993, Geophys. Res. Lett. 20, 363) below. The two differ by 0.06 % at
/// 0 C, which moves N of saturated air by less than 1e-6 of itself.
double saturationVapourPressure(double temperatureKelvin);

/// Mole fraction of water in air. Ciddor: x = f h p_sv / p with the enhancement factor f. No vapour
/// has more than the total pressure, so at and above the boiling point, where f p_sv > p, humidity
/// counts against p: x = h.
double waterVapourFraction(
  double temperatureKelvin, double pressurePascal, double relativeHumidity);

/// Compressibility Z of moist air with the mole fraction x of water (Davis 1992; Ciddor eq. 12):
///
///   Z = 1 - q A(t, x) + q^2 D(x),  q = p / T,
///
/// in which A is quadratic in t, T in C. This is a virial series: for q -> 0 it goes to the ideal
/// gas Z = 1 by itself, so low pressure needs no continuation (NIST's calculator uses it down to
/// 10 kPa). What fails outside is A, which bends back above 100 C, and the series at large q.
/// Hence the continuation: A is frozen at the nearest t of -40 to 100 C, and q = p* / T* at
/// p* = min(p, 140 kPa), where NIST's calculator ends, and T* = max(T, -40 C). Z is continuous
/// everywhere because all three limits are; it goes to 1 in vacuum and in flames, and keeps the
/// value of 140 kPa in compressed air: an ideal gas up to a factor within 2e-3 of 1 when dry.
/// Real dry air at 10 MPa has Z = 0.993 at 300 K and 1.03 at 1000 K: N is off by as much there.
/// Davis made A for little vapour: pure steam at 100 C and 1 atm gets 1.009 but has Z = 0.985.
double compressibility(double temperatureKelvin, double pressurePascal, double waterFraction);

/// Air at one wavelength and one content of carbon dioxide: the same for all cells of a field.
///
/// Ciddor's eq. 5, N = (rho_a / rho_axs) N_axs + (rho_w / rho_ws) N_ws, holds densities of the dry
/// part and of the vapour (eq. 4: rho = p M x / Z R T), and those of the two states for which N_axs
/// and N_ws are given. Molar masses and R cancel:
///
///   N = p / (Z T) ((1 - x) dry + x vapour).
struct MoistAir
{
  double dry;    ///< N_axs Z T / p of dry air at 15 C and 101325 Pa, K/Pa
  double vapour; ///< N_ws Z T / p of water vapour at 20 C and 1333 Pa, K/Pa

  /// Outside 0.23 um to 1.7 um, the dispersion is that of the nearest of these. Not a number where
  /// the wavelength is not positive or the carbon dioxide is negative.
  static MoistAir at(double wavelengthMetres, double co2PartsPerMillion = 450);

  /// `relativeHumidity` is 0 to 1; below 0 it counts as 0.
  double refractivity(
    double temperatureKelvin, double pressurePascal, double relativeHumidity) const;
};

// Water
//
// A. H. Harvey, J. S. Gallagher, J. M. H. Levelt Sengers, Revised formulation for the refractive index of water and steam,
// J. Phys. Chem. Ref. Data 27, 761-774 (1998): IAPWS R9-97, for light of 0.2 to 1.1 um, extrapolated to 1.9 um; with the
// density at 101325 Pa of G. S. Kell, J. Chem. Eng. Data 20, 97-105 (1975), eq. 16.

/// Whether water is liquid at 101325 Pa: 0 to 100 C.
bool isLiquidWater(double temperatureKelvin);

/// Whether the wavelength in vacuum lies where the formulation may be used.
bool isWithinWaterWavelengths(double wavelengthMetres);

/// Refractivity of water at 101325 Pa; below 0 and above 100 C that of 0 and 100 C and at least absolute zero.
double waterRefractivity(double temperatureKelvin, double wavelengthMetres);

/// Refractivity of moist air, for a single state. For a field, make one MoistAir.
double ciddorRefractivity(double temperatureKelvin, double pressurePascal, double relativeHumidity,
  double co2PartsPerMillion, double wavelengthMetres);

} // namespace schlieren
