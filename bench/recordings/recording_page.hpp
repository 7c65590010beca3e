// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "bench/recordings/check_page.hpp"
#include "bench/recordings/recording_check.hpp"

namespace bch::cli {

/// Represents the page of a recording, which is filled while that is checked.
class RecordingPage {
 public:
  /// Refers to the recording.
  explicit RecordingPage(const CheckedRecording& recording);
  void add(const detail::CheckedFrame& frame, const ShapeSet& shapes);
  std::string finish(const detail::CheckSummary& summary) &&;

 private:
  PageShape shape(std::uint32_t pose) const;

  const CheckedRecording& recording_;
  const detail::CheckedFrame* frame_ = nullptr;  ///< that is added
  const ShapeSet* shapes_ = nullptr;             ///< its own
  std::uint32_t first_pose_ = 0;                 ///< of these
  CheckPage page_;
};

}  // namespace bch::cli
