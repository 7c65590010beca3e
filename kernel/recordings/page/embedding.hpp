// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "layout/base/number_class.hpp"

// How data lie in a page so that scripts can read them and nothing in them can become markup.

namespace bch::detail {

/// Writes JSON that may stand in a script element: without "<", ">" and "&", which are written as \u003c and so on.
/// Bytes of texts that are not UTF-8 are replaced.
std::string script_json(const nlohmann::ordered_json& json);

/// Returns the element data-NAME, whose text is JSON.
std::string json_block(std::string_view name, const nlohmann::ordered_json& json);

/// Returns the element data-NAME, whose text is the numbers in base64, least significant byte first; its attribute
/// data-type names the type as "u16", "i32" or "f64".
std::string number_block(std::string_view name, std::string_view type, std::span<const std::byte> bytes);

/// Names the type of a number as number_block() does.
template <class Number>
constexpr const char* number_type() {
  constexpr bool is_signed = std::is_signed_v<Number>;
  if constexpr (std::floating_point<Number>)
    return sizeof(Number) == 8 ? "f64" : "f32";
  else
    return sizeof(Number) == 1   ? (is_signed ? "i8" : "u8")
           : sizeof(Number) == 2 ? (is_signed ? "i16" : "u16")
                                 : (is_signed ? "i32" : "u32");
}

template <class Number>
std::string number_block(std::string_view name, const std::vector<Number>& numbers) {
  return number_block(name, number_type<Number>(), std::as_bytes(std::span(numbers)));
}

/// Writes numbers as 16 bits if `narrow`, else as 32 bits.
inline std::string index_block(std::string_view name, const std::vector<std::uint32_t>& numbers,
                               bool narrow) {
  if (!narrow) return number_block(name, numbers);
  std::vector<std::uint16_t> shorter(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) shorter[i] = static_cast<std::uint16_t>(numbers[i]);
  return number_block(name, shorter);
}

/// Returns the nearest value of an integer type of at most 32 bits: its least or largest beyond its range, 0 for what
/// is not a number.
template <class Integer>
Integer rounded(double value) {
  using Limits = std::numeric_limits<Integer>;
  static_assert(sizeof(Integer) <= 4);
  if (is_nan(value)) return 0;
  const double whole = std::round(value);
  if (whole <= static_cast<double>(Limits::min())) return Limits::min();
  if (whole >= static_cast<double>(Limits::max())) return Limits::max();
  return static_cast<Integer>(whole);
}

// Files of this folder that the program carries with it.

/// Returns page.html, whose tags {{title}}, {{policy}}, {{style}}, {{data}} and {{script}} are to be filled in.
std::string_view check_page_template();
/// Returns page.css.
std::string_view check_page_style();
/// Returns the scripts, one after the other, in a function of their own.
std::string_view check_page_script();

/// Hashes (SHA-256) of style and script in hexadecimal digits, by which browsers know them from what others may have slipped in.
std::string_view check_page_style_hash();
std::string_view check_page_script_hash();

}  // namespace bch::detail
