// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace filters
{

/// Appends a sentence, which may be empty.
inline void addText(std::string& text, const std::string& more)
{
  text += (text.empty() || more.empty() ? "" : " ") + more;
}

} // namespace filters
