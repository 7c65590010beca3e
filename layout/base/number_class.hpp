// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

// These replace functions of the standard library, whose copies a program shares with the library: without
// optimisation, the program's std::isfinite() could take the place of ours, and compiled with -ffast-math it calls
// NaN finite.
namespace bch::detail {

template <class Number>
constexpr bool is_finite(Number x) noexcept {
  return __builtin_isfinite(x);
}
template <class Number>
constexpr bool is_infinite(Number x) noexcept {
  return __builtin_isinf(x);
}
template <class Number>
constexpr bool is_nan(Number x) noexcept {
  return __builtin_isnan(x);
}

}  // namespace bch::detail
