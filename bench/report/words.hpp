// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string>
#include <string_view>

#include "bench/base/text.hpp"

namespace bch::report {

/// Writes a number with three significant digits, from 1 000 on all before the point: "0.0123", "4.57", "12
/// 346", "1.2e-07"; "–" for NaN.
std::string brief(double number);

using cli::escaped;

/// Writes a CSV cell as the page's tables show it: numbers by brief(), texts escaped.
std::string shown(std::string_view cell);

}  // namespace bch::report
