// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/recordings/recording_check.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <numbers>

#include <bch/outline_builder.hpp>

#include "bench/base/exit_codes.hpp"
#include "bench/base/text.hpp"
#include "bench/base/wkt_input.hpp"
#include "bench/characters/characters.hpp"
#include "kernel/recordings/baked_library.hpp"
#include "kernel/recordings/walker_bodies.hpp"

namespace bch::cli {
namespace {

/// Errors:  throws UsageError.
double metres_of(const std::string& unit) {
  if (unit == "m") return 1;
  if (unit == "cm") return 0.01;
  if (unit == "mm") return 0.001;
  const std::optional<double> metres = parse_number(unit);
  if (!metres || !(*metres > 0 && *metres <= 1e6))
    throw UsageError(fmt::format("--unit: '{}' is neither m, cm or mm nor a length in metres", unit));
  return *metres;
}

detail::TrajectoryOptions trajectory_options(const CheckInput& input) {
  detail::TrajectoryOptions wanted;
  if (input.fps > 0) wanted.fps = input.fps;
  if (!input.unit.empty()) wanted.unit = metres_of(input.unit);
  if (!input.columns.empty()) wanted.columns = input.columns;
  return wanted;
}

/// The floor to walk on, of an option's file or of the recording.
std::string floor_of(const CheckInput& input, const detail::TrajectoryInfo& info) {
  return input.walls.empty() ? info.geometry : read_wkt(input.walls);
}

/// The walls about a floor, where there is one.
std::optional<ObstacleSet> walls_of(const CheckInput& input, const std::string& floor) {
  if (!input.walls.empty()) return obstacles_of(input.walls, floor, Polygons::walkable);
  if (floor.empty()) return std::nullopt;
  try {
    return obstacles_from_wkt(floor, Polygons::walkable);
  } catch (const std::invalid_argument& error) {
    throw InputError(input.file + ": its geometry: " + error.what());
  }
}

/// The baked set that people have their shapes of, if that is asked for.
/// Errors:  throws UsageError where something else is asked for beside it, or where only it would have an effect.
std::optional<BakedShapes> baked_of(const CheckInput& input) {
  if (std::none_of(input.characters.begin(), input.characters.end(), is_baked)) {
    if (!input.clip_speeds.empty() || input.facing != 0)
      throw UsageError("--clip-speed and --facing are for a baked set, --character NAME.bch");
    return std::nullopt;
  }
  const std::string& file = input.characters[0];
  if (input.spheres() > 0)
    throw UsageError(file + ": a baked set has outlines, which --bodies spheres does not use");
  if (input.characters.size() > 1)
    throw UsageError("--character: " + file + " and others: a baked set has all characters of a check");
  if (!input.shapes.clips.empty() || input.depth != "all")
    throw UsageError("--clips and --depth: " + file + " is baked already");
  if (!input.bodies.empty()) throw UsageError("--body: " + file + " is a baked set, which takes no others");
  return load_baked(file);
}

std::vector<detail::ClipSpeed> clip_speeds_of(const CheckInput& input) {
  std::vector<detail::ClipSpeed> speeds;
  for (const std::string& text : input.clip_speeds) {
    const std::size_t equals = std::min(text.rfind('='), text.size());
    const std::optional<double> speed =
        equals == text.size() ? std::nullopt : parse_number(text.substr(equals + 1));
    if (!speed || !(*speed >= 0 && *speed <= 20))
      throw UsageError(
          fmt::format("--clip-speed: '{}' is not a clip and a speed of 0 to 20 m/s, as walk=1.3", text));
    speeds.push_back({text.substr(0, equals), *speed});
  }
  return speeds;
}

/// Characters of one's own.
detail::CharacterLibrary library_of(const CheckInput& input, const std::optional<BakedShapes>& baked) {
  detail::CharacterLibrary library;
  if (baked) {
    try {
      return detail::baked_library(*baked, input.characters[0], clip_speeds_of(input));
    } catch (const std::invalid_argument& error) {
      throw InputError(error.what());
    }
  }
  std::vector<LoadedCharacter> characters = load_characters(input.characters, input.shapes.import_options());
  const std::vector<std::string> notes = notes_of(characters);
  for (LoadedCharacter& loaded : characters) {
    try {
      library.push_back(detail::character_entry(std::move(loaded.character), file_name(loaded)));
    } catch (const std::invalid_argument& error) {
      throw InputError(error.what());
    }
  }
  if (!library.empty())
    library[0].assumptions.insert(library[0].assumptions.begin(), notes.begin(), notes.end());
  return library;
}

/// What a recording says of itself, and what was found out about the characters.
detail::TrajectoryInfo info_of(const CheckInput& input, const detail::TrajectoryReader& reader,
                               const OpenedCheck& opened) {
  const detail::CharacterLibrary& library = opened.library;
  detail::TrajectoryInfo info = reader.info();
  if (opened.baked)
    info.assumptions.push_back(
        fmt::format("{}: people face {:g} degrees from +x (--facing)", input.characters[0], input.facing));
  for (const auto& member : library)
    info.assumptions.insert(info.assumptions.end(), member.assumptions.begin(), member.assumptions.end());
  return info;
}

/// Bodies of spheres of the library, or of pedestrians, of whom only the number of spheres can be wrong.
std::vector<BodyModel> bodies_of(detail::CharacterLibraryView library, std::uint32_t spheres) try {
  return detail::body_models(library, spheres);
} catch (const std::invalid_argument& error) {
  if (!library.empty()) throw InputError(error.what());
  throw UsageError(
      fmt::format("--spheres: expected 64, 128, 256 or 512 of built-in pedestrians, found {}", spheres));
}

/// Reads what a body that does not walk covers: the outline of a model, or polygons.
detail::Footprint footprint_of(const std::string& name, const std::string& file) try {
  return detail::footprint_from_wkt(
      name, file.ends_with(".wkt") ? read_wkt(file) : to_wkt(outline(load_character(file, {}).character)));
} catch (const std::invalid_argument& error) {
  throw InputError(fmt::format("{}: {}", file, printable_line(error.what())));
}

/// Takes --body apart: the name and the file.
/// Errors:  throws UsageError.
std::pair<std::string, std::string> named_file(const std::string& text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  std::pair<std::string, std::string> parts{text.substr(0, equals),
                                            text.substr(std::min(equals + 1, text.size()))};
  if (parts.first.empty() || parts.second.empty())
    throw UsageError(fmt::format("--body: '{}' is not a name and a file, as cart=cart.wkt", text));
  return parts;
}

std::vector<detail::Footprint> footprints_of(const CheckInput& input) {
  std::vector<detail::Footprint> footprints;
  for (const std::string& body : input.bodies) {
    const auto [name, file] = named_file(body);
    footprints.push_back(footprint_of(name, file));
  }
  return footprints;
}

/// When a file was written; empty where that is not known.
std::string date_of(const std::string& file) {
  std::error_code error;
  const auto time = std::filesystem::last_write_time(file, error);
  if (error) return {};
  const auto since_1970 = std::chrono::duration_cast<std::chrono::seconds>(
      std::chrono::file_clock::to_sys(time).time_since_epoch());
  return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(static_cast<std::time_t>(since_1970.count())));
}

/// Segments, where they are asked for and there.
Leaves leaves_of(const CheckInput& input, const std::optional<BakedShapes>& baked) {
  const bool has_segments = !baked || baked->set.exact_leaves();
  return input.leaves == "discs" || !has_segments ? Leaves::discs : Leaves::segments;
}

}  // namespace

