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

/// Opens a recording by a function of its options.
/// Errors:  throws Failure with `fault`, or with BCH_CANCELLED.
template <class Open>
std::unique_ptr<bch_trajectory> opened(const bch_trajectory_options& given, bch_status fault, Open open) {
  TrajectoryOptions options;
  if (given.fps != 0) options.fps = given.fps;
  if (given.unit != 0) options.unit = given.unit;
  if (given.columns != nullptr) options.columns = given.columns;
  const auto opening = std::make_shared<Opening>(given);
  options.go_on = [opening] { return opening->go_on(); };
  auto trajectory = std::make_unique<bch_trajectory>();
  trajectory->fault = fault;
  try {
    trajectory->reader = open(options);
  } catch (const TrajectoryError& error) {
    throw Failure(opening->is_cancelled() ? BCH_CANCELLED : fault, error.what());
  }
  opening->end();
  for (const std::string& line : trajectory->reader->info().assumptions)
    trajectory->assumptions += line + "\n";
  for (const std::string& line : trajectory->reader->info().notes) trajectory->notes += line + "\n";
  for (const NamedMotion& motion : trajectory->reader->info().motions) {
    trajectory->motions.push_back({motion.character.c_str(), motion.clip.c_str()});
    trajectory->bodies.push_back(
        {motion.body.c_str(), static_cast<float>(motion.length), static_cast<float>(motion.width)});
  }
  return trajectory;
}

constexpr std::size_t column_sizes[] = {sizeof(double), sizeof(float), sizeof(std::int64_t),
                                        sizeof(std::int32_t), sizeof(const char*)};

ColumnView column_of(const bch_column& given, std::size_t rows) {
  required(given.name, "columns->name");
  const auto type = one_of(given.type, ColumnView::Type::text, "columns->type");
  const std::size_t stride = given.stride > 0 ? given.stride : column_sizes[given.type];
  if (rows > PTRDIFF_MAX / stride)
    throw Failure(BCH_INVALID_ARGUMENT, "row_count is " + std::to_string(rows));
  return {given.name, given.values, stride, type};
}

/// Runs a function that reads a recording, which may turn out to be bad at any frame.
template <class Body>
bch_status guarded_reading(bch_trajectory* handle, Body body) noexcept {
  return guarded([&] {
    bch_trajectory& trajectory = object_of(handle, "trajectory");
    try {
      body(trajectory);
    } catch (const TrajectoryError& error) {
      throw Failure(trajectory.fault, error.what());
    }
  });
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
using namespace bch::detail;

bch_status bch_trajectory_open(const char* path, const bch_trajectory_options* options,
                               bch_trajectory** trajectory) {
  return guarded([&] {
    required(path, "path");
    required(trajectory, "trajectory");
    const auto given = sized<bch_trajectory_options>(options, BCH_TRAJECTORY_OPTIONS_INIT, "options");
    require_file(path);
    hand_out(opened(given, BCH_BAD_FILE,
                    [&](const TrajectoryOptions& wanted) { return open_trajectory(path, wanted); }),
             trajectory);
  });
}

bch_status bch_trajectory_from_columns(const bch_column* columns, size_t column_count, size_t row_count,
                                       const bch_trajectory_options* options, bch_trajectory** trajectory) {
  return guarded([&] {
    std::vector<ColumnView> views;
    for (const bch_column& column : array_of(columns, column_count, "columns"))
      views.push_back(column_of(column, row_count));
    required(trajectory, "trajectory");
    const auto given = sized<bch_trajectory_options>(options, BCH_TRAJECTORY_OPTIONS_INIT, "options");
    hand_out(opened(given, BCH_INVALID_ARGUMENT,
                    [&](const TrajectoryOptions& wanted) { return open_columns(views, row_count, wanted); }),
             trajectory);
  });
}

bch_status bch_trajectory_get_info(const bch_trajectory* handle, bch_trajectory_info* to) {
  return guarded([&] {
    const bch_trajectory& trajectory = object_of(handle, "trajectory");
    const TrajectoryInfo& info = trajectory.reader->info();
    bch_trajectory_info all = BCH_TRAJECTORY_INFO_INIT;
    all.fps = info.fps;
    all.rows = info.rows;
    all.people = info.people;
    all.first_frame = info.first_frame;
    all.last_frame = info.last_frame;
    all.format = info.format.c_str();
    all.geometry = info.geometry.c_str();
    all.assumptions = trajectory.assumptions.c_str();
    all.notes = trajectory.notes.c_str();
    fill(to, all, "info");
  });
}

bch_status bch_trajectory_read(bch_trajectory* trajectory, bch_tracked_person* people, size_t capacity,
                               size_t* count) {
  return guarded_reading(trajectory, [&](bch_trajectory& from) {
    required(count, "count");
    *count = read(from, array_of(people, capacity, "people"));
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

bch_status bch_trajectory_get_bodies(const bch_trajectory* trajectory, const bch_named_body** bodies,
                                     size_t* count) {
  return guarded([&] {
    const auto& all = object_of(trajectory, "trajectory").bodies;
    required(bodies, "bodies"), required(count, "count");
    *bodies = all.data(), *count = all.size();
  });
}

bch_status bch_trajectory_free(bch_trajectory* trajectory) {
  return free_object(trajectory, "trajectory");
}

bch_status bch_check_run(bch_trajectory* trajectory, const bch_check_options* options, bch_check** check) {
  return guarded_reading(trajectory, [&](bch_trajectory& of) {
    required(check, "check");
    hand_out(run_check(of, sized<bch_check_options>(options, BCH_CHECK_OPTIONS_INIT, "options")), check);
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

bch_status bch_check_get_notes(const bch_check* check, const char** notes) {
  return guarded([&] {
    required(notes, "notes");
    *notes = object_of(check, "check").notes.c_str();
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

bch_status bch_check_get_densities(const bch_check* check, const bch_check_density** densities,
                                   size_t* count) {
  return guarded([&] {
    const auto& all = object_of(check, "check").densities;
    required(densities, "densities"), required(count, "count");
    *densities = all.data(), *count = all.size();
  });
}

bch_status bch_check_get_measures(const bch_check* check, const bch_check_measure** measures, size_t* count) {
  return guarded([&] {
    const auto& all = object_of(check, "check").measures;
    required(measures, "measures"), required(count, "count");
    *measures = all.data(), *count = all.size();
  });
}

bch_status bch_check_get_conflicts(const bch_check* check, const bch_check_conflict** pairs, size_t* count) {
  return guarded([&] {
    const auto& all = object_of(check, "check").conflicts;
    required(pairs, "pairs"), required(count, "count");
    *pairs = all.data(), *count = all.size();
  });
}

bch_status bch_check_get_page(const bch_check* check, const char** html, size_t* size) {
  return guarded([&] {
    const std::string& page = object_of(check, "check").page;
    required(html, "html"), required(size, "size");
    *html = page.c_str(), *size = page.size();
  });
}

bch_status bch_check_free(bch_check* check) {
  return free_object(check, "check");
}
