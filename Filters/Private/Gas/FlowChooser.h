// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Which arrays of a flow give its refractive index, by their names, units and ranges: see FlowDefaults.h.
#pragma once

#include "FlowDefaults.h"
#include "Gas/ArrayNames.h"

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace filters
{

/// What arrays of a refractive index, and of a relative humidity, are called.
extern const std::set<std::string> indexNames, humidityNames;

std::string quoted(const std::string& name);
std::string rangeInWords(const FlowArray& array);
bool isScalar(const FlowArray& array);

constexpr FlowArray::Association associations[] = { FlowArray::Points, FlowArray::Cells };

/// Chooses among the arrays of one component.
class FlowChooser
{
public:
  explicit FlowChooser(const std::vector<FlowArray>& all);

  bool isEmpty() const { return this->Arrays.empty(); }

  /// Chooses what gives the index; of a model, its arrays. Returns whether there are some.
  bool choose();
  bool choose(MediumSettings::IndexModels model);
  /// Chooses the fractions alone; partial densities `withDensity` only.
  void chooseSpecies(FlowArray::Association association, bool withDensity);

  FlowDefaults Result;
  std::string Note; ///< names that were not understood

  bool has(Quantity quantity) const;

private:
  /// An array whose name is understood, with its factor to SI units, 0: unknown unit; and its unit's zero.
  struct Found
  {
    const FlowArray* array = nullptr;
    double scale = 1;
    double zero = 0;
  };

  /// Finds the array that best matches a quantity, points before cells.
  Found find(Quantity quantity, FlowArray::Association association);

  /// Returns whether the unit belongs to another quantity.
  static bool isOfAnother(const ArrayName& name, Quantity quantity);
  const FlowArray* find(const std::set<std::string>& names) const;

  bool refractivity();
  bool refractiveIndex();
  bool density(bool ofSpecies);
  void species(bool withDensity);
  /// Chooses an electron density, beside a density that has been chosen or alone.
  bool electrons();
  /// Returns whether a temperature is in a known unit; else notes it.
  bool areKelvins(const Found& temperature);
  /// Chooses a temperature, of water.
  bool temperature();
  /// Chooses a temperature and a pressure, of moist air or, `ofSpecies`, of a mixture.
  bool state(bool ofSpecies);
  bool state(FlowArray::Association association, bool ofSpecies);
  /// Chooses a relative humidity between 0 and 1, not one in percent.
  void humidity(FlowArray::Association association);

  void take(MediumSettings::IndexModels model, FlowArray::Association association,
    std::vector<std::pair<std::string, std::string>> arrays);

  std::vector<FlowArray> Arrays;
};

} // namespace filters
