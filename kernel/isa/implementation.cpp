// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/query.hpp>

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "kernel/runtime/kernels.hpp"
#include "layout/base/instruction_set.hpp"

namespace bch::detail {

extern const Kernels avx512_kernels, avx2_kernels, sse2_kernels, neon_kernels, simd128_kernels,
    scalar_kernels;

}  // namespace bch::detail

namespace bch {
namespace {

constexpr Implementation row(const detail::InstructionSet& set, const detail::Kernels& kernels) {
  return {set.name, set.supported, &kernels};
}

#if defined(__wasm_simd128__)  // a module does not start where its instructions are missing
constexpr Implementation last = row(detail::simd128, detail::simd128_kernels);
#else
constexpr Implementation last = row(detail::scalar, detail::scalar_kernels);
#endif
constexpr Implementation table[] = {BCH_ON_X86(
    row(detail::avx512, detail::avx512_kernels), row(detail::avx2, detail::avx2_kernels),
    row(detail::sse2, detail::sse2_kernels), ) BCH_ON_NEON(row(detail::neon, detail::neon_kernels), ) last};

const Implementation& choose() {
  if (const char* name = std::getenv("BCH_ISA")) return implementation(name);
  return detail::first_supported(table);
}

}  // namespace

std::span<const Implementation> implementations() noexcept {
  return table;
}

const Implementation& best_implementation() {
  static const Implementation& best = choose();
  return best;
}

const Implementation& implementation(std::string_view name) {
  for (const Implementation& each : table) {
    if (name != each.name) continue;
    if (!each.supported())
      throw std::invalid_argument("expected an implementation that this processor runs, found '" +
                                  std::string(name) + "'");
    return each;
  }
  std::string known;
  for (const Implementation& each : table) known += known.empty() ? each.name : std::string(", ") + each.name;
  throw std::invalid_argument("expected an implementation of " + known + ", found '" + std::string(name) +
                              "'");
}

}  // namespace bch
