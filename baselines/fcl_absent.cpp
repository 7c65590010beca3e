// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/kind_rows.hpp"
#include "baselines/pair_distances.hpp"

// Compiled in place of fcl_structures.cpp and fcl_distances.cpp where there is no FCL.

namespace bch::baselines {

std::span<const Kind> fcl_kinds() {
  return {};
}

std::unique_ptr<PairDistances> fcl_outline_distances(std::span<const Body>) {
  return nullptr;
}

std::unique_ptr<PairDistances> fcl_segment_distances(std::span<const Body>) {
  return nullptr;
}

std::unique_ptr<PairDistances> fcl_mesh_distances(std::span<const Body>) {
  return nullptr;
}

}  // namespace bch::baselines
