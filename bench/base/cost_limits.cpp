// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/cost_limits.hpp"

#include <fmt/format.h>

namespace bch::cli {

double CostLimits::seconds_for(std::size_t shapes) const {
  return seconds > 0 ? seconds : 60 + static_cast<double>(shapes);
}

double CostLimits::memory_for(std::size_t shapes) const {
  return memory > 0 ? memory : 4 + static_cast<double>(shapes) / 1024;
}

std::string beyond_limit(std::size_t count, const char* what, std::size_t most, const char* option) {
  return fmt::format("{} {}, more than {}; {} raises the limit", count, what, most, option);
}

}  // namespace bch::cli
