// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

// In place of the standard library's functions, which a program shares with us: without optimisation, its copies of std::isfinite() ...
// take the place of ours, and compiled with -ffast-math they call NaN finite.
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
