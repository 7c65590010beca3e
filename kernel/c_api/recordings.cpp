// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/c_api/recordings.hpp"

#include <chrono>
#include <memory>
#include <span>

#include "kernel/c_api/arguments.hpp"
#include "kernel/c_api/handles.hpp"

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
    throw Failure(opening->is_cancelled() ? BCH_CANCELLED : BCH_BAD_FILE, error.what());
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

/// Writes whole frames as long as they fit.
std::size_t read(bch_trajectory& trajectory, std::span<bch_tracked_person> to) {
  trajectory.is_read = true;
  std::size_t count = 0;
  while (true) {
    if (trajectory.waiting.empty() && !trajectory.reader->next(trajectory.frame, trajectory.waiting))
      return count;
    if (count + trajectory.waiting.size() > to.size()) break;
    for (const TrackedPerson& person : trajectory.waiting)
      to[count++] = {trajectory.frame, person.id,      person.x,      person.y,
                     person.heading,   person.stature, person.motion, person.clip_seconds};
    trajectory.waiting.clear();
  }
  if (count == 0)
    throw Failure(BCH_INVALID_ARGUMENT, "capacity is " + std::to_string(to.size()) + ", and frame " +
                                            std::to_string(trajectory.frame) + " has " +
                                            std::to_string(trajectory.waiting.size()) + " people");
  return count;
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
  return guarded_reading([&] {
    required(count, "count");
    *count = read(object_of(trajectory, "trajectory"), array_of(people, capacity, "people"));
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

bch_status bch_trajectory_free(bch_trajectory* trajectory) {
  return free_object(trajectory, "trajectory");
}

bch_status bch_check_run(bch_trajectory* trajectory, const bch_check_options* options, bch_check** check) {
  return guarded_reading([&] {
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
