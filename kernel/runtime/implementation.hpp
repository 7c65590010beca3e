// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <string_view>

#include "kernel/runtime/kernels.hpp"

namespace bch::kernel {

/// One compilation of the kernels.
struct Implementation : Kernels {
  const char* name;  ///< "avx512", "avx2", "sse2" or "scalar"
  bool (*supported)() noexcept;
};

/// Returns all implementations that were compiled, the best first; the last one
/// runs everywhere.
std::span<const Implementation> implementations() noexcept;

/// The first that this processor and its operating system support. The
/// environment variable BCH_ISA, read once, may name another; throws
/// std::invalid_argument if that one is unknown or not supported.
const Implementation& best_implementation();

/// Errors:  throws std::invalid_argument naming the known ones on an unknown
/// name, or one this processor does
///          not run.
const Implementation& implementation(std::string_view name);

}  // namespace bch::kernel
