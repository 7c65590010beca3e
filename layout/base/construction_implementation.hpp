// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <iterator>
#include <string_view>

namespace bch::detail {

/// The first row of a table that pays off in construction on this processor, most of whose work is in plain code. The first
/// processors with AVX-512 lower their clock for a millisecond where it is used: with it a pose takes 7 % longer
/// there. Later ones, which are told by a later extension, do not.
template <class Table>
const auto& best_for_construction(const Table& table) noexcept {
  return *std::find_if(std::begin(table), std::end(table), [](const auto& row) {
    const bool slows_the_rest =
        std::string_view(row.name) == "avx512" && __builtin_cpu_supports("avx512vbmi2") == 0;
    return row.supported() && !slows_the_rest;
  });
}

}  // namespace bch::detail
