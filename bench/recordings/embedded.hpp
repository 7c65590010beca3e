// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string_view>

// Files of bench/recordings that the program carries with it.

namespace bch::cli {

/// Returns page.html, whose tags {{title}}, {{policy}}, {{style}}, {{data}} and {{script}} are to be filled in.
std::string_view check_page_template();
/// Returns page.css.
std::string_view check_page_style();
/// Returns the scripts, one after the other, in a function of their own.
std::string_view check_page_script();

/// Hashes (SHA-256) of style and script in hexadecimal digits, by which browsers know them from what others may have slipped in.
std::string_view check_page_style_hash();
std::string_view check_page_script_hash();

}  // namespace bch::cli
