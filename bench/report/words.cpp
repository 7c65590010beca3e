// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/words.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "bench/base/number.hpp"
#include "bench/base/text.hpp"

namespace bch::report {

std::string brief(double number) {
  if (std::isnan(number)) return "–";
  const double size = std::abs(number);
  if (size >= 1e9 || (size < 1e-4 && size > 0)) return fmt::format("{:.3g}", number);
  if (size >= 1000)
    return fmt::format("{}{}", number < 0 ? "-" : "",
                       cli::grouped(static_cast<std::uint64_t>(std::llround(size))));
  if (size >= 100 || number == 0) return fmt::format("{:.0f}", number);
  const int digits = size >= 10 ? 1 : size >= 1 ? 2 : 2 - static_cast<int>(std::floor(std::log10(size)));
  std::string text = fmt::format("{:.{}f}", number, digits);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string shown(std::string_view cell) {
  const auto number = cli::parse_number(cell);
  return number ? brief(*number) : escaped(cell);
}

}  // namespace bch::report
