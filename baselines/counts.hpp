// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

namespace bch::baselines {

/// Counts what a query did.
struct TestCounts {
  std::uint64_t nodes = 0;      ///< pairs of discs, boxes or other volumes tested on the path down
  std::uint64_t leaves = 0;     ///< pairs of triangles or segments tested
  std::uint64_t ancestors = 0;  ///< pairs of discs tested to verify hits
};

/// Counts nothing, and costs nothing.
struct NoCounts {
  void node() const noexcept {}
  void leaf() const noexcept {}
  void ancestor() const noexcept {}
};

struct AddCounts {
  TestCounts& counts;
  void node() const noexcept { ++counts.nodes; }
  void leaf() const noexcept { ++counts.leaves; }
  void ancestor() const noexcept { ++counts.ancestors; }
};

}  // namespace bch::baselines