std::vector<std::string> CheckInput::files() const {
  std::vector<std::string> files = shapes.inputs(characters);
  files.insert(files.end(), {file, truth, walls});
  for (const std::string& body : bodies) files.push_back(named_file(body).second);
  return files;
}

void CheckInput::require_fitting(const CLI::App& command) const {
  if (!kind.are_spheres(command)) return;
  require_absent(command, {"--depth", "--leaves", "--body"}, "belongs to outlines, not to --bodies spheres");
}

void CheckInput::require_spheres(const CLI::App& command) {
  if (command.count("--bodies") == 0) kind.bodies = "spheres";
  if (kind.bodies != "spheres") throw UsageError("--resolve: moves bodies of spheres, not --bodies outlines");
}

void CheckInput::add_to(CLI::App& command) {
  const OptionAdder add(command);
  add("FILE", file, "", "Recording to check")->required();
  add("--fps", fps, "N", "Frames per second, instead of the rate that the file states",
      number_between(1e-3, 1e4));
  add("--columns", columns, "NAMES",
      "Names of the columns in order, instead of the file's header; skip ignores one: frame,id,x,skip,y");
  add("--unit", unit, "UNIT", "Unit of length, instead of the file's: m, cm, mm, or a number of metres");
  add("--walls", walls, "FILE.wkt", "Walkable area as well-known text (WKT), instead of the file's own");
  add("--truth", truth, "FILE",
      "Count the people who collide with others as these went in this recording (Col-II)");
  add_bodies_to(command);
  add("--depth", depth, "N",
      "Level of detail: depth 0, 1, 2 ... in the tree of discs of an outline, or all [all]");
  add_leaves_option(command, leaves, 4);
  add("--max-distance", max_distance, "M",
      "In --pairs, also write pairs with a gap of at most M metres [0: overlaps only]",
      number_between(0, 10));
  add_max_pairs_option(command, max_pairs, "people near each other in a frame, or in 4096 rows", "person");
}

