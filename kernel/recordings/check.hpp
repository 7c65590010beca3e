// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <bch/bodies.hpp>
#include <bch/obstacles.hpp>

#include "kernel/recordings/measures.hpp"
#include "kernel/recordings/walker_shapes.hpp"
#include "kernel/recordings/walkers.hpp"

namespace bch::detail {

/// Holds the options of a check of a recording.
struct CheckOptions {
  ShapeSetPlan plan = {};            ///< one level, of any depth
  Leaves leaves = Leaves::segments;  ///< what decides who overlaps, where the level has all depths
  double max_distance = 0;           ///< gaps up to that are measured, metres; 0: none are
  const ObstacleSet* walls = nullptr;
  std::uint32_t coarse =
      1;  ///< 1: neither speed nor phase of a pose is off by what moves an outline by 1 cm; 3: by 3 cm
  CastView cast = {};  ///< whose bodies people have; where it is empty, pedestrians'
  const ShapeSet* baked =
      nullptr;  ///< their shapes, of baked_cast(): of its last level, so that the plan does not matter
  /// Models of bodies of spheres that people have in place of outlines, in the exact time of a clip: body_models() of a cast that is not
  /// baked. Empty: outlines. Spheres decide in space, and all people stand on one ground.
  std::span<const BodyModel> bodies = {};
  /// Bodies that do not walk, which rows may name beside those of the library. Outlines that are not baked alone have them.
  std::span<const Footprint> footprints = {};
  bool draws =
      true;  ///< where spheres decide, frames are handed over with shapes of the same people, too: pictures need them
  double facing = 0;      ///< radians: where the shapes of baked people face, which others do to 0
  bool measures = false;  ///< frames are handed over with measures of people and pairs
  std::size_t people_at_once =
      100'000;  ///< about so many, of many frames; the answers are the same for any number
  std::size_t max_pairs =
      0;  ///< of neighbours, in some 4 096 person-frames, or in one frame; 0: usual_max_pairs()
};

/// Reports that a recording has more pairs of neighbours than are held at once. The message names the frame.
class TooManyPairs : public std::length_error {
 public:
  using std::length_error::length_error;
};

/// Describes two people of a frame, or a person and a wall, who are near each other.
struct CheckedPair {
  std::int64_t frame;
  std::int64_t first, second;  ///< ids; `second` is a wall's number where `is_wall`
  bool is_wall;
  bool overlap;  ///< the two overlap in this frame
  bool passing;  ///< they do between this frame and the next, and in neither of them
  float depth;   ///< how far the first has to move to be free; of spheres in a wall, how deep one is; metres
  float gap;     ///< between them in this frame, metres; 0 also where discs overlap, but not their ancestors
  float x, y;    ///< where the first has to move
  // Of a pass: how long after this frame they touch, in frames, and the way of the first until then, metres.
  float after, way_x, way_y;
};

/// Describes a person of a frame, as he was checked.
struct CheckedPerson {
  Walker walker;
  std::uint32_t shape;  ///< in the set that is handed over with the frame; 0 where none are made
  std::uint32_t pose;   ///< a number that nobody in another pose has, in the whole recording
  float density;        ///< people per square metre within a metre of him
  bool overlaps;        ///< somebody, in this frame
  bool in_wall;
};

/// The number of rows from which on a recording is checked with coarser poses, so that these are still few beside
/// the rows.
constexpr std::uint64_t coarse_from = 300'000;

/// Describes a frame that was checked.
struct CheckedFrame {
  std::int64_t frame;
  double seconds;  ///< from frame 0
  std::span<const CheckedPerson> people;
  std::span<const CheckedPair> pairs;
  std::span<const WalkerPose> poses = {};  ///< of the people
  // Where measures are asked for.
  std::span<const MeasuredPerson> measures = {};      ///< of the people
  std::span<const MeasuredPair> measured_pairs = {};  ///< by ids
};

/// The radii of discs whose answer is told beside, metres, and the classes of density, people per square metre.
constexpr std::array<double, 4> compared_discs{0.2, 0.25, 0.3, 0.4};
constexpr std::array<double, 6> density_classes{0, 1, 2, 3, 4, 6};

/// Counts person-frames, and how many of them overlap.
struct OverlapCount {
  std::uint64_t people = 0, guessed = 0, overlapping = 0, in_walls = 0;
  std::array<std::uint64_t, compared_discs.size()> discs{};
  std::uint64_t near_pairs = 0, overlapping_pairs = 0;  ///< of those within 1.2 m
  std::array<std::uint64_t, compared_discs.size()> disc_pairs{};

  OverlapCount& operator+=(const OverlapCount& other);
};
using OverlapCounts = std::array<OverlapCount, density_classes.size()>;

/// Describes two people who overlap in frames one after the other, or who pass: touch after the frame `from`, and before the next.
struct OverlapEvent {
  std::int64_t first, second;
  bool is_wall;
  std::int64_t from, to;  ///< frames
  double worst;           ///< the frame of the largest depth; of a pass when they touch, between two frames
  std::uint32_t frames;
  float depth;  ///< the largest; below 0: they pass
  double x, y;  ///< where the first person then is, metres

  bool is_pass() const noexcept { return depth < 0; }
  /// Returns the frame of the largest depth, or the one before a pass, and how long after it that is, in frames.
  std::int64_t worst_frame() const noexcept { return is_pass() ? from : static_cast<std::int64_t>(worst); }
  double after() const noexcept { return worst - static_cast<double>(worst_frame()); }
};

/// Summarises a recording, or an interval of its frames: people are then those until its end.
struct CheckSummary {
  std::uint64_t frames = 0, people = 0, guessed = 0;
  std::uint64_t overlap_events = 0, passings = 0, wall_events = 0;  ///< all events, by their kinds
  // People who collide with anybody at any time, as bodies or as discs, where measures are asked for.
  std::uint64_t colliding = 0, disc_colliding = 0;
  std::int64_t first_frame = 0, last_frame = 0;
  OverlapCount all;
  OverlapCounts by_density;
  std::vector<OverlapEvent> events;  ///< by their first frames, then ids
  std::set<std::uint64_t> poses;     ///< keys of all that people were in; none where spheres decide
  std::vector<std::string>
      notes;  ///< a sentence each: what seems to be wrong with the recording or the walls
};

/// Puts a walking person, or the body that it has, on every row of a recording and finds who collides with whom. Who comes or goes through the
/// border of the floor (borders_of()), so that he is missing from the recording within 0.4 s, is not in a wall there. Reads frame after frame; memory
/// grows with the people, and with those of some frames. Characters and clips that rows name are taken from the cast.
/// `seen`, which may be empty, is called with every frame in turn, on the caller's thread.
/// Threads: runs in the caller's TBB arena, and reads on any of its threads, what comes next while it checks. The same answers for any
///          number of threads.
/// Errors:  throws TrajectoryError, also where rows name what the cast does not have; TooManyPairs.
CheckSummary check(TrajectoryReader& reader, const CheckOptions& options,
                   const std::function<void(const CheckedFrame&, const ShapeSet&)>& seen = {});

}  // namespace bch::detail
