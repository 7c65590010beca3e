// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include <bch/crowd.hpp>

#include "kernel/runtime/row_blocks.hpp"

namespace bch::detail {

/// Finds the contacts of pairs of bodies of spheres, and keeps its memory from call to call.
class BodyContactRows {
 public:
  /// Returns one row per pair, valid until the next call. Errors: as collide().
  Rows<Crowd::SphereContact> find(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                                  const Implementation* wanted);

 private:
  RowBlocks<Crowd::SphereContact> rows_;
};

}  // namespace bch::detail
