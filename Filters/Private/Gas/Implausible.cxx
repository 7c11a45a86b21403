// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "FlowDefaults.h"

#include "Gas/ArrayNames.h"
#include "Gas/RefractivityModels.h"
#include "NumberText.h"

using filters::ArrayName;

namespace
{

using filters::textOf;

// Limits of n - 1: air at 0 C and 15 atm, exceeded by few engines only; the thinnest liquids; air
// at less than 1 % of the atmosphere's pressure.
constexpr double densestSurroundings = 4e-3;
constexpr double densestGas = 0.05;
constexpr double thinnestGas = 2e-6;
// Tolerance for undershoots of solvers.
constexpr double undershoot = 1e-3;

/// Formats a name and a range: "'rho' (1 to 2)".
std::string described(const FlowArray& array)
{
  return "'" + array.name + "' (" + textOf(array.range[0], 3) + " to " + textOf(array.range[1], 3) +
    ")";
}

/// Checks what holds for any state of a gas.
Implausible ofAny(const FlowArray& array, const std::string& quantity)
{
  if (array.range[0] == 0 && array.range[1] == 0)
  {
    return { "zero",
      "The " + quantity + " '" + array.name +
        "' is 0 everywhere, so there is nothing that bends light. Choose another array, or another "
        "time step." };
  }
  return {};
}

/// Says that values which are the same everywhere are rounded.
std::string exactly(const FlowArray& array)
{
  return array.range[0] == array.range[1] ? ""
                                          : " up to rounding, which is all that the image shows";
}

Implausible ofDensity(const FlowInUse& flow)
{
  constexpr const char* document = " (Documentation/density.md)";
  const FlowArray& array = flow.arrays[0];
  if (Implausible any = ofAny(array, "density"); !any.text.empty())
  {
    return any;
  }
  if (isNoDensity(array))
  {
    return { "no density",
      described(array) +
        " was chosen as the density, but its name or its values are those of something else. If "
        "it is no density, choose another array for Density, or another IndexModel" +
        std::string(document) + "." };
  }
  const ArrayName name(array.name);
  if (!flow.isScaleGiven && name.HasUnit(filters::Quantity::Density) &&
    name.Scale(filters::Quantity::Density) == 0)
  {
    return { "unit",
      "The unit in the name of the density '" + array.name +
        "' is not known and kg/m\xc2\xb3 is assumed. Set DensityScale to the factor that makes "
        "kg/m\xc2\xb3 "
        "of it." };
  }
  const double low = array.range[0] * flow.scales[0], high = array.range[1] * flow.scales[0];
  if (flow.isConstant || (low == high && flow.indexModel == MediumSettings::GLADSTONE_DALE))
  {
    return { "constant",
      "The density '" + array.name + "' is " + textOf(array.range[0], 3) + " everywhere" +
        exactly(array) +
        ", as in incompressible flow, so that nothing bends light. Where temperatures "
        "differ, compute a density from temperature and pressure" +
        std::string(document) + "." };
  }
  if (low < -undershoot * high)
  {
    return { "negative",
      "The density " + described(array) +
        " is negative in places, which no gas is. Choose an array that is an absolute density, or "
        "add what it counts from with Calculator." };
  }
  const double lowest = flow.constant * low, highest = flow.constant * high;
  if (flow.isGas && (highest > densestGas || (lowest > densestSurroundings && !flow.isScaleGiven)))
  {
    return { "dense",
      "With the density " + described(array) + ", n - 1 is " + textOf(lowest, 3) + " to " +
        textOf(highest, 3) +
        ", more than that of gases (air in a room: 2.7e-4). If it is no density in kg/m\xc2\xb3, "
        "set DensityScale or choose another array; of a liquid, give the index itself" +
        std::string(document) + "." };
  }
  if (flow.isGas && !flow.isScaleGiven && highest < thinnestGas)
  {
    return { "thin",
      "With the density " + described(array) + ", n - 1 is at most " + textOf(highest, 3) +
        ", a hundredth of that of air in a room, or less. If the density is in g/cm\xc2\xb3, set "
        "DensityScale to 1000; if it is relative to the free stream, to the free stream's." };
  }
  return {};
}

Implausible ofTemperature(const FlowInUse& flow)
{
  const FlowArray& temperature = flow.arrays[0];
  const double kelvins[2] = { temperature.range[0] * flow.scales[0] + flow.zero,
    temperature.range[1] * flow.scales[0] + flow.zero };
  // Bodies often have 0; the coldest streams of wind tunnels have about 45 K.
  const bool isBelowAll = kelvins[0] < 0 || (kelvins[0] > 0 && kelvins[0] < 40);
  if (isBelowAll || kelvins[1] < 150)
  {
    return { "Celsius",
      "The temperature " + described(temperature) +
        " seems not to be in kelvins. If it is in degrees Celsius, compute kelvins (+ 273.15) with "
        "Calculator and choose these for Temperature, or give it a name with its unit, such as "
        "'T [degC]'." };
  }
  return {};
}

Implausible ofWater(const FlowInUse& flow)
{
  const FlowArray& temperature = flow.arrays[0];
  Implausible found = ofAny(temperature, "temperature");
  if (found.text.empty() && flow.isConstant)
  {
    return { "constant",
      "The temperature '" + temperature.name + "' is the same everywhere" + exactly(temperature) +
        ", so that nothing bends light. Choose another array, or another time step." };
  }
  return found.text.empty() ? ofTemperature(flow) : found;
}

Implausible ofElectrons(const FlowInUse& flow)
{
  constexpr double fewest = 1e12; // m^-3: glow discharges have more
  const FlowArray& electrons = flow.arrays[0];
  Implausible found = ofAny(electrons, "electron density");
  if (found.text.empty() && electrons.range[1] < fewest &&
    !ArrayName(electrons.name).HasUnit(filters::Quantity::Electrons))
  {
    found = { "thin",
      "The electron density " + described(electrons) +
        " is too low to bend light if it is in m^-3. If it is in cm^-3, give it a name with its "
        "unit, such as 'ne [cm^-3]'; if it is relative, make one in m^-3 with Calculator." };
  }
  return found;
}

Implausible ofMoistAir(const FlowInUse& flow)
{
  const FlowArray& temperature = flow.arrays[0];
  const FlowArray& pressure = flow.arrays[1];
  for (const bool isPressure : { false, true })
  {
    Implausible any =
      ofAny(isPressure ? pressure : temperature, isPressure ? "pressure" : "temperature");
    if (!any.text.empty())
    {
      return any;
    }
  }
  if (flow.isConstant)
  {
    return { "constant",
      "The temperature '" + temperature.name + "' and the pressure '" + pressure.name +
        "' are the same everywhere" +
        (exactly(temperature).empty() ? exactly(pressure) : exactly(temperature)) +
        ", so that nothing bends light. Choose other arrays, or another time step." };
  }
  const double pascals[2] = { pressure.range[0] * flow.scales[1],
    pressure.range[1] * flow.scales[1] };
  if (Implausible found = ofTemperature(flow); !found.text.empty())
  {
    return found;
  }
  if (pascals[0] <= 0 || ArrayName(pressure.name).IsGauge())
  {
    return { "gauge",
      "The pressure " + described(pressure) +
        " seems to count from that of the surroundings. Compute the absolute one (+ 101325) with "
        "Calculator and choose it for Pressure." };
  }
  constexpr double leastOfAir = 1200, mostOfAir = 1e8; // pascals
  if (pascals[1] < leastOfAir || pascals[0] > mostOfAir)
  {
    const double factor = pascals[1] > 300 ? 100 : pascals[1] > 30 ? 1e3 : 1e5;
    return { "pressure",
      "With PressureScale " + textOf(flow.scales[1], 3) + " the pressure " + described(pressure) +
        " is in Pa, so that n - 1 is far from that of air in a room." +
        (pascals[1] < leastOfAir && !flow.isScaleGiven ? " If it is in " +
              std::string(factor == 100 ? "hPa"
                  : factor == 1e3       ? "kPa"
                                        : "bar") +
              ", set PressureScale to " + textOf(factor, 3) + "."
                                                       : " Check PressureScale.") };
  }
  return {};
}

} // namespace

