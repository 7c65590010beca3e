// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "kernel/recordings/page/check_page.hpp"
#include "kernel/recordings/page/checked_recording.hpp"

namespace bch::detail {

/// Represents the page of a recording, which is filled while that is checked.
class RecordingPage {
 public:
  /// Refers to the recording.
  explicit RecordingPage(const CheckedRecording& recording);
  void add(const CheckedFrame& frame, const ShapeSet& shapes);
  std::string finish(const CheckSummary& summary) &&;

 private:
  PageShape shape(std::uint32_t pose) const;

  const CheckedRecording& recording_;
  const CheckedFrame* frame_ = nullptr;  ///< that is added
  const ShapeSet* shapes_ = nullptr;     ///< its own
  std::uint32_t first_pose_ = 0;         ///< of these
  CheckPage page_;
};

}  // namespace bch::detail