void CheckInput::add_bodies_to(CLI::App& command) {
  const OptionAdder add(command);
  kind.add_to(command);
  CLI::Option* const character =
      add("--character", characters, "FILE",
          "Characters, assigned by id or named by rows (repeatable), or one baked set [built-in]")
          ->allow_extra_args(false);
  add("--clips", shapes.clips, "FILE",
      "Add the clips of this file to the characters, matched by bone name (repeatable)")
      ->allow_extra_args(false)
      ->needs(character);
  add("--body", bodies, "NAME=FILE",
      "Shape of rows whose body is NAME: polygons (.wkt), or a model seen from above (repeatable)")
      ->allow_extra_args(false);
  add("--clip-speed", clip_speeds, "CLIP=M/S",
      "For a baked set: walking speed in a clip, or 0 if people stand in it (repeatable)")
      ->allow_extra_args(false)
      ->needs(character);
  add("--facing", facing, "DEGREES",
      "For a baked set: direction that its people face, counter-clockwise from +x [0]",
      number_between(-360, 360))
      ->needs(character);
}

void add_outputs_to(CLI::App& command, CheckOutputs& outputs) {
  const OptionAdder add(command);
  add("--events", outputs.events, "FILE.csv",
      "Write one line per event, an overlap in successive frames: ids, begin, end, largest depth");
  add("--frames", outputs.frames, "FILE.csv",
      "Write one line per frame: number of people, density, overlaps");
  add("--pairs", outputs.pairs, "FILE.csv",
      "Write one line per overlapping pair of each frame: depth and direction");
  add("--measures", outputs.measures, "FILE.csv",
      "Write one line per person of each frame: densities, clearance, time to collision, intrusion ...");
  add("--conflicts", outputs.conflicts, "FILE.csv",
      "For each frame, write one line per pair of people who overlap or will collide within 5 s");
  add("--json", outputs.json, "FILE.json", "Write the summary and all events as JSON");
  add("--fail-above", outputs.fail_above, "P",
      "Exit with code 1 if more than P percent of person-seconds are in overlap [never]",
      number_between(0, 100));
}

OpenedCheck::OpenedCheck(const CheckInput& input)
    : baked(baked_of(input)),
      library(library_of(input, baked)),
      footprints(footprints_of(input)),
      reader(detail::open_trajectory(input.file, trajectory_options(input))),
      walls(walls_of(input, floor_of(input, reader->info()))),
      recording{input.file,
                info_of(input, *reader, *this),
                input.spheres(),
                baked ? baked->set.depths().back() : parse_depth("--depth", input.depth),
                leaves_of(input, baked),
                static_cast<std::uint32_t>(library.size()),
                baked.has_value(),
                walls ? &*walls : nullptr,
                input.date.empty() ? date_of(input.file) : input.date,
                {}} {
  if (!input.truth.empty()) truth = detail::open_trajectory(input.truth, trajectory_options(input));
}

detail::CheckOptions OpenedCheck::options(const CheckInput& input) {
  detail::CheckOptions how;
  if (recording.spheres > 0) bodies = bodies_of(library, recording.spheres);
  how.bodies = bodies;
  how.plan = {.depths = {recording.depth}};
  how.leaves = recording.leaves;
  how.library = library;
  how.footprints = footprints;
  how.baked = baked ? &baked->set : nullptr;
  how.facing = input.facing * std::numbers::pi / 180;
  how.max_distance = input.max_distance;
  how.max_pairs = input.max_pairs;
  how.walls = walls ? &*walls : nullptr;
  // Bodies of spheres are posed in the exact time, and not kept.
  how.coarse = recording.spheres > 0 || recording.info.rows < detail::coarse_from ? 1 : 3;
  return how;
}

detail::CheckSummary OpenedCheck::check(
    const detail::CheckOptions& options,
    const std::function<void(const detail::CheckedFrame&, const ShapeSet&)>& seen) const {
  const auto report = [](const std::vector<std::string>& notes) {
    for (const std::string& note : notes) fmt::print(stderr, "note: {}\n", note);
  };
  report(recording.info.notes);
  try {
    detail::CheckSummary summary = detail::check(*reader, options, seen);
    report(summary.notes);
    return summary;
  } catch (const detail::TooManyPairs& error) {
    throw InputError(recording.file + ": " + error.what() + "; --max-pairs raises the limit");
  }
}

}  // namespace bch::cli
