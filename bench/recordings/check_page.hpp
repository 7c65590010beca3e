// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <bch/geometry.hpp>

// The page of a checked recording: one HTML file that plays it without a network.

namespace bch::cli {

/// Represents a point of the ground in the recording's coordinates, metres, which floats may be too coarse
/// for.
struct PagePoint {
  double x = 0;
  double y = 0;
};

/// Represents a person in a frame.
struct PagePerson {
  std::int64_t id = 0;      ///< that of the recording, unique in a frame
  std::uint32_t shape = 0;  ///< any number that the source of shapes knows
  PagePoint at = {};        ///< finite
  float heading = 0;        ///< radians, counter-clockwise from the x axis
  float speed = 0;          ///< metres per second
  bool overlaps = false;    ///< with somebody
  bool in_wall = false;
};

/// Represents two people who overlap, or a person and a wall.
struct PageOverlap {
  std::int64_t first = 0;
  std::int64_t second =
      0;  ///< a person's id, who is in the frame; of a wall nothing is kept but that it is one
  bool is_wall = false;
};

struct PageFrame {
  std::int64_t frame = 0;  ///< its number in the recording
  double seconds = 0;      ///< since the recording began; more than in the frame before
  std::span<const PagePerson> people;
  std::span<const PageOverlap> overlaps;
};

/// Represents an overlap from its first frame to its last.
struct PageEvent {
  std::int64_t first = 0;
  std::int64_t second = 0;
  bool is_wall = false;
  double from = 0, to = 0, worst = 0;  ///< seconds; `worst` is when it is deepest
  float depth = 0;                     ///< metres, where it is deepest
  PagePoint at;                        ///< where it is deepest
};

/// Holds what a person looks like in a pose: metres, in the frame of the shape, whose origin is the person's
/// place.
struct PageShape {
  std::string name;
  std::vector<std::vector<Vec2>> contours;
  std::vector<Disc> discs = {};  ///< those of a level, which the page shows on demand; may be empty
};

/// Tells what a shape looks like, once for each number.
using PageShapeSource = std::function<PageShape(std::uint32_t shape)>;

/// Holds what is known of a recording before its first frame. Texts come from files that may be anybody's: the page
/// shows them, whatever they are.
struct PageFacts {
  std::string title;
  double fps = 0;  ///< frames of the recording per second; 0 where it has no rate
  std::vector<std::pair<std::string, std::string>> facts =
      {};                                          ///< names and values, in the order of the page
  std::vector<std::vector<PagePoint>> walls = {};  ///< lines; a ring ends where it begins
};

/// Collects the frames of a recording for a page. Where the page would become too large, every second frame that was
/// kept is dropped, and from then on only frames of twice the step are kept: which ones depends on nothing but the
/// frames. The timeline of the page, and its list of events, tell of all frames.
/// Memory:  at most a small multiple of `most_bytes`, whatever the number of frames.
class CheckPage {
 public:
  static constexpr std::size_t default_most_bytes = 30'000'000;
  /// The most events that the page lists: the deepest.
  static constexpr std::size_t most_events = 5000;

  CheckPage(PageFacts facts, PageShapeSource shapes, std::size_t most_bytes = default_most_bytes);
  CheckPage(CheckPage&&) noexcept;
  CheckPage& operator=(CheckPage&&) noexcept;
  ~CheckPage();

  /// Adds the next frame. Shapes that it is the first to show are asked for.
  void add_frame(const PageFrame& frame);

  /// Returns of how many frames one is kept so far: a power of two.
  std::uint64_t step() const;

  /// Returns the page. It is larger than asked only if its first frame, walls and facts alone are.
  std::string finish(std::span<const PageEvent> events) &&;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bch::cli
