// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What errors say.
#pragma once

#include "Schlieren.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace schlieren
{

/// Of the error that something ends in; nothing where it ends in none.
inline std::string messageOf(const std::function<void()>& work)
{
  try
  {
    work();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "";
}

inline std::string messageOf(const Field& field, const Scene& scene)
{
  return messageOf([&] { Bench().render(field, scene); });
}

/// There is an error that says `part`.
inline void expectError(const std::string& message, const std::string& part)
{
  EXPECT_NE(message.find(part), std::string::npos) << "\"" << message << "\" without " << part;
}

} // namespace schlieren
