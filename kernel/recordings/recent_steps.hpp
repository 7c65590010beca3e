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

/// Remembers the ways of people for some seconds, and tells how long ago somebody was where somebody else now is. Memory: about 80 bytes for
/// each person-frame of the last measured_seconds.
class RecentSteps {
 public:
  /// Takes the people of the next frame, by ascending id, and measures the encroachment of each.
  void add(double seconds, std::span<const CheckedPerson> people, std::span<MeasuredPerson> measures);

 private:
  /// Represents a straight way from one frame to the next, relative to the corner of its cell.
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
      cells_;  ///< steps near squares of the ground, by time
  std::vector<Place> last_, now_;
  double last_seconds_ = 0, forgotten_ = 0;
};

}  // namespace bch::detail
