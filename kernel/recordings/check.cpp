// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/check.hpp"

#include <algorithm>
#include <future>
#include <memory>
#include <optional>
#include <sstream>
#include <unordered_set>
#include <utility>

#include "kernel/recordings/borders.hpp"
#include "kernel/recordings/events.hpp"
#include "kernel/recordings/frame_block.hpp"
#include "kernel/recordings/frame_run.hpp"
#include "kernel/recordings/recent_steps.hpp"
#include "kernel/recordings/walker_bodies.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/base/mixed_hash.hpp"
#include "layout/recordings/shown.hpp"

namespace bch::detail {
namespace {

constexpr std::size_t run_people = 4096;  ///< of a task, about
constexpr double pairs_at_once = 4e6;     ///< about, where runs of a block have more: some 150 bytes each

/// Checks blocks of frames.
class Checker {
 public:
  Checker(const TrajectoryInfo& info, const CheckOptions& options,
          const std::function<void(const CheckedFrame&, const ShapeSet&)>& seen)
      : options_(options),
        motions_(library_motions(info.motions, options_.library, options_.footprints)),
        seen_(seen),
        borders_(options_.walls == nullptr ? std::vector<std::uint8_t>() : borders_of(*options_.walls)),
        shapes_(options_.plan, options_.library, motions_, options_.baked) {
    require_people(info.motions, options_);
    if (!options_.bodies.empty()) bodies_.emplace(options_.bodies, options_.library);
  }

  /// Checks all frames of a block but the last one, which the next block begins with or nobody asks for; at the end that one, too.
  void check(const FrameBlock& block, bool at_end, double fps);
  CheckSummary finish(std::size_t people);

 private:
  std::size_t look(const FrameBlock& block, std::size_t frames);
  void pose(std::size_t runs);
  std::size_t queried_at_once(std::size_t first, std::size_t end) const;
  void run_query(FrameRun& run);
  void report(const FrameBlock& block, FrameRun& run, double fps);
  void add_measures(CheckedFrame& frame, std::span<MeasuredPerson> measures);

  const CheckOptions options_;
  const std::vector<LibraryMotion> motions_;
  const std::function<void(const CheckedFrame&, const ShapeSet&)>& seen_;
  const std::vector<std::uint8_t> borders_;
  WalkerShapes shapes_;
  std::optional<WalkerBodies> bodies_;
  CheckSummary summary_;
  EventLog events_;
  RecentSteps recent_steps_;
  std::unordered_set<std::uint64_t, MixedHash> colliding_, disc_colliding_;
  std::vector<std::unique_ptr<FrameRun>> runs_;
  // Of a block.
  std::vector<WalkerPose> poses_;
  std::vector<std::uint32_t> shape_;
};

/// Divides a block into runs of frames, the last frame being one where it does not belong to the block.
std::vector<std::size_t> run_begins(const FrameBlock& block, std::size_t frames) {
  std::vector<std::size_t> begins{0};
  for (std::size_t i = 1; i < frames; ++i)
    if (block.begin(i) - block.begin(begins.back()) >= run_people) begins.push_back(i);
  if (frames > 0 && frames < block.frames()) begins.push_back(frames);
  begins.push_back(block.frames());
  return begins;
}

/// Takes the people of a block. Returns how many runs they are.
std::size_t Checker::look(const FrameBlock& block, std::size_t frames) {
  const std::vector<std::size_t> begins = run_begins(block, frames);
  const std::size_t runs = begins.size() - 1;
  while (runs_.size() < runs) runs_.push_back(std::make_unique<FrameRun>(options_, motions_, borders_));
  for_ranges(runs, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) runs_[k]->look(block, begins[k], begins[k + 1]);
  });
  return runs;
}

void Checker::pose(std::size_t runs) {
  poses_.clear();
  for (std::size_t k = 0; k < runs; ++k)
    poses_.insert(poses_.end(), runs_[k]->poses().begin(), runs_[k]->poses().end());
  shape_.assign(poses_.size(), 0);
  if (bodies_) bodies_->prepare(poses_);
  if (bodies_ && !options_.draws) return;
  for (const WalkerPose& pose : shapes_.find(poses_, shape_))
    if (!bodies_) summary_.poses.insert(pose.key());
}

void Checker::run_query(FrameRun& run) {
  const std::span<const std::uint32_t> shapes = run.with_next(shape_);
  if (!bodies_)
    return run.run_query(RunOutlines(shapes_.set(), options_.leaves, shapes), shapes, shapes_.given_up());
  // Bodies take memory, so a thread has those of one run at a time.
  without_tasks_from_outside([&] {
    run.run_query(RunSpheres(*bodies_, run.with_next(poses_), run.size()), shapes, shapes_.given_up());
  });
}

/// Tells the frames of a run, and joins its overlaps to events.
void Checker::report(const FrameBlock& block, FrameRun& run, double fps) {
  std::span<const CheckedPair> pairs = run.pairs();
  std::span<const MeasuredPair> measured_pairs = run.measured_pairs();
  for (std::size_t i = run.first(); i < run.last(); ++i) {
    const std::int64_t frame = block.frame(i);
    const auto behind = std::find_if(pairs.begin(), pairs.end(),
                                     [=](const CheckedPair& pair) { return pair.frame != frame; });
    const auto count = static_cast<std::size_t>(behind - pairs.begin());
    const std::size_t begin = block.begin(i) - block.begin(run.first()),
                      size = block.begin(i + 1) - block.begin(i);
    CheckedFrame told{frame, static_cast<double>(frame) / fps, run.people().subspan(begin, size),
                      pairs.first(count), run.poses().subspan(begin, size)};
    pairs = pairs.subspan(count);
    if (options_.measures) {
      add_measures(told, run.measured_people().subspan(begin, size));
      const std::size_t measured = run.measured_pairs_of(i);
      told.measured_pairs = measured_pairs.first(measured);
      measured_pairs = measured_pairs.subspan(measured);
    }
    events_.add(told);
    if (seen_) seen_(told, shapes_.set());
    if (summary_.frames++ == 0) summary_.first_frame = frame;
    summary_.last_frame = frame;
  }
  for (std::size_t k = 0; k < run.counts().size(); ++k) summary_.by_density[k] += run.counts()[k];
}

