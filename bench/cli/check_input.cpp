// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/cli/check_input.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "bench/base/exit_codes.hpp"
#include "bench/base/number.hpp"
#include "bench/base/wkt_input.hpp"
#include "bench/characters/characters.hpp"

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
std::string walls_text(const CheckInput& input, const detail::TrajectoryInfo& info) {
  if (input.walls.empty()) return info.geometry;
  std::ifstream stream(input.walls, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The walls of an option, or those of the recording.
std::optional<ObstacleSet> walls_of(const CheckInput& input, const detail::TrajectoryInfo& info) {
  if (!input.walls.empty()) return read_obstacles(input.walls, Polygons::walkable);
  if (info.geometry.empty()) return std::nullopt;
  try {
    return obstacles_from_wkt(info.geometry, Polygons::walkable);
  } catch (const std::invalid_argument& error) {
    throw InputError(input.file + ": its geometry: " + error.what());
  }
}

/// Characters of one's own.
detail::Cast cast_of(const CheckInput& input) {
  detail::Cast cast;
  for (LoadedCharacter& loaded : load_characters(input.characters, input.shapes.import_options())) {
    try {
      cast.push_back(detail::cast_member(std::move(loaded.character), file_name(loaded)));
    } catch (const std::invalid_argument& error) {
      throw InputError(error.what());
    }
  }
  return cast;
}

/// What a recording says of itself, and what was found out about the characters.
detail::TrajectoryInfo info_of(const detail::TrajectoryReader& reader, const detail::Cast& cast) {
  detail::TrajectoryInfo info = reader.info();
  for (const auto& member : cast)
    info.assumptions.insert(info.assumptions.end(), member.assumptions.begin(), member.assumptions.end());
  return info;
}

}  // namespace

std::vector<std::string> CheckInput::files() const {
  std::vector<std::string> files = shapes.inputs(characters);
  files.insert(files.end(), {file, walls});
  return files;
}

void CheckInput::add_to(CLI::App& command) {
  command.add_option("FILE", file, "Trajectories")->type_name("")->required();
  command.add_option("--fps", fps, "Frames a second, where the file does not say")
      ->type_name("N")
      ->check(number_between(1e-3, 1e4));
  command
      .add_option("--columns", columns, "Of text and CSV without a header: their names, such as frame,id,x,y")
      ->type_name("NAMES");
  command
      .add_option("--unit", unit, "Of lengths, where the file does not say: m, cm, mm, or how many metres")
      ->type_name("UNIT");
  command.add_option("--walls", walls, "The floor to walk on, in well-known text, instead of the file's own")
      ->type_name("FILE.wkt");
  CLI::Option* const character =
      command
          .add_option("--character", characters,
                      "People have the bodies of these characters, by their ids (repeatable) [built-in]")
          ->type_name("FILE")
          ->allow_extra_args(false);
  command
      .add_option("--clips", shapes.clips,
                  "Add the clips of this file to the characters, matched by bone name (repeatable)")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->needs(character);
  command
      .add_option("--slices", shapes.slices, "Cut bodies at these heights, metres, into slabs [whole bodies]")
      ->type_name("H,H...");
  command.add_option("--depth", depth, "Depth of the bodies' hierarchies: 0, 1, 2 ... or all [all]")
      ->type_name("N");
  add_leaves_option(command, leaves, 2);
  command
      .add_option("--max-distance", max_distance,
                  "Metres: --pairs also has gaps up to that [0: overlaps alone]")
      ->type_name("M")
      ->check(number_between(0, 10));
}

void add_outputs_to(CLI::App& command, CheckOutputs& outputs) {
  command
      .add_option("--events", outputs.events,
                  "Write a line for each overlap: who, from when to when, how deep")
      ->type_name("FILE.csv");
  command.add_option("--frames", outputs.frames, "Write a line for each frame: people, density, overlaps")
      ->type_name("FILE.csv");
  command.add_option("--pairs", outputs.pairs, "Write a line for each pair of a frame that overlaps")
      ->type_name("FILE.csv");
  command.add_option("--json", outputs.json, "Write the summary and all events as JSON")
      ->type_name("FILE.json");
  command
      .add_option("--fail-above", outputs.fail_above,
                  "Percent of person-seconds in overlap from which on the check fails")
      ->type_name("P")
      ->check(number_between(0, 100));
}

OpenedCheck::OpenedCheck(const CheckInput& input)
    : cast(cast_of(input)),
      reader(detail::open_trajectory(input.file, trajectory_options(input))),
      walls(walls_of(input, reader->info())),
      recording{input.file,
                info_of(*reader, cast),
                static_cast<std::uint32_t>(input.shapes.planes().size() + 1),
                parse_depth("--depth", input.depth),
                input.leaves == "discs" ? Leaves::discs : Leaves::segments,
                static_cast<std::uint32_t>(cast.size()),
                walls.has_value(),
                walls_text(input, reader->info())} {}

detail::CheckOptions OpenedCheck::options(const CheckInput& input) const {
  detail::CheckOptions how;
  how.plan = {.depths = {recording.depth}, .slices = input.shapes.planes()};
  how.leaves = recording.leaves;
  how.cast = cast;
  how.max_distance = input.max_distance;
  how.walls = walls ? &*walls : nullptr;
  how.coarse = recording.info.rows < detail::coarse_from ? 1 : 3;
  return how;
}

}  // namespace bch::cli
