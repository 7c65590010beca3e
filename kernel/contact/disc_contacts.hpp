// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/query.hpp>

#include "kernel/simd/arguments.hpp"

namespace bch::detail {

/// Finds the contacts of pairs. Keeps its memory from call to call. Contacts are counted before they are
/// written, so rows are never truncated.
class DiscContacts {
 public:
  /// Returns one row per pair, ordered by the first discs and then by the second discs. Valid until the next
  /// call.
  /// Errors:  throws std::invalid_argument like collide(), before the rows of the last call are changed;
  ///          std::bad_alloc or std::length_error if there is not enough memory, and the rows of the last
  ///          call are then lost.
  Rows<DiscPair> find(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                      Leaves leaves, const Implementation* implementation);
  /// Does the same for pairs whose agents are known to be valid.
  Rows<DiscPair> find_valid(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                            Leaves leaves, const Implementation* implementation);

 private:
  void find_in_two_passes(const Implementation& implementation, const Arguments& arguments,
                          std::size_t pairs);
  void find_few(const Implementation& implementation, const Arguments& arguments, std::size_t pairs);
  void add_empty_rows(const Arguments& arguments, std::span<const Pair> pairs);

  std::vector<std::uint64_t> offsets_;
  std::vector<DiscPair> contacts_;
  std::vector<Pair> overlapping_heights_;  ///< pairs whose height intervals overlap, if agents have heights
};

}  // namespace bch::detail
