// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MediumSettings.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <ostream>
#include <type_traits>

namespace
{

void write(std::ostream& out, double value) { out << " " << value; }

void write(std::ostream& out, const std::string& text) { out << " '" << text << "'"; }

void write(std::ostream& out, const ArraySelection& selection)
{
  write(out, selection.name);
  out << " of " << (selection.cellsFirst ? "cells" : "points");
}

void write(std::ostream& out, const TransferCurve& curve)
{
  out << " [";
  for (const std::array<double, 4>& node : curve.nodes)
  {
    out << " (" << node[0] << " " << node[1] << " " << node[2] << " " << node[3] << ")";
  }
  out << " ]";
}

} // namespace

bool MediumSettings::operator==(const MediumSettings& other) const
{
  bool areEqual = true;
  visit(
    [&](const char*, auto member)
    {
      const auto& a = this->*member;
      const auto& b = other.*member;
      if constexpr (std::is_array_v<std::remove_reference_t<decltype(a)>>)
      {
        areEqual = areEqual && std::equal(std::begin(a), std::end(a), std::begin(b));
      }
      else
      {
        areEqual = areEqual && a == b;
      }
    });
  return areEqual;
}

void print(std::ostream& out, int indent, const MediumSettings& settings)
{
  MediumSettings::visit(
    [&](const char* name, auto member)
    {
      const auto& value = settings.*member;
      using Value = std::decay_t<decltype(value)>;
      out << std::string(static_cast<std::size_t>(indent), ' ') << name << ":";
      if constexpr (std::is_arithmetic_v<Value> || std::is_same_v<Value, std::string>)
      {
        write(out, value);
      }
      else
      {
        for (const auto& item : value)
        {
          write(out, item);
        }
      }
      out << "\n";
    });
}
