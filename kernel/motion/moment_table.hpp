// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bch::detail {

/// Represents a body at a time of its clip. Equal moments look the same.
struct Moment {
  static constexpr std::uint32_t nobody = 0xffffffff;

  std::uint32_t body = nobody;
  double seconds = 0;  ///< no -0
  friend bool operator==(const Moment&, const Moment&) = default;
};

/// Tells where in a list of different moments each is: a hash table whose memory stays.
class MomentTable {
 public:
  /// Begins anew, for a list of `most` moments.
  void clear(std::size_t most) { places_.assign(std::bit_ceil(2 * most + 1), nothing); }

  /// Returns the place of a moment in the list, to which it is appended where it is not there.
  std::uint32_t place(const Moment& moment, std::vector<Moment>& list) {
    const std::size_t mask = places_.size() - 1;
    std::size_t at = hash(moment) & mask;
    while (places_[at] != nothing) {
      if (list[places_[at]] == moment) return places_[at];
      at = (at + 1) & mask;
    }
    list.push_back(moment);
    return places_[at] = static_cast<std::uint32_t>(list.size() - 1);
  }

  /// Takes a moment that is in the list, and that the table does not have yet.
  void add(std::uint32_t place, const std::vector<Moment>& list) {
    const std::size_t mask = places_.size() - 1;
    std::size_t at = hash(list[place]) & mask;
    while (places_[at] != nothing) at = (at + 1) & mask;
    places_[at] = place;
  }

 private:
  static constexpr std::uint32_t nothing = 0xffffffff;

  static std::size_t hash(const Moment& moment) {
    std::uint64_t bits = std::bit_cast<std::uint64_t>(moment.seconds) + moment.body * 0x9e3779b97f4a7c15u;
    bits = (bits ^ (bits >> 32)) * 0xbf58476d1ce4e5b9u;
    return static_cast<std::size_t>(bits ^ (bits >> 29));
  }

  std::vector<std::uint32_t> places_;
};

}  // namespace bch::detail
