// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Gas/TransferFunctions.h"
#include "MediumSettings.h"

#include "Schlieren.h"

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

/// Models of the refractivity at a point or cell as a function of its arrays, and the table of them.
namespace filters
{

/// What of a gas an index model reads.
enum class IndexArrays
{
  Density,
  Index, ///< n or N itself
  Air,   ///< temperature, pressure and humidity
  Temperature,
  Electrons, ///< their density and, if chosen, that of a gas beside them
  Fields
};

/// Which gases of the table an index model may use, whose constants depend on wavelength.
enum class IndexGases
{
  None,
  One,      ///< that of Gas
  Mixture,  ///< those of MixtureGases and BackgroundGas, with fractions in MixtureArrays
  MoistAir, ///< by Ciddor's equations
  Water     ///< none, but a liquid
};

/// N = a x + b of one array; separate from the others because it can be fast.
struct Linear
{
  double scale = 1;
  double offset = 0;
};

/// N of several arrays.
class StateModel
{
public:
  virtual ~StateModel() = default;

  /// Returns N; NaN for states that no gas can have.
  virtual double refractivity(const double* values) const = 0;
  /// Returns whether the state deserves a warning.
  virtual bool isDoubtful(const double* values) const = 0;
  /// Returns the warning; the fraction is a text such as "12 %".
  virtual std::string warning(const std::string& fraction) const = 0;
  /// Returns whether the model's formulas are continued to the state from where they are known, and a sentence that says so.
  virtual bool isContinued(const double* /*values*/) const { return false; }
  virtual std::string noteOnContinued(const std::string& /*fraction*/) const { return ""; }
};

/// Any of them.
struct OfState
{
  std::shared_ptr<const StateModel> model;

  double refractivity(const double* values) const { return this->model->refractivity(values); }
  bool isDoubtful(const double* values) const { return this->model->isDoubtful(values); }
  std::string warning(const std::string& fraction) const { return this->model->warning(fraction); }
  bool isContinued(const double* values) const { return this->model->isContinued(values); }
};

/// Any model.
using Model = std::variant<Linear, OfState, FieldMean>;

/// What a value of IndexModel has.
struct IndexModelKind
{
  MediumSettings::IndexModels value;
  IndexArrays arrays;
  IndexGases gases;
  Model (*make)(const MediumSettings& settings); ///< throws std::runtime_error
};

/// Looks up a value of IndexModel.
const IndexModelKind& kindOf(int indexModel);

/// Makes the curves of Fields, straight lines unless the model is Curves. Throws std::runtime_error
/// for inconsistent settings.
FieldMean fieldMeanFrom(const MediumSettings& settings);

/// Makes the model of complete settings. Throws std::runtime_error for inconsistent ones.
inline Model modelFrom(const MediumSettings& settings)
{
  return kindOf(settings.IndexModel).make(settings);
}

/// An array to look for.
struct Selection : ArraySelection
{
  Selection(std::string ofProperty, ArraySelection chosen)
    : ArraySelection(std::move(chosen))
    , property(std::move(ofProperty))
  {
  }

  std::string property; ///< that chose it
};

Selection selectionOf(const MediumSettings& settings, std::size_t index);

/// Lists the arrays that the model reads, at least one, in its order.
std::vector<Selection> selectionsFrom(const MediumSettings& settings);

/// Counts doubtful points or cells, and those whose state is beyond the model's formulas, among those that have values.
struct Tally
{
  long long all = 0;
  long long doubtful = 0;
  long long continued = 0;

  Tally& operator+=(const Tally& other);
};

/// Returns a warning about doubtful values; empty without any.
std::string warningFrom(const Model& model, const Tally& tally);

/// Returns a sentence about the values for which the model's formulas are continued; empty without any.
std::string noteOnContinued(const Model& model, const Tally& tally);

} // namespace filters
