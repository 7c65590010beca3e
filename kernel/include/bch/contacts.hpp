// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <memory>
#include <span>

#include <bch/query.hpp>

namespace bch {

/// Holds the contacts of a crowd: one row, which may be empty, for each pair that BroadPhase::find() finds.
struct CrowdContacts {
  std::span<const Pair> pairs;  ///< first < second, in the order of BroadPhase::find()
  Rows<DiscPair> contacts;      ///< as ContactFinder::find() returns them for these pairs
};

/// Finds, for each pair of agents, all pairs of discs that make them collide. Discs are those of the agents' cuts, at their levels. A
/// pair of discs counts if the discs overlap, all nodes above the one overlap all nodes above the other, and, with exact leaves,
/// segments of the two meet; see query.hpp and Leaves. So a row is empty exactly where collide() with the same leaves answers 0, or
/// where agents collide only because one lies inside the other's outline. Rows are never truncated: contacts are counted, then written. Two equal cuts of n discs in one place have at
/// most n^2 contacts.
///
/// The deepest overlap of a row does not grow from 0 when two agents come together, because the nodes above
/// decide as well: discs may already overlap deeply when their last two ancestors begin to overlap. For forces
/// that have to be continuous use clearance() with Overlap::deepest, or penetration() of all pairs that are near.
///
/// The contacts are the same bits on every processor, for any number of threads. A pair in the other order
/// has the same contacts with their two discs exchanged, sorted in that order.
///
/// Bodies in slabs have the contacts of all slabs that may meet; ShapeSet::slab_begin() tells the slab of a disc.
///
/// The contacts of bodies of discs (shape_from_discs()) are all overlaps of their discs, as in mechanical crowd models.
///
/// The object keeps its memory from call to call. One that was moved from can only be assigned to or destroyed.
class ContactFinder {
 public:
  ContactFinder();
  ContactFinder(ContactFinder&&) noexcept;
  ContactFinder& operator=(ContactFinder&&) noexcept;
  ~ContactFinder();

  /// Finds the contacts of each pair: one row per pair, ordered by the first discs and then by the second discs.
  /// Options: leaves, implementation.
  /// Sizes:   an agent may be paired with itself: each disc then overlaps itself, and others.
  /// Memory:  the rows are valid until the next call; a call like an earlier one allocates nothing.
  /// Errors:  throws std::invalid_argument like collide(), before the rows of the last call are touched; std::bad_alloc or
  ///          std::length_error where memory does not hold the contacts, and the rows of the last call are then lost.
  /// Threads: runs in the caller's TBB arena; one call at a time, as BroadPhase::find().
  Rows<DiscPair> find(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                      const QueryOptions& options = {});

  /// Finds all contacts of a crowd: broad and narrow phase in one call.
  /// Options: leaves, implementation.
  /// Memory:  pairs and rows are valid until the next call; a call like an earlier one allocates nothing, unless bodies are in slabs
  ///          or at different heights.
  /// Errors:  throws std::invalid_argument like validate(shapes, agents) and find(); the last answer is then lost.
  /// Threads: as find().
  CrowdContacts find_all(const ShapeSet& shapes, const Agents& agents, const QueryOptions& options = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bch
