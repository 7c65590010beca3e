// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include <bch/crowd.hpp>

#include "bench/recordings/recording_check.hpp"
#include "kernel/recordings/walker_bodies.hpp"
#include "kernel/runtime/spares.hpp"

namespace bch::cli {

/// Shifts the people of a recording, by little and smoothly in time, until no two bodies of spheres overlap and nobody is in a wall. Poses
/// and headings stay. Keeps all rows, about 150 bytes each.
class ResolvedRecording {
 public:
  /// Refers to a recording whose people have bodies of spheres.
  explicit ResolvedRecording(const OpenedCheck& opened);

  /// Takes the next frame.
  void add(const detail::CheckedFrame& frame);
  /// Finds the shifts, in the caller's TBB arena; the same for any number of threads.
  void resolve();
  /// Returns the recording with its people shifted, as CSV that can be checked.
  std::string csv() const;
  /// Returns what was reached, for people.
  std::string report() const;

 private:
  void resolve_frames(bool is_last);
  void resolve_frame(bch::Crowd& crowd, std::size_t frame, bool is_last);
  void smooth(std::vector<double>& shift) const;
  std::size_t size() const { return ids_.size(); }

  const OpenedCheck& opened_;
  detail::WalkerBodies bodies_;
  detail::Spares<bch::Crowd> crowds_;
  std::vector<std::size_t> begin_{0};  ///< of the rows of a frame
  std::vector<std::size_t> left_;      ///< overlaps of a frame
  std::uint64_t before_ = 0;           ///< overlaps of the recording
  // Of a row.
  std::vector<std::int64_t> ids_;
  std::vector<detail::WalkerPose> poses_;
  std::vector<double> seconds_, x_, y_, heading_, stature_;
  std::vector<double> shift_x_, shift_y_;  ///< metres
  std::vector<std::size_t> previous_;      ///< row of the same person, or none
  std::unordered_map<std::int64_t, std::size_t, detail::MixedHash> last_row_;  ///< by id
};

}  // namespace bch::cli
