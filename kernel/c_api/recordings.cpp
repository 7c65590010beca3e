// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <span>

#include "kernel/c_api/arguments.hpp"
#include "kernel/c_api/handles.hpp"
#include "kernel/c_api/objects.hpp"
#include "kernel/c_api/obstacles.hpp"
#include "kernel/recordings/baked_cast.hpp"
#include "kernel/recordings/check.hpp"
#include "layout/recordings/trajectory.hpp"

struct bch_trajectory {
  std::unique_ptr<bch::detail::TrajectoryReader> reader;
  std::string assumptions;                ///< a line each
  std::vector<bch_named_motion> motions;  ///< whose texts are the reader's
  bool is_read = false;                   ///< some of it
  std::int64_t frame = 0;                 ///< of the people who wait
  std::vector<bch::detail::TrackedPerson> waiting = {};
};

struct bch_check {
  std::vector<bch_check_frame> frames;
  std::vector<bch_check_pair> pairs;
  std::vector<bch_check_event> events;
  bch_check_summary summary = BCH_CHECK_SUMMARY_INIT;
  std::string assumptions;  ///< a line each
};

namespace bch::c_api {
namespace {

using namespace bch::detail;

/// Asks the caller whether reading goes on, twenty times a second at most, as long as the recording is opened.
class Opening {
 public:
  explicit Opening(const bch_trajectory_options& given) : given_(&given) {}

  bool go_on() {
    const auto now = std::chrono::steady_clock::now();
    if (given_ == nullptr || given_->progress == nullptr || now < next_) return true;
    next_ = now + std::chrono::milliseconds(50);
    is_cancelled_ = is_cancelled_ || given_->progress(given_->user, 0, 0) != 0;
    return !is_cancelled_;
  }
  void end() { given_ = nullptr; }
  bool is_cancelled() const { return is_cancelled_; }

