// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "kernel/recordings/check.hpp"
#include "layout/base/mixed_hash.hpp"

namespace bch::detail {

/// Stores the paths of people for measured_seconds, and finds how long ago a person was where another person
/// is now.
/// Memory: about 80 bytes per person-frame of that time.
class RecentSteps {
 public:
  /// Adds the people of the next frame, by ascending id, and sets the post-encroachment time of each in
  /// `measures`.
  void add(double seconds, std::span<const CheckedPerson> people, std::span<MeasuredPerson> measures);

 private:
  /// Represents a straight displacement from one frame to the next, relative to the corner of its cell.
  struct Step {
    std::int64_t id;
    double end;      ///< seconds
    float duration;  ///< seconds
    float x, y, way_x, way_y;
  };
  struct Place {
    std::int64_t id;
    double x, y;
  };

  void remember(const Place& from, const Place& to, double begin, double end);
  float since(const Place& place, double seconds) const;
  void forget(double before);

  std::unordered_map<std::uint64_t, std::vector<Step>, MixedHash>
      cells_;  ///< by cell of the ground: the steps near it, by time
  std::vector<Place> last_, now_;
  double last_seconds_ = 0, forgotten_ = 0;
};

}  // namespace bch::detail
