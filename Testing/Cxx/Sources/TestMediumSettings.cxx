// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The settings of a medium as values: compared, printed, and as vtkFlowAlgorithm hands them on.
#include "Fixtures.h"
#include "MediumSettings.h"

#include "vtkPiecewiseFunction.h"

#include <sstream>
#include <type_traits>

namespace
{

/// Another value of whatever type a property has.
template <class Value>
void change(Value& value)
{
  if constexpr (std::is_same_v<Value, bool>)
  {
    value = !value;
  }
  else if constexpr (std::is_arithmetic_v<Value>)
  {
    value += 1;
  }
  else if constexpr (std::is_array_v<Value>)
  {
    change(value[std::extent_v<Value> - 1]);
  }
  else if constexpr (std::is_same_v<Value, std::string>)
  {
    value += "x";
  }
  else if constexpr (std::is_same_v<Value, std::array<ArraySelection, 6>>)
  {
    value.back().name = "solid";
  }
  else
  {
    value.emplace_back();
  }
}

std::string printed(const MediumSettings& settings)
{
  std::ostringstream text;
  print(text, 2, settings);
  return text.str();
}

} // namespace

TEST(MediumSettings, DifferWhereOnePropertyDoes)
{
  const MediumSettings defaults;
  EXPECT_TRUE(defaults == MediumSettings());
  MediumSettings::visit(
    [&](const char* name, auto member)
    {
      MediumSettings changed;
      change(changed.*member);
      EXPECT_TRUE(changed != defaults) << name;
      EXPECT_NE(printed(changed), printed(defaults)) << name;
      EXPECT_NE(printed(defaults).find("  " + std::string(name) + ":"), std::string::npos) << name;
    });
}

TEST(MediumSettings, AreThoseOfTheFilter)
{
  vtkNew<vtkRefractiveIndex> filter;
  MediumSettings expected;
  EXPECT_TRUE(filter->GetMediumSettings() == expected);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::MASK, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "iblank");
  filter->SetIndexModel(vtkRefractiveIndex::TRANSFER_FUNCTIONS);
  filter->AddField("p");
  vtkNew<vtkPiecewiseFunction> curve;
  curve->AddPoint(0, 2);
  curve->AddPoint(0.5, 3, 0.25, 1);
  filter->AddTransferFunction(curve);
  expected.Arrays[MediumSettings::MaskArray] = { "iblank", -1, true };
  expected.IndexModel = MediumSettings::TRANSFER_FUNCTIONS;
  expected.Fields = { "p" };
  expected.TransferFunctions = { { { { 0, 2, 0.5, 0 }, { 0.5, 3, 0.25, 1 } }, true, false } };
  EXPECT_TRUE(filter->GetMediumSettings() == expected) << printed(filter->GetMediumSettings());
  curve->AddPoint(1, 4); // the function's own change counts
  EXPECT_TRUE(filter->GetMediumSettings() != expected);
}