Implausible implausible(const FlowInUse& flow)
{
  for (const FlowArray& array : flow.arrays)
  {
    constexpr double most = 1e100; // no state of matter exceeds it
    if (!(array.range[0] <= array.range[1]) || array.range[0] < -most || array.range[1] > most)
    {
      return {}; // another message covers that
    }
  }
  switch (filters::kindOf(flow.indexModel).arrays)
  {
    case filters::IndexArrays::Density:
      if (flow.arrays.size() == 1)
      {
        return ofDensity(flow);
      }
      [[fallthrough]]; // a mixture whose density follows from temperature and pressure
    case filters::IndexArrays::Air:
      return flow.arrays.size() == 2 ? ofMoistAir(flow) : Implausible();
    case filters::IndexArrays::Electrons:
      if (Implausible found = ofElectrons(flow); !found.text.empty())
      {
        return found;
      }
      [[fallthrough]];
    case filters::IndexArrays::Index:
      if (flow.isConstant && !flow.arrays.empty() && !exactly(flow.arrays[0]).empty())
      {
        return { "constant",
          "'" + flow.arrays[0].name + "' is " + textOf(flow.arrays[0].range[0]) + " everywhere" +
            exactly(flow.arrays[0]) + ". Choose another array, or another time step." };
      }
      break;
    case filters::IndexArrays::Temperature:
      return ofWater(flow);
    case filters::IndexArrays::Fields:
      break; // any number may be one of these
  }
  return {};
}
