// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

namespace bch {

/// Two agents by index. Collisions do not depend on their order; other queries report about the first.
struct Pair {
  std::uint32_t first;
  std::uint32_t second;
  friend bool operator==(const Pair&, const Pair&) = default;
};

}  // namespace bch
