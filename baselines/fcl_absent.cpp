// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/kind_rows.hpp"

// Compiled in place of fcl_structures.cpp where there is no FCL.

namespace bch::baselines {

std::span<const Kind> fcl_kinds() {
  return {};
}

}  // namespace bch::baselines
