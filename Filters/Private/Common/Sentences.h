// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace filters
{

/// Ends messages about images, which that page explains.
constexpr const char* seeTroubleshooting = " See Troubleshooting in the documentation.";

/// Appends a sentence, which may be empty.
inline void addText(std::string& text, const std::string& more)
{
  text += (text.empty() || more.empty() ? "" : " ") + more;
}

} // namespace filters
