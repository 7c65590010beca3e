// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/contact/disc_pair.hpp"
#include "kernel/runtime/implementation.hpp"
#include "layout/format/agents.hpp"
#include "layout/shape_set/shape_set.hpp"

namespace bch {

/// The overlapping discs of each pair's agents: rows that follow each other in one array.
struct ContactTable {
  std::vector<std::uint64_t> offsets;  ///< one more than pairs: pair i's row is offsets[i] .. offsets[i + 1]
  std::vector<DiscPair> contacts;  ///< a row by its first discs, those of a first disc by their second ones

  std::span<const DiscPair> of(std::size_t pair) const noexcept {
    return std::span(contacts).subspan(offsets[pair], offsets[pair + 1] - offsets[pair]);
  }
};

struct ContactOptions {
  /// One row of implementations(); null: the best that this processor runs. The answers are the same bits.
  const kernel::Implementation* implementation = nullptr;
  Leaves leaves = Leaves::segments;
};

/// Finds, for each pair, all pairs of discs of the agents' cuts, at their levels, that make a collision: they
/// overlap, and so do all nodes above the one and above the other, and with exact leaves segments of theirs
/// meet; see Semantics and Leaves. So a row is empty exactly where collide() answers 0 in boundary semantics
/// with the same leaves. A table is never cut short: contacts are counted, then written. Two equal cuts of n
/// discs in one place have n^2 of them at most.
///
/// A row's deepest overlap does not begin at nothing when two agents come together, because nodes above
/// decide as well: the cut discs may have overlapped for long when the last two of those begin to. Forces
/// that have to be continuous take clearance() below 0, or penetration() of all pairs that are near.
///
/// The contacts are the same bits on every processor, for any number of threads. A pair in the other order
/// has the same contacts with their two discs exchanged, sorted in that order.
///
/// Shapes:  an agent may be paired with itself: each disc then overlaps itself, and others.
/// Memory:  the table's vectors are resized and nothing else is allocated.
/// Errors:  throws std::invalid_argument, before the table is touched, like collide(); std::bad_alloc or
///          std::length_error where memory does not hold the contacts, and then the table has none and no
///          rows.
/// Threads: runs in the caller's TBB arena.
void contacts(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs, ContactTable& table,
              const ContactOptions& options = {});

}  // namespace bch
