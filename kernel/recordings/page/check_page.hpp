// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/recordings/check.hpp"
#include "kernel/recordings/page/kept_frames.hpp"
#include "kernel/recordings/page/page_shapes.hpp"

// The page of a checked recording: one HTML file that plays it without a network.

namespace bch::detail {

/// Tells what a pose looks like, once for each number.
using PageShapeSource = std::function<PageShape(std::uint32_t pose)>;

/// Holds what is known of a recording before its first frame. Texts come from files that may be anybody's: the page
/// shows them, whatever they are.
struct PageFacts {
  std::string title;
  double fps = 0;  ///< frames of the recording per second; 0 where it has no rate
  std::vector<std::pair<std::string, std::string>> facts =
      {};                                          ///< names and values, in the order of the page
  std::vector<std::vector<PagePoint>> walls = {};  ///< lines; a ring ends where it begins
};

/// Holds what is known of a recording after its last frame: facts, which the page shows before the others, and a table of texts, whose first row
/// names its columns.
struct PageResults {
  std::vector<std::pair<std::string, std::string>> facts = {};
  std::vector<std::vector<std::string>> table = {};
};

/// Collects the frames of a recording for a page. Where the page would become too large, every second frame that was
/// kept is dropped, and from then on only frames of twice the step are kept: which ones depends on nothing but the
/// frames. The timeline of the page, and its list of events, tell of all frames.
/// Memory:  at most a small multiple of `max_bytes`, whatever the number of frames.
class CheckPage {
 public:
  static constexpr std::size_t default_most_bytes = 30'000'000;
  /// The most events that the page lists: the deepest.
  static constexpr std::size_t max_events = 5000;

  CheckPage(PageFacts facts, PageShapeSource shapes, std::size_t max_bytes = default_most_bytes);

  /// Adds the next frame. Shapes that it is the first to show are asked for.
  void add_frame(const CheckedFrame& frame);

  /// Returns of how many frames one is kept so far: a power of two.
  std::uint64_t step() const { return frames_.step(); }

  /// Returns the page. It is larger than asked only if its first frame, walls and facts alone are.
  std::string finish(std::span<const OverlapEvent> events, PageResults results = {}) &&;

 private:
  std::string fixed_blocks() const;
  std::string meta_block(std::span<const OverlapEvent> events) const;
  std::string html(std::string_view data) const;

  PageFacts facts_;
  PageShapeSource source_;
  std::size_t max_bytes_;
  KeptFrames frames_;
  PageShapes shapes_;
  OverlapSeries series_;
  PageResults results_;
};

}  // namespace bch::detail
