// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <span>

#include "kernel/c_api/arguments.hpp"
#include "kernel/c_api/handles.hpp"
#include "kernel/c_api/objects.hpp"
#include "kernel/c_api/obstacles.hpp"
#include "kernel/c_api/recordings.hpp"
#include "kernel/recordings/baked_library.hpp"
#include "kernel/recordings/check.hpp"
#include "kernel/recordings/page/recording_page.hpp"
#include "kernel/recordings/truth_collisions.hpp"
#include "kernel/recordings/walker_bodies.hpp"

namespace bch::c_api {
namespace {

using namespace bch::detail;

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

void add_measures(const CheckedFrame& frame, bch_check& check) {
  for (std::size_t i = 0; i < frame.measures.size(); ++i) {
    const MeasuredPerson& of = frame.measures[i];
    check.measures.push_back({frame.frame, frame.people[i].walker.id, frame.people[i].density,
                              of.voronoi_density, of.clearance, of.disc_clearance, of.time, of.disc_time,
                              of.encroachment, of.intrusion, of.disc_intrusion,
                              MeasuredPerson::avoidance(of.time), MeasuredPerson::avoidance(of.disc_time), 0,
                              of.intimate, of.personal, of.collides, of.disc_collides});
  }
  for (const MeasuredPair& pair : frame.measured_pairs)
    check.conflicts.push_back({frame.frame, pair.first, pair.second, pair.distance, pair.clearance,
                               pair.disc_clearance, pair.time, pair.disc_time, 0});
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
  to.colliding_people = of.colliding;
  to.disc_colliding_people = of.disc_colliding;
  to.overlap_events = of.overlap_events;
  to.pass_events = of.passings;
  to.wall_events = of.wall_events;
  return to;
}

/// The walls of the caller, or those of the recording.
std::optional<ObstacleSet> own_walls(const bch_check_options& options, const TrajectoryInfo& info) {
  if (options.walls != nullptr || options.without_walls != 0 || info.geometry.empty()) return std::nullopt;
  return obstacles_from_wkt(info.geometry, Polygons::walkable);
}

/// The characters of a baked set.
CharacterLibrary baked_library_of(const bch_check_options& options) {
  if (options.character_count > 0)
    throw Failure(BCH_INVALID_ARGUMENT, "options->baked and options->characters are both given");
  const bch_shape_set& set = object_of(options.baked, "options->baked");
  if (set.own == nullptr)
    throw Failure(BCH_INVALID_ARGUMENT, "options->baked does not say which clips its shapes show");
  if (!(std::abs(options.facing) <= 2 * std::numbers::pi))
    throw Failure(BCH_INVALID_ARGUMENT,
                  "options->facing is " + std::to_string(options.facing) + "; expected within +-2 pi");
  std::vector<ClipSpeed> speeds;
  for (const bch_clip_speed& given :
       array_of(options.clip_speeds, options.clip_speed_count, "options->clip_speeds")) {
    required(given.clip, "options->clip_speeds");
    if (!(given.speed >= 0 && given.speed <= 20))
      throw Failure(BCH_INVALID_ARGUMENT,
                    "options->clip_speeds has " + std::to_string(given.speed) + "; expected 0 to 20 m/s");
    speeds.push_back({given.clip, given.speed});
  }
  return baked_library(*set.own, "options->baked", speeds);
}

/// The characters of the caller.
CharacterLibrary library_of(const bch_check_options& options) {
  if (options.baked != nullptr) return baked_library_of(options);
  if (options.character_count > 0) required(options.characters, "options->characters");
  CharacterLibrary library;
  for (const bch_character* character : std::span(options.characters, options.character_count)) {
    const bch_character& own = object_of(character, "options->characters");
    library.push_back(character_entry(*own.character, own.name));
  }
  return library;
}

/// The bodies that do not walk.
std::vector<Footprint> footprints_of(const bch_check_options& options) {
  std::vector<Footprint> footprints;
  for (const bch_footprint& given :
       array_of(options.footprints, options.footprint_count, "options->footprints")) {
    required(given.name, "options->footprints"), required(given.wkt, "options->footprints");
    try {
      footprints.push_back(footprint_from_wkt(given.name, given.wkt));
    } catch (const std::invalid_argument& error) {
      throw Failure(BCH_INVALID_ARGUMENT,
                    std::string("options->footprints: ") + given.name + ": " + error.what());
    }
  }
  return footprints;
}

/// What the page says of the recording; empty where none is asked for.
std::optional<CheckedRecording> recording_of(const bch_check_options& given, const TrajectoryInfo& info,
                                             const CheckOptions& options) {
  if (given.page == nullptr) return std::nullopt;
  const auto text = [](const char* of) { return std::string(of == nullptr ? "" : of); };
  const ShapeSet* const baked = options.baked;
  CheckedRecording recording{text(given.page->title),
                             info,
                             given.spheres,
                             baked == nullptr ? given.depth : baked->depths().back(),
                             baked != nullptr && !baked->exact_leaves() ? Leaves::discs : options.leaves,
                             static_cast<std::uint32_t>(options.library.size()),
                             baked != nullptr,
                             options.walls,
                             text(given.page->date),
                             text(given.page->options)};
  for (const CharacterEntry& member : options.library)
    recording.info.assumptions.insert(recording.info.assumptions.end(), member.assumptions.begin(),
                                      member.assumptions.end());
  return recording;
}

/// The bodies of spheres, or none.
std::vector<BodyModel> bodies_of(const bch_check_options& options, CharacterLibraryView library) {
  if (options.spheres == 0) return {};
  if (options.baked != nullptr)
    throw Failure(BCH_INVALID_ARGUMENT, "options->baked has outlines, which options->spheres does not use");
  if (options.depth != BCH_ALL_DEPTHS || options.leaves != BCH_SEGMENTS)
    throw Failure(BCH_INVALID_ARGUMENT,
                  "options->depth and options->leaves belong to outlines, not to options->spheres");
  return body_models(library, options.spheres);
}

/// Errors:  throws Failure where a recording is not at its beginning.
bch_trajectory& unread(bch_trajectory& trajectory, const std::string& name) {
  if (trajectory.is_read) throw Failure(BCH_INVALID_ARGUMENT, name + " has been read from; open it again");
  return trajectory;
}

}  // namespace

std::unique_ptr<bch_check> run_check(bch_trajectory& trajectory, const bch_check_options& given) {
  unread(trajectory, "trajectory");
  // The check reads ahead while the truth is read.
  if (given.truth == &trajectory)
    throw Failure(BCH_INVALID_ARGUMENT, "options->truth is trajectory; open its file once more");
  CheckOptions options;
  options.plan.depths = {given.depth};
  options.leaves = one_of(given.leaves, Leaves::segments, "options->leaves");
  if (!(given.max_distance >= 0 && given.max_distance <= 10))
    throw Failure(BCH_INVALID_ARGUMENT,
                  "options->max_distance is " + std::to_string(given.max_distance) + "; expected 0 to 10 m");
  options.max_distance = given.max_distance;
  options.max_pairs = given.max_pairs;
  const CharacterLibrary library = library_of(given);
  options.library = library;
  const std::vector<Footprint> footprints = footprints_of(given);
  options.footprints = footprints;
  options.draws = given.page != nullptr;
  options.measures = given.measures != 0;
  std::vector<BodyModel> bodies;
  on_threads(given.threads, [&] { bodies = bodies_of(given, library); });
  options.bodies = bodies;
  options.baked = given.baked == nullptr ? nullptr : &object_of(given.baked, "options->baked").set;
  options.facing = given.baked == nullptr ? 0 : given.facing;
  const std::optional<ObstacleSet> walls = own_walls(given, trajectory.reader->info());
  options.walls = given.walls != nullptr ? &object_of(given.walls, "options->walls").set
                  : walls                ? &*walls
                                         : nullptr;

  options.coarse = given.spheres > 0 || trajectory.reader->info().rows < coarse_from ? 1 : 3;
  auto made = std::make_unique<bch_check>();
  made->assumptions = trajectory.assumptions;
  made->notes = trajectory.notes;
  for (const CharacterEntry& member : library)
    for (const std::string& line : member.assumptions) made->assumptions += line + "\n";
  const TrajectoryInfo& info = trajectory.reader->info();
  const std::optional<CheckedRecording> recording = recording_of(given, info, options);
  std::optional<RecordingPage> page;
  if (recording) page.emplace(*recording);
  std::optional<TruthCollisions> truth;
  if (given.truth != nullptr) truth.emplace(*unread(*given.truth, "options->truth").reader, info, options);
  trajectory.is_read = true;
  if (truth) given.truth->is_read = true;
  on_threads(given.threads, [&] {
    const CheckSummary summary =
        check(*trajectory.reader, options, [&](const CheckedFrame& frame, const ShapeSet& shapes) {
          if (page) page->add(frame, shapes);
          if (truth) truth->add(frame);
          made->frames.push_back(frame_of(frame));
          for (const CheckedPair& pair : frame.pairs) made->pairs.push_back(pair_of(pair));
          add_measures(frame, *made);
          const auto done = static_cast<std::uint64_t>(frame.frame - info.first_frame),
                     total = static_cast<std::uint64_t>(info.last_frame - info.first_frame);
          if (given.progress != nullptr && given.progress(given.user, done, total) != 0)
            throw Failure(BCH_CANCELLED, "cancelled by the caller");
        });
    if (page) made->page = std::move(*page).finish(summary);
    made->summary = summary_of(summary, info);
    if (truth)
      made->summary.truth_frames = truth->frames(), made->summary.truth_colliding_people = truth->colliding(),
      made->summary.truth_disc_colliding_people = truth->disc_colliding();
    for (const std::string& line : summary.notes) made->notes += line + "\n";
    for (const OverlapEvent& event : summary.events) made->events.push_back(event_of(event));
    for (std::size_t k = 0; k < density_classes.size(); ++k) {
      const OverlapCount& of = summary.by_density[k];
      made->densities.push_back(
          {density_classes[k], of.people, of.overlapping, of.in_walls, of.near_pairs, of.overlapping_pairs});
    }
  });
  return made;
}

}  // namespace bch::c_api