/// Adds what earlier frames have to do with, and counts who collides.
void Checker::add_measures(CheckedFrame& frame, std::span<MeasuredPerson> measures) {
  recent_steps_.add(frame.seconds, frame.people, measures);
  for (std::size_t i = 0; i < measures.size(); ++i) {
    const auto id = static_cast<std::uint64_t>(frame.people[i].walker.id);
    if (measures[i].collides) colliding_.insert(id);
    if (measures[i].disc_collides) disc_colliding_.insert(id);
  }
  frame.measures = measures;
}

void Checker::check(const FrameBlock& block, bool at_end, double fps) {
  const std::size_t frames = at_end ? block.frames() : block.frames() - 1;
  const std::size_t looked_at = look(block, frames);
  pose(looked_at);
  const std::size_t runs = at_end ? looked_at : looked_at - 1;
  for (std::size_t first = 0; first < runs;) {
    const std::size_t last = queried_at_once(first, runs);
    for_ranges(last - first, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) run_query(*runs_[first + k]);
    });
    for (; first < last; ++first) {
      report(block, *runs_[first], fps);
      runs_[first]->let_go();
    }
  }
}

/// Returns the end of the runs that are asked together: mostly all, but no more than memory is wanted for.
std::size_t Checker::queried_at_once(std::size_t first, std::size_t end) const {
  double pairs = runs_[first]->expected_pairs();
  std::size_t last = first + 1;
  for (; last < end; ++last) {
    pairs += runs_[last]->expected_pairs();
    if (pairs > pairs_at_once) break;
  }
  return last;
}

CheckSummary Checker::finish(std::size_t people) {
  for (const OverlapCount& count : summary_.by_density) summary_.all += count;
  summary_.guessed = summary_.all.guessed;
  summary_.events = events_.finish();
  for (const OverlapEvent& event : summary_.events)
    ++(event.is_wall ? summary_.wall_events : event.is_pass() ? summary_.passings : summary_.overlap_events);
  summary_.people = people;
  summary_.colliding = colliding_.size();
  summary_.disc_colliding = disc_colliding_.size();
  return std::move(summary_);
}

std::string rounded(double speed) {
  std::ostringstream text;
  text.precision(3);
  text << speed;
  return std::move(text).str();
}

/// Says where people are too fast or too slow to be people, and that walls are none.
std::vector<std::string> notes_on(const Speeds& speeds, const ObstacleSet* walls) {
  constexpr double fastest_crowd = 12, fastest_step = 100, slowest_crowd = 1.3 / 40;  // metres a second
  std::vector<std::string> notes;
  const std::string mean = "People move at " + rounded(speeds.mean()) + " m/s on average: ";
  if (speeds.mean() > fastest_crowd)
    notes.push_back(mean + "is the unit of length smaller than metres, or the frame rate lower?");
  else if (speeds.fastest > fastest_step)
    notes.push_back("Person " + std::to_string(speeds.person) + " moves at " + rounded(speeds.fastest) +
                    " m/s to frame " + std::to_string(speeds.frame) +
                    ", the fastest of all: is that position right?");
  if (speeds.way > 0 && speeds.mean() < slowest_crowd)
    notes.push_back(mean + "do they stand, or is the frame rate higher?");
  if (walls != nullptr && walls->segment_count() == 0) notes.emplace_back("The walls have no segment.");
  return notes;
}

}  // namespace

void require_people(std::span<const NamedMotion> named, const CheckOptions& options) {
  if (options.bodies.empty() && options.baked == nullptr) return;
  for (const NamedMotion& motion : named)
    if (!motion.body.empty())
      throw TrajectoryError(motion.place + ": body " + trajectory::shown(motion.body) +
                            " is an outline, which neither --bodies spheres nor a baked set takes");
}

OverlapCount& OverlapCount::operator+=(const OverlapCount& other) {
  people += other.people, guessed += other.guessed;
  overlapping += other.overlapping, in_walls += other.in_walls;
  near_pairs += other.near_pairs, overlapping_pairs += other.overlapping_pairs;
  for (std::size_t k = 0; k < discs.size(); ++k)
    discs[k] += other.discs[k], disc_pairs[k] += other.disc_pairs[k];
  return *this;
}

CheckSummary check(TrajectoryReader& reader, const CheckOptions& options,
                   const std::function<void(const CheckedFrame&, const ShapeSet&)>& seen) {
  const FloatingPointStateGuard floats;
  const double fps = reader.info().fps;
  WalkerReader walkers(reader, options.facing);
  Checker checker(reader.info(), options, seen);
  FrameBlock now, next;
  bool at_end = now.read(walkers, options.people_at_once, {});
  while (!at_end) {
    std::future<bool> next_is_last = std::async(std::launch::async, [&] {
      const FloatingPointStateGuard of_thread;
      return next.read(walkers, options.people_at_once, now);
    });
    checker.check(now, false, fps);  // where this throws, the future waits for the thread
    at_end = next_is_last.get();
    std::swap(now, next);
  }
  if (now.frames() > 0) checker.check(now, true, fps);
  CheckSummary summary = checker.finish(walkers.people());
  summary.notes = notes_on(walkers.speeds(), options.walls);
  return summary;
}

}  // namespace bch::detail
