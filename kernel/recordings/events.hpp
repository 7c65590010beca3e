// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <vector>

#include "kernel/recordings/check.hpp"

namespace bch::detail {

/// Joins overlaps of frames one after the other to events. Each pass is an event of its own.
class EventLog {
 public:
  /// Takes the overlaps and passes of the next frame, and where the first person of each is.
  void add(const CheckedFrame& frame);
  /// Returns all events, by their first frames, then ids.
  std::vector<OverlapEvent> finish();

 private:
  std::vector<OverlapEvent> open_, still_open_;  ///< in the order of a frame's pairs
  std::vector<OverlapEvent> closed_;
};

}  // namespace bch::detail
