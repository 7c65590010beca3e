// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string>
#include <string_view>

namespace bch::cli {

/// Makes text of any origin safe to show on a terminal or a page: what would control either is written out.
/// That is control characters (C0, DEL, C1) as "\x1b" or "\u0085"; marks that turn the direction of writing,
/// that break lines or that are not characters as "\u202e"; and bytes that are not UTF-8 as "\xff". Line
/// feeds stay.
std::string printable(std::string_view text);

/// Makes a name or a message printable as one line: as printable() does, and line feeds are written out as
/// "\x0a".
std::string printable_line(std::string_view text);

}  // namespace bch::cli
