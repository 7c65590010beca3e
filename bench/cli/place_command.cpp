// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/base/exit_codes.hpp"
#include "bench/base/options.hpp"
#include "bench/base/output.hpp"
#include "bench/base/progress.hpp"
#include "bench/base/stopwatch.hpp"
#include "bench/base/text.hpp"
#include "bench/base/wkt_input.hpp"
#include "bench/characters/baking.hpp"
#include "bench/characters/body_models.hpp"
#include "bench/characters/characters.hpp"
#include "bench/cli/commands.hpp"
#include "bench/cli/place.hpp"
#include "kernel/recordings/character_library.hpp"
#include "kernel/runtime/tasks.hpp"

namespace bch::cli {
namespace {

/// Returns how fast a clip of a character goes, 0 where it does not walk straight on.
double speed_of(const detail::CharacterEntry& member, std::uint32_t clip) {
  return clip < member.clips.size() ? member.clips[clip].speed : 0;
}

/// Characters without a walk stand where they are.
detail::CharacterEntry member_of(const LoadedCharacter& loaded) {
  try {
    return detail::character_entry(loaded.character, file_name(loaded));
  } catch (const std::invalid_argument&) {
    detail::CharacterEntry member{};
    member.name = file_name(loaded);
    member.character = loaded.character;
    return member;
  }
}

/// A clip that is too short is played over and over.
bench::PlacedClip placed_clip(const PlaceOptions& options, const detail::CharacterEntry& member,
                              const BodyModel& model, std::uint32_t clip) {
  const Clip& played = member.character.clips[clip];
  AnimateOptions how;
  if (double{played.seconds} < options.placing.seconds) how.loops = true;
  const AnimatedDiscs discs = animate_clip(model, member.name, clip, how);
  return {member.name,
          played.name,
          options.speed.value_or(speed_of(member, clip)),
          static_cast<double>(played.seconds),
          member.height,
          AnimatedShape(discs)};
}

/// Builds the bodies of all clips, each by a task of its own. Adds the notes of imports to a text.
std::vector<bench::PlacedClip> clips_of(const PlaceOptions& options, std::string& notes) {
  for (const std::string& file : options.characters)
    if (is_baked(file))
      throw InputError(
          file +
          ": is a baked set, which does not tell how tall people are and how fast they walk in a "
          "clip; give --character the characters that it was made of");
  const std::vector<LoadedCharacter> characters = load_characters(options.characters, {});
  notes += notes_text(characters);
  std::vector<detail::CharacterEntry> members;
  for (const LoadedCharacter& loaded : characters) members.push_back(member_of(loaded));
  const std::vector<ClipOf> wanted =
      find_clips<detail::CharacterEntry>(options.clip_names, members, "--clip");
  const std::vector<BodyModel> models = make_models(characters, animated_spheres);
  std::vector<std::optional<bench::PlacedClip>> built(wanted.size());
  Progress progress("animating clips", wanted.size());
  progress.show();
  detail::run_each(wanted.size(), [&](std::size_t i) {
    built[i].emplace(
        placed_clip(options, members[wanted[i].character], models[wanted[i].character], wanted[i].clip));
    progress.advance();
  });
  std::vector<bench::PlacedClip> clips;
  for (std::optional<bench::PlacedClip>& clip : built) clips.push_back(std::move(*clip));
  return clips;
}

void run_place(const PlaceOptions& options) {
  std::vector<std::string> inputs = options.characters;
  for (const std::string& file : {options.obstacles, options.paths})
    if (!file.empty()) inputs.push_back(file);
  require_outputs({{"--csv", options.csv}, {"--json", options.json}}, inputs);
  PlaceRun run{options, options.placing, {}, {}, 0, {}, 0};
  bench::PlacingOptions& placing = run.area;
  GivenPaths given;
  if (!options.paths.empty()) {
    given = read_paths(options.paths, placing.seconds);
    placing.paths = given.paths, placing.width = given.width, placing.depth = given.depth;
    run.assumptions = given.assumptions;
  }
  std::optional<ObstacleSet> obstacles;
  if (!options.obstacles.empty()) {
    obstacles = read_obstacles(options.obstacles, Polygons::solid);
    placing.obstacles = &*obstacles;
  }
  const bench::Stopwatch watch(2);
  std::string notes;
  run.clips = clips_of(options, notes);
  run.build_seconds = watch.nanoseconds() * 1e-9;
  const bench::Stopwatch search(2);
  try {
    run.placement = bench::place(run.clips, placing);
  } catch (const std::invalid_argument& error) {
    throw InputError(error.what());
  }
  run.search_seconds = search.nanoseconds() * 1e-9;
  if (!options.csv.empty()) write_file(options.csv, csv_report(run));
  write_json(options.json, json_report(run));
  write_standard_output(text_report(run) + notes);
}

}  // namespace

std::function<void()> add_place_command(CLI::App& program) {
  const auto options = std::make_shared<PlaceOptions>();
  CLI::App& command =
      *program.add_subcommand("place", "Fill an area with moving people who never touch each other");
  command.footer(
      R"(People walk along arcs inside the area, from random positions and at random times of their clips.
If a clip does not walk, they stand. A clip that is shorter than --seconds is played over and over,
its end followed by its beginning. A candidate who would touch anybody at any time is left out.
With --paths each person of a recording is a candidate once, in random order, on his path from time 0
on. A person whose path ends before --seconds stands at its end. The area is the rectangle of all paths.
The file has to state times or its frame rate, and its columns have to be named or of a known format.
Example: bch place --clip walk --seconds 5 --csv placed.csv)");
  const OptionAdder add(command);
  add("--character", options->characters, "FILE",
      std::string(character_help) + " (repeatable) [male, female]")
      ->allow_extra_args(false);
  add("--clip", options->clip_names, "NAME", "Name of a clip that people play (repeatable) [walk]")
      ->allow_extra_args(false);
  CLI::Option* const speed =
      add("--speed", options->speed, "M/S",
          "Speed of everybody, metres per second [that of the clip, 0 if it does not walk]",
          number_between(0, 20));
  add("--obstacles", options->obstacles, "FILE.wkt",
      "Keep people out of these walls and polygons, in well-known text");
  CLI::Option* const paths =
      add("--paths", options->paths, "FILE",
          "Recording, such as CSV with id,time,x,y[,heading], whose paths people take [random arcs]");
  paths->excludes(speed);
  add("--width", options->placing.width, "METRES", "Width of the area, along x [10 m]",
      number_between(1, 1000))
      ->excludes(paths);
  add("--depth", options->placing.depth, "METRES", "Depth of the area, along y [10 m]",
      number_between(1, 1000))
      ->excludes(paths);
  add("--seconds", options->placing.seconds, "SECONDS", "Time for which people move [10 s]",
      number_between(0.1, 600));
  add("--tries", options->placing.tries, "N", "Stop after N candidates in a row that found no room [500]",
      whole_between(1, 1'000'000));
  add_seed_option(command, options->placing.seed, "positions, paths and times");
  add("--fps", options->fps, "N", "Rows of --csv per second [30]", number_between(1, 1000));
  add("--csv", options->csv, "FILE", "Write where everybody is at each time, for bch check");
  add("--json", options->json, "FILE", "Write the table and everybody's path");
  return [options] { run_place(*options); };
}

}  // namespace bch::cli
