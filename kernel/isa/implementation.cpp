// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/query.hpp>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "kernel/runtime/kernels.hpp"

namespace bch::detail {

extern const Kernels avx512_kernels, avx2_kernels, sse2_kernels, scalar_kernels;

}  // namespace bch::detail

namespace bch {
namespace {

// The compiler's test asks the operating system too, whether it saves the wide
// registers; xsimd 8.1's does not.
std::span<const Implementation> table() noexcept {
  static const Implementation rows[] = {
      {"avx512", []() noexcept { return __builtin_cpu_supports("avx512f") != 0; }, &detail::avx512_kernels},
      {"avx2", []() noexcept { return __builtin_cpu_supports("avx2") != 0; }, &detail::avx2_kernels},
      {"sse2", []() noexcept { return true; }, &detail::sse2_kernels},
      {"scalar", []() noexcept { return true; }, &detail::scalar_kernels},
  };
  return rows;
}

const Implementation& choose() {
  if (const char* name = std::getenv("BCH_ISA")) return implementation(name);
  const auto rows = table();
  return *std::find_if(rows.begin(), rows.end(), [](const Implementation& row) { return row.supported(); });
}

}  // namespace

std::span<const Implementation> implementations() noexcept {
  return table();
}

const Implementation& best_implementation() {
  static const Implementation& best = choose();
  return best;
}

const Implementation& implementation(std::string_view name) {
  std::string known;
  for (const Implementation& row : table()) {
    if (name != row.name) {
      known += known.empty() ? row.name : std::string(", ") + row.name;
      continue;
    }
    if (!row.supported())
      throw std::invalid_argument("this processor does not run the implementation '" + std::string(name) +
                                  "'");
    return row;
  }
  throw std::invalid_argument("no implementation '" + std::string(name) + "' (known: " + known + ")");
}

}  // namespace bch