 private:
  const bch_trajectory_options* given_;
  std::chrono::steady_clock::time_point next_{};
  bool is_cancelled_ = false;
};

std::unique_ptr<TrajectoryReader> opened(const char* path, const bch_trajectory_options& given) {
  TrajectoryOptions options;
  if (given.fps != 0) options.fps = given.fps;
  if (given.unit != 0) options.unit = given.unit;
  if (given.columns != nullptr) options.columns = given.columns;
  require_file(path);
  const auto opening = std::make_shared<Opening>(given);
  options.go_on = [opening] { return opening->go_on(); };
  try {
    auto reader = open_trajectory(path, options);
    opening->end();
    return reader;
  } catch (const TrajectoryError& error) {
    if (opening->is_cancelled()) throw Failure(BCH_CANCELLED, error.what());
    throw;
  }
}

std::unique_ptr<bch_trajectory> open(const char* path, const bch_trajectory_options& given) {
  auto trajectory = std::make_unique<bch_trajectory>();
  trajectory->reader = opened(path, given);
  for (const std::string& line : trajectory->reader->info().assumptions)
    trajectory->assumptions += line + "\n";
  for (const NamedMotion& motion : trajectory->reader->info().motions)
    trajectory->motions.push_back({motion.character.c_str(), motion.clip.c_str()});
  return trajectory;
}

bch_tracked_person tracked(std::int64_t frame, const TrackedPerson& person) {
  return {frame, person.id, person.x, person.y, person.heading, person.stature};
}

bch_moving_person moving(std::int64_t frame, const TrackedPerson& person) {
  return {tracked(frame, person), person.motion, person.clip_seconds};
}

/// Writes whole frames as long as they fit.
template <class Person>
std::size_t read(bch_trajectory& trajectory, std::span<Person> to,
                 Person (*made)(std::int64_t frame, const TrackedPerson& person)) {
  trajectory.is_read = true;
  std::size_t count = 0;
  while (true) {
    if (trajectory.waiting.empty() && !trajectory.reader->next(trajectory.frame, trajectory.waiting))
      return count;
    if (count + trajectory.waiting.size() > to.size()) break;
    for (const TrackedPerson& person : trajectory.waiting) to[count++] = made(trajectory.frame, person);
    trajectory.waiting.clear();
  }
  if (count == 0)
    throw Failure(BCH_INVALID_ARGUMENT, "capacity is " + std::to_string(to.size()) + ", and frame " +
                                            std::to_string(trajectory.frame) + " has " +
                                            std::to_string(trajectory.waiting.size()) + " people");
  return count;
}

bch_check_pair pair_of(const CheckedPair& pair) {
  const std::int32_t kind = pair.is_wall   ? BCH_CHECK_WALL
                            : pair.passing ? BCH_CHECK_PASS
                            : pair.overlap ? BCH_CHECK_OVERLAP
                                           : BCH_CHECK_NEAR;
  return {pair.frame, pair.first, pair.second, pair.depth, pair.gap, pair.x, pair.y, kind, 0};
}

bch_check_frame frame_of(const CheckedFrame& frame) {
  bch_check_frame to{
      frame.frame, frame.seconds, static_cast<std::uint32_t>(frame.people.size()), 0, 0, 0, 0, 0};
  double density = 0;
  for (const CheckedPerson& person : frame.people) {
    to.overlapping += person.overlaps;
    to.in_walls += person.in_wall;
    density += static_cast<double>(person.density);
  }
  for (const CheckedPair& pair : frame.pairs) to.overlapping_pairs += pair.overlap && !pair.is_wall;
  if (!frame.people.empty())
    to.density = static_cast<float>(density / static_cast<double>(frame.people.size()));
  return to;
}

bch_check_event event_of(const OverlapEvent& event) {
  const std::int32_t kind = event.is_wall     ? BCH_CHECK_WALL
                            : event.is_pass() ? BCH_CHECK_PASS
                                              : BCH_CHECK_OVERLAP;
  return {event.first,
          event.second,
          event.from,
          event.to,
          event.worst_frame(),
          event.x,
          event.y,
          std::max(0.0f, event.depth),
          event.frames,
          kind,
          static_cast<float>(event.after())};
}

bch_check_summary summary_of(const CheckSummary& of, const TrajectoryInfo& info) {
  bch_check_summary to = BCH_CHECK_SUMMARY_INIT;
  to.shapes = static_cast<std::uint32_t>(of.poses.size());
  to.fps = info.fps;
  to.frames = of.frames;
  to.people = of.people;
  to.person_frames = of.all.people;
  to.overlapping = of.all.overlapping;
  to.in_walls = of.all.in_walls;
  to.guessed_headings = of.guessed;
  to.near_pairs = of.all.near_pairs;
  to.overlapping_near_pairs = of.all.overlapping_pairs;
  return to;
}

/// The walls of the caller, or those of the recording.
std::optional<ObstacleSet> own_walls(const bch_check_options& options, const TrajectoryInfo& info) {
  if (options.walls != nullptr || options.without_walls != 0 || info.geometry.empty()) return std::nullopt;
  return obstacles_from_wkt(info.geometry, Polygons::walkable);
}

/// The characters of a baked set.
Cast baked_cast_of(const bch_check_options& options) {
  if (options.character_count > 0)
    throw Failure(BCH_INVALID_ARGUMENT, "options->baked and options->characters are both given");
  const bch_shape_set& set = object_of(options.baked, "options->baked");
  if (set.own == nullptr)
    throw Failure(BCH_INVALID_ARGUMENT, "options->baked does not say which clips its shapes show");
  if (!(std::abs(options.facing) <= 2 * std::numbers::pi))
    throw Failure(BCH_INVALID_ARGUMENT, "options->facing is " + std::to_string(options.facing));
  std::vector<ClipSpeed> speeds;
  for (const bch_clip_speed& given :
       array_of(options.clip_speeds, options.clip_speed_count, "options->clip_speeds")) {
    required(given.clip, "options->clip_speeds");
    if (!(given.speed >= 0 && given.speed <= 20))
      throw Failure(BCH_INVALID_ARGUMENT, "options->clip_speeds has " + std::to_string(given.speed));
    speeds.push_back({given.clip, given.speed});
  }
  return baked_cast(*set.own, "options->baked", speeds);
}

/// The characters of the caller.
Cast cast_of(const bch_check_options& options) {
  if (options.baked != nullptr) return baked_cast_of(options);
  if (options.character_count > 0) required(options.characters, "options->characters");
  Cast cast;
  for (const bch_character* character : std::span(options.characters, options.character_count)) {
    const bch_character& own = object_of(character, "options->characters");
    cast.push_back(cast_member(*own.character, own.name));
  }
  return cast;
}

std::unique_ptr<bch_check> run_check(bch_trajectory& trajectory, const bch_check_options& given) {
  if (trajectory.is_read) throw Failure(BCH_INVALID_ARGUMENT, "trajectory has been read from; open it again");
  CheckOptions options;
  const auto slices = array_of(given.slices, given.slice_count, "options->slices");
  options.plan.slices.assign(slices.begin(), slices.end());
  options.plan.depths = {given.depth};
  options.leaves = one_of(given.leaves, Leaves::segments, "options->leaves");
  if (!(given.max_distance >= 0 && given.max_distance <= 10))
    throw Failure(BCH_INVALID_ARGUMENT, "options->max_distance is " + std::to_string(given.max_distance));
  options.max_distance = given.max_distance;
  options.most_pairs = given.max_pairs;
  const Cast cast = cast_of(given);
  options.cast = cast;
  options.baked = given.baked == nullptr ? nullptr : &object_of(given.baked, "options->baked").set;
  options.facing = given.baked == nullptr ? 0 : given.facing;
  const std::optional<ObstacleSet> walls = own_walls(given, trajectory.reader->info());
  options.walls = given.walls != nullptr ? &object_of(given.walls, "options->walls").set
                  : walls                ? &*walls
                                         : nullptr;

  options.coarse = trajectory.reader->info().rows < coarse_from ? 1 : 3;
  auto made = std::make_unique<bch_check>();
  made->assumptions = trajectory.assumptions;
  for (const CastMember& member : cast)
    for (const std::string& line : member.assumptions) made->assumptions += line + "\n";
  const TrajectoryInfo& info = trajectory.reader->info();
  trajectory.is_read = true;
  on_threads(given.threads, [&] {
    const CheckSummary summary =
        check(*trajectory.reader, options, [&](const CheckedFrame& frame, const ShapeSet&) {
          made->frames.push_back(frame_of(frame));
          for (const CheckedPair& pair : frame.pairs) made->pairs.push_back(pair_of(pair));
          const auto done = static_cast<std::uint64_t>(frame.frame - info.first_frame),
                     total = static_cast<std::uint64_t>(info.last_frame - info.first_frame);
          if (given.progress != nullptr && given.progress(given.user, done, total) != 0)
            throw Failure(BCH_CANCELLED, "cancelled by the caller");
        });
    made->summary = summary_of(summary, info);
    for (const OverlapEvent& event : summary.events) made->events.push_back(event_of(event));
  });
  return made;
}

}  // namespace
}  // namespace bch::c_api

