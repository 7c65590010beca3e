// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string_view>

#include "bench/report/table.hpp"

namespace bch::report {

/// Returns the Pareto front of time and one error, in a crowd and on near misses: of the rows that miss no
/// collision, those that no other one equals or beats in both. By ascending error.
/// Returns: pairs, that error, "ns/pair", and what names the row.
Table front(const Table& points, std::string_view error);

}  // namespace bch::report
