// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "kernel/recordings/check.hpp"
#include "layout/base/mixed_hash.hpp"

namespace bch::detail {

/// Represents a point of the ground in the recording's coordinates, metres, which floats may be too coarse
/// for.
struct PagePoint {
  double x = 0;
  double y = 0;
};

/// Numbers things in the order in which they first appear.
template <class Key>
class Numbering {
 public:
  std::uint32_t number(Key key) {
    const auto [at, is_new] = numbers_.try_emplace(key, static_cast<std::uint32_t>(keys_.size()));
    if (is_new) keys_.push_back(key);
    return at->second;
  }
  const std::vector<Key>& keys() const { return keys_; }

 private:
  std::unordered_map<Key, std::uint32_t, MixedHash> numbers_;
  std::vector<Key> keys_;
};

/// Holds the frames of a recording that its page keeps: one of every step(), from the first on. What they hold is
/// rounded: places to millimetres, headings to 1/65536 of a turn, speeds to millimetres per second.
class KeptFrames {
 public:
  /// Keeps a frame, or counts it alone if it lies between two steps.
  /// Returns: whether it was kept.
  bool add(const CheckedFrame& frame);
  /// Doubles the step and drops every second frame. With one frame or none nothing is left to drop.
  /// Returns: whether there was anything.
  bool halve();

  std::uint64_t step() const { return step_; }
  std::uint64_t seen() const { return seen_; }  ///< frames that were added
  std::size_t size() const { return numbers_.size(); }

  /// Returns the ids of the frames that are kept: these hold the places in this table.
  const std::vector<std::int64_t>& ids() const { return ids_.keys(); }
  /// Returns the shapes of all frames that ever were kept.
  const std::vector<std::uint32_t>& shapes() const { return shapes_.keys(); }

  /// Returns the corner of the least coordinates, which places are relative to.
  PagePoint corner() const;

  /// Returns about how many characters blocks() takes.
  std::size_t block_size() const;
  /// Writes the frames as blocks of a page.
  std::string blocks() const;

 private:
  /// Holds millimetres from origin_, which is the first place of all, rounded to metres.
  struct Place {
    std::int32_t x, y;
  };
  struct Person {
    std::uint32_t who, shape;
    Place at;
    std::int16_t heading;
    std::uint16_t speed;
    std::uint8_t marks;  ///< 1: overlaps somebody, 2: is in a wall
  };
  struct Overlap {
    std::uint32_t first, second;  ///< numbers of ids
  };

  Person kept(const CheckedPerson& person);
  Place place_of(PagePoint at);
  void forget_unused_ids();
  bool narrow_ids() const { return ids().size() < 0xffff; }
  bool narrow_shapes() const { return shapes().size() <= 0xffff; }
  bool narrow_places() const;
  std::string people_blocks() const;

  std::uint64_t step_ = 1, seen_ = 0;
  Numbering<std::int64_t> ids_;
  Numbering<std::uint32_t> shapes_;
  PagePoint origin_;
  bool has_origin_ = false;
  Place least_{}, most_{};  ///< of all places that were ever kept

  std::vector<double> numbers_, seconds_;
  std::vector<std::uint32_t> people_begin_{0}, overlaps_begin_{0};
  std::vector<Person> people_;
  std::vector<Overlap> overlaps_;
};

/// The number of an id that stands for a wall.
inline constexpr std::uint32_t wall_number = 0xffffffff;

/// Counts how many people overlap over time, for a timeline. It keeps the most of each of a few thousand equal
/// stretches of frames, which become longer as frames are added.
class OverlapSeries {
 public:
  static constexpr std::size_t max_stretches = 4096;  // even

  void add(double seconds, std::uint32_t overlapping, std::uint32_t people);
  std::string blocks() const;

 private:
  std::uint64_t length_ = 1, in_last_ = 0;  ///< frames of a stretch, and of the last one so far
  std::vector<double> seconds_;             ///< of the first frame of each stretch
  std::vector<std::uint32_t> overlapping_, people_;
};

}  // namespace bch::detail