using namespace bch::c_api;

bch_status bch_trajectory_open(const char* path, const bch_trajectory_options* options,
                               bch_trajectory** trajectory) {
  return guarded([&] {
    required(path, "path");
    required(trajectory, "trajectory");
    hand_out(open(path, sized<bch_trajectory_options>(options, BCH_TRAJECTORY_OPTIONS_INIT, "options")),
             trajectory);
  });
}

bch_status bch_trajectory_get_info(const bch_trajectory* handle, bch_trajectory_info* to) {
  return guarded([&] {
    const bch_trajectory& trajectory = object_of(handle, "trajectory");
    const bch::detail::TrajectoryInfo& info = trajectory.reader->info();
    bch_trajectory_info all = BCH_TRAJECTORY_INFO_INIT;
    all.fps = info.fps;
    all.rows = info.rows;
    all.people = info.people;
    all.first_frame = info.first_frame;
    all.last_frame = info.last_frame;
    all.format = info.format.c_str();
    all.geometry = info.geometry.c_str();
    all.assumptions = trajectory.assumptions.c_str();
    fill(to, all, "info");
  });
}

bch_status bch_trajectory_read(bch_trajectory* trajectory, bch_tracked_person* people, size_t capacity,
                               size_t* count) {
  return guarded([&] {
    required(count, "count");
    *count = read(object_of(trajectory, "trajectory"), array_of(people, capacity, "people"), tracked);
  });
}

bch_status bch_trajectory_get_motions(const bch_trajectory* trajectory, const bch_named_motion** motions,
                                      size_t* count) {
  return guarded([&] {
    const auto& all = object_of(trajectory, "trajectory").motions;
    required(motions, "motions"), required(count, "count");
    *motions = all.data(), *count = all.size();
  });
}

bch_status bch_trajectory_read_moving(bch_trajectory* trajectory, bch_moving_person* people, size_t capacity,
                                      size_t* count) {
  return guarded([&] {
    required(count, "count");
    *count = read(object_of(trajectory, "trajectory"), array_of(people, capacity, "people"), moving);
  });
}

bch_status bch_trajectory_free(bch_trajectory* trajectory) {
  return free_object(trajectory, "trajectory");
}

bch_status bch_check_run(bch_trajectory* trajectory, const bch_check_options* options, bch_check** check) {
  return guarded([&] {
    required(check, "check");
    hand_out(run_check(object_of(trajectory, "trajectory"),
                       sized<bch_check_options>(options, BCH_CHECK_OPTIONS_INIT, "options")),
             check);
  });
}

bch_status bch_check_get_summary(const bch_check* check, bch_check_summary* summary) {
  return guarded([&] { fill(summary, object_of(check, "check").summary, "summary"); });
}

bch_status bch_check_get_assumptions(const bch_check* check, const char** assumptions) {
  return guarded([&] {
    required(assumptions, "assumptions");
    *assumptions = object_of(check, "check").assumptions.c_str();
  });
}

bch_status bch_check_get_frames(const bch_check* check, const bch_check_frame** frames, size_t* count) {
  return guarded([&] {
    const auto& all = object_of(check, "check").frames;
    required(frames, "frames"), required(count, "count");
    *frames = all.data(), *count = all.size();
  });
}

bch_status bch_check_get_pairs(const bch_check* check, const bch_check_pair** pairs, size_t* count) {
  return guarded([&] {
    const auto& all = object_of(check, "check").pairs;
    required(pairs, "pairs"), required(count, "count");
    *pairs = all.data(), *count = all.size();
  });
}

bch_status bch_check_get_events(const bch_check* check, const bch_check_event** events, size_t* count) {
  return guarded([&] {
    const auto& all = object_of(check, "check").events;
    required(events, "events"), required(count, "count");
    *events = all.data(), *count = all.size();
  });
}

bch_status bch_check_free(bch_check* check) {
  return free_object(check, "check");
}
