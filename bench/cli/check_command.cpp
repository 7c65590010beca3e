// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>

#include <bch/obstacles.hpp>

#include "bench/base/exit_codes.hpp"
#include "bench/base/number.hpp"
#include "bench/base/output.hpp"
#include "bench/base/threads.hpp"
#include "bench/base/wkt_input.hpp"
#include "bench/cli/check_output.hpp"
#include "bench/cli/commands.hpp"
#include "bench/cli/options.hpp"
#include "bench/cli/recording_page.hpp"

namespace bch::cli {
namespace {

struct CheckCommandOptions {
  std::string file, walls, unit, columns, events, frames, pairs, json, html;
  double fps = 0;  ///< 0: what the file says
  double max_distance = 0;
  double fail_above = 100;  ///< percent of person-seconds
  ShapeOptions shapes;      ///< of which slices alone are asked for
  std::uint32_t threads = 0;
};

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

detail::TrajectoryOptions trajectory_options(const CheckCommandOptions& options) {
  detail::TrajectoryOptions wanted;
  if (options.fps > 0) wanted.fps = options.fps;
  if (!options.unit.empty()) wanted.unit = metres_of(options.unit);
  if (!options.columns.empty()) wanted.columns = options.columns;
  return wanted;
}

/// The floor to walk on, of an option's file or of the recording.
std::string walls_text(const CheckCommandOptions& options, const detail::TrajectoryInfo& info) {
  if (options.walls.empty()) return info.geometry;
  std::ifstream stream(options.walls, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The walls of an option, or those of the recording.
std::optional<ObstacleSet> walls_of(const CheckCommandOptions& options, const detail::TrajectoryInfo& info) {
  if (!options.walls.empty()) return read_obstacles(options.walls, Polygons::walkable);
  if (info.geometry.empty()) return std::nullopt;
  try {
    return obstacles_from_wkt(info.geometry, Polygons::walkable);
  } catch (const std::invalid_argument& error) {
    throw InputError(options.file + ": its geometry: " + error.what());
  }
}

void run_check(const CheckCommandOptions& options) {
  require_outputs({{"--events", options.events},
                   {"--frames", options.frames},
                   {"--pairs", options.pairs},
                   {"--json", options.json},
                   {"--html", options.html}},
                  {options.file, options.walls});
  const Threads threads(options.threads);
  const auto reader = detail::open_trajectory(options.file, trajectory_options(options));
  const std::optional<ObstacleSet> walls = walls_of(options, reader->info());
  detail::CheckOptions how;
  how.plan.slices = options.shapes.planes();
  how.max_distance = options.max_distance;
  how.walls = walls ? &*walls : nullptr;
  how.coarse = reader->info().rows < detail::coarse_from ? 1 : 3;
  const CheckedRecording recording{options.file, reader->info(),
                                   static_cast<std::uint32_t>(how.plan.slices.size() + 1), walls.has_value(),
                                   walls_text(options, reader->info())};

  StreamedTable frames(options.frames, frame_columns), pairs(options.pairs, pair_columns),
      events(options.events, event_columns);
  std::optional<RecordingPage> page;
  if (!options.html.empty()) page.emplace(recording);
  const detail::CheckSummary summary =
      detail::check(*reader, how, [&](const detail::CheckedFrame& frame, const ShapeSet& shapes) {
        if (frames) frames.add(frame_line(frame));
        if (pairs) pairs.add(pair_lines(frame));
        if (page) page->add(frame, shapes);
      });

  for (const detail::OverlapEvent& event : summary.events)
    if (events) events.add(event_line(event, recording.info.fps));
  frames.commit(), pairs.commit(), events.commit();
  write_check_json(options.json, recording, summary);
  if (page) write_file(options.html, std::move(*page).finish(summary));
  write_standard_output(check_text(recording, summary));
  if (percent_in_overlap(summary) > options.fail_above)
    throw CheckFailed(fmt::format("{}: {:.2f} % of person-seconds in overlap, more than {:g} %", options.file,
                                  percent_in_overlap(summary), options.fail_above));
}

}  // namespace

std::function<void()> add_check_command(CLI::App& program) {
  const auto options = std::make_shared<CheckCommandOptions>();
  CLI::App& command =
      *program.add_subcommand("check", "Put bodies on a recorded or simulated crowd: who runs into whom");
  command.footer(
      "Reads JuPedSim's SQLite, PeTrack and Juelich text, the Pedestrian Dynamics Data Archive's HDF5, "
      "Pathfinder's CSV,\n"
      "TrajNet++ and ETH/UCY, and plain CSV with columns id, frame or time, x, y; by their content. What a "
      "file does not\n"
      "say is asked for by an option, and what was assumed is printed.\n"
      "On every row stands a pedestrian of the person's height, in the stride of his speed, under his head. "
      "Two people\n"
      "overlap where their outlines do, or, with --slices, where they do at the same height.\n"
      "Exit code 1 where more than --fail-above of the person-seconds are in overlap, else 0 whatever is "
      "found.\n"
      "Example: bch check trajectories.sqlite --slices 0.4,0.85,1.05 --events events.csv");
  command.add_option("FILE", options->file, "Trajectories")->type_name("")->required();
  command.add_option("--fps", options->fps, "Frames a second, where the file does not say")
      ->type_name("N")
      ->check(number_between(1e-3, 1e4));
  command
      .add_option("--columns", options->columns,
                  "Of text and CSV without a header: their names, such as frame,id,x,y")
      ->type_name("NAMES");
  command
      .add_option("--unit", options->unit,
                  "Of lengths, where the file does not say: m, cm, mm, or how many metres")
      ->type_name("UNIT");
  command
      .add_option("--walls", options->walls,
                  "The floor to walk on, in well-known text, instead of the file's own")
      ->type_name("FILE.wkt");
  command
      .add_option("--slices", options->shapes.slices,
                  "Cut bodies at these heights, metres, into slabs [whole bodies]")
      ->type_name("H,H...");
  command
      .add_option("--max-distance", options->max_distance,
                  "Metres: --pairs also has gaps up to that [0: overlaps alone]")
      ->type_name("M")
      ->check(number_between(0, 10));
  command
      .add_option("--events", options->events,
                  "Write a line for each overlap: who, from when to when, how deep")
      ->type_name("FILE.csv");
  command.add_option("--frames", options->frames, "Write a line for each frame: people, density, overlaps")
      ->type_name("FILE.csv");
  command.add_option("--pairs", options->pairs, "Write a line for each pair of a frame that overlaps")
      ->type_name("FILE.csv");
  command.add_option("--json", options->json, "Write the summary and all events as JSON")
      ->type_name("FILE.json");
  command.add_option("--html", options->html, "Write a page that plays the recording, without a network")
      ->type_name("FILE.html");
  command
      .add_option("--fail-above", options->fail_above,
                  "Percent of person-seconds in overlap from which on the check fails")
      ->type_name("P")
      ->check(number_between(0, 100));
  add_threads_option(command, options->threads);
  return [options] { run_check(*options); };
}

}  // namespace bch::cli
