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
  Leaves leaves = Leaves::segments;  ///< what decides about overlaps, if the level has all depths
  double max_distance = 0;           ///< measure gaps up to this, metres; 0: measure none
  const ObstacleSet* walls = nullptr;
  std::uint32_t coarse =
      1;  ///< 1 or 3: rounding speed or phase to a pose moves an outline by less than 1 or 3 cm
  CharacterLibraryView library = {};  ///< characters whose bodies people have; empty: built-in pedestrians
  const ShapeSet* baked =
      nullptr;  ///< shapes of baked_library(), used at their last level, not the plan's; or none
  /// Models of bodies of spheres, which replace outlines and are posed at the exact time of a clip:
  /// body_models() of a library that is not baked. They are tested in 3D, with all people on one ground. Empty:
  /// outlines.
  std::span<const BodyModel> bodies = {};
  /// Bodies that do not walk, which rows may name in addition to those of the library. Not with spheres or
  /// baked shapes.
  std::span<const Footprint> footprints = {};
  bool draws = true;      ///< if spheres decide: also pass outlines of the same people with frames, to draw
  double facing = 0;      ///< radians: the direction in which baked shapes face; other shapes face 0
  bool measures = false;  ///< pass measures of people and pairs with frames
  std::size_t people_at_once =
      100'000;  ///< approximate number of person-frames checked at once; does not change answers
  std::size_t max_pairs =
      0;  ///< limit of near pairs in a frame, or in those of a task (FrameRun); 0: usual_max_pairs()
};

/// Errors:  throws TrajectoryError where rows have bodies that do not walk, and the options no place for them.
void require_people(std::span<const NamedMotion> named, const CheckOptions& options);

/// Reports that a frame, or the frames of a task, have more than CheckOptions::max_pairs pairs. The message
/// names them.
class TooManyPairs : public std::length_error {
 public:
  using std::length_error::length_error;
};

/// Describes two people of a frame, or a person and a wall, that are near each other.
struct CheckedPair {
  std::int64_t frame;
  std::int64_t first, second;  ///< ids; `second` is the number of a wall if `is_wall`
  bool is_wall;
  bool overlap;  ///< the two overlap in this frame
  bool passing;  ///< the two touch between this frame and the next, but overlap in neither
  float depth;   ///< metres: how far `first` has to move to separate; for spheres in a wall, of the deepest
  float gap;     ///< in this frame, metres; 0 also if discs overlap, but not their ancestors
  float x, y;    ///< the direction of the move of `depth`, a unit vector
  // For a pass: the time from this frame to the contact, in frames, and the displacement of `first` by then.
  float after, way_x, way_y;
};

/// Describes a person of a frame, as checked.
struct CheckedPerson {
  Walker walker;
  std::uint32_t shape;  ///< index in the set that is passed with the frame; 0 if there is none
  std::uint32_t pose;   ///< a number that identifies the pose in the whole recording
  float density;        ///< people per square metre within 1 m of the person
  bool overlaps;        ///< overlaps another person in this frame
  bool in_wall;
};

/// Recordings with at least this number of rows are checked with coarser poses, so that there are far fewer
/// poses than rows.
constexpr std::uint64_t coarse_from = 300'000;

/// Describes a frame that was checked.
struct CheckedFrame {
  std::int64_t frame;
  double seconds;  ///< from frame 0
  std::span<const CheckedPerson> people;
  std::span<const CheckedPair> pairs;
  std::span<const WalkerPose> poses = {};  ///< of the people
  // With CheckOptions::measures:
  std::span<const MeasuredPerson> measures = {};      ///< of the people
  std::span<const MeasuredPair> measured_pairs = {};  ///< by ids
};

/// The radii of discs that are compared with bodies, metres, and the lower bounds of density classes, people
/// per square metre.
constexpr std::array<double, 4> compared_discs{0.2, 0.25, 0.3, 0.4};
constexpr std::array<double, 6> density_classes{0, 1, 2, 3, 4, 6};

/// Counts person-frames (`guessed`: with a guessed heading), and how many of them overlap.
struct OverlapCount {
  std::uint64_t people = 0, guessed = 0, overlapping = 0, in_walls = 0;
  std::array<std::uint64_t, compared_discs.size()> discs{};
  std::uint64_t near_pairs = 0, overlapping_pairs = 0;  ///< pairs within 1.2 m
  std::array<std::uint64_t, compared_discs.size()> disc_pairs{};

  OverlapCount& operator+=(const OverlapCount& other);
};
using OverlapCounts = std::array<OverlapCount, density_classes.size()>;

/// Describes an overlap in successive frames, or a pass: a contact after the frame `from` and before the
/// next.
struct OverlapEvent {
  std::int64_t first, second;
  bool is_wall;
  std::int64_t from, to;  ///< frames
  double worst;           ///< the frame of the largest depth; for a pass, the time of contact, in frames
  std::uint32_t frames;
  float depth;  ///< the largest; below 0 for a pass
  double x, y;  ///< position of the first person at `worst`, metres

  bool is_pass() const noexcept { return depth < 0; }
  /// Returns the frame of the largest depth, or the frame before a pass; after() is the time from there to
  /// `worst`, in frames.
  std::int64_t worst_frame() const noexcept { return is_pass() ? from : static_cast<std::int64_t>(worst); }
  double after() const noexcept { return worst - static_cast<double>(worst_frame()); }
};

/// Summarises a recording, or an interval of its frames; `people` then counts everybody who appeared before
/// the interval's end.
struct CheckSummary {
  std::uint64_t frames = 0, people = 0, guessed = 0;
  std::uint64_t overlap_events = 0, passings = 0, wall_events = 0;  ///< events of each kind
  // With CheckOptions::measures: people who collide with anybody at any time, as bodies or as discs.
  std::uint64_t colliding = 0, disc_colliding = 0;
  std::int64_t first_frame = 0, last_frame = 0;
  OverlapCount all;
  OverlapCounts by_density;
  std::vector<OverlapEvent> events;  ///< by first frames, then ids
  std::set<std::uint64_t> poses;     ///< keys of all poses of people; empty if spheres decide
  std::vector<std::string> notes;    ///< probable errors in the recording or the walls, one sentence each
};

/// Puts a walking person, or the body that the row names, on every row of a recording and finds all overlaps.
/// A person who appears or disappears within 0.4 s of a frame is not counted as in a wall that is an outer
/// border of the floor (borders_of()). Reads frame by frame; memory grows with the number of people, and with
/// the rows of the few frames that are held at once. `seen` (optional) is called for each frame in order, on
/// the calling thread.
/// Threads: runs in the caller's TBB arena; reads the next frames, on any of its threads, while it checks.
///          The same answers for any number of threads.
/// Errors:  throws TrajectoryError, also if rows name a character or clip that the library does not have;
///          TooManyPairs.
CheckSummary check(TrajectoryReader& reader, const CheckOptions& options,
                   const std::function<void(const CheckedFrame&, const ShapeSet&)>& seen = {});

}  // namespace bch::detail
