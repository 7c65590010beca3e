// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <vector>

#include "kernel/recordings/check.hpp"

namespace bch::detail {

/// Joins overlaps in successive frames into events. Each pass is an event of its own.
class EventLog {
 public:
  /// Adds the overlaps and passes of the next frame.
  void add(const CheckedFrame& frame);
  /// Returns all events, by first frames, then ids.
  std::vector<OverlapEvent> finish();

 private:
  std::vector<OverlapEvent> open_, still_open_;  ///< in the order of a frame's pairs
  std::vector<OverlapEvent> closed_;
};

}  // namespace bch::detail
