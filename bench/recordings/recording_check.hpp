// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include <bch/files.hpp>
#include <bch/obstacles.hpp>

#include "bench/base/options.hpp"
#include "bench/base/output.hpp"
#include "bench/base/output_file.hpp"
#include "bench/characters/body_models.hpp"
#include "kernel/recordings/check.hpp"
#include "kernel/recordings/page/checked_recording.hpp"
#include "kernel/recordings/truth_collisions.hpp"

namespace bch::cli {

using detail::CheckedRecording;

constexpr const char* frame_columns = "frame,seconds,people,density,overlapping,overlapping_pairs,in_walls\n";
constexpr const char* pair_columns = "frame,seconds,first,second,kind,depth,gap,x,y\n";
constexpr const char* measure_columns =
    "frame,seconds,id,density,voronoi_density,intimate,personal,clearance,disc_clearance,ttc,disc_ttc,pet,"
    "intrusion,disc_intrusion,avoidance,disc_avoidance,collides,disc_collides\n";
constexpr const char* conflict_columns =
    "frame,seconds,first,second,distance,clearance,disc_clearance,ttc,disc_ttc\n";
constexpr const char* event_columns = "first,second,kind,from,to,frames,worst,depth,x,y\n";

/// Names the files that the answers of a check go to; an empty name is none.
struct CheckOutputs {
  std::string events, frames, pairs, json, measures, conflicts;
  double fail_above = 100;  ///< percent of person-seconds

  std::vector<OutputOption> files() const;
  bool has_measures() const { return !measures.empty() || !conflicts.empty(); }
};

/// Represents the tables of a check.
struct CheckTables {
  StreamedFile frames, pairs, events, measures, conflicts;
  std::string json;

  explicit CheckTables(const CheckOutputs& outputs);
  void add(const detail::CheckedFrame& frame);
  /// Writes what is told of the whole, and gives all files their names.
  void finish(const CheckedRecording& recording, const detail::CheckSummary& summary,
              const detail::TruthCollisions* truth);
};

/// Returns the line of a frame, or of each of its pairs.
std::string frame_line(const detail::CheckedFrame& frame);
std::string pair_lines(const detail::CheckedFrame& frame);
/// Returns the lines of what is measured of people, or of pairs.
std::string measure_lines(const detail::CheckedFrame& frame);
std::string conflict_lines(const detail::CheckedFrame& frame);
/// Returns the line of an event.
std::string event_line(const detail::OverlapEvent& event, double fps);

/// Returns the summary for people.
std::string check_text(const CheckedRecording& recording, const detail::CheckSummary& summary);
/// Writes all of it for programs; without a name nothing. Events go to the file one by one, because there may be millions.
/// `has_measures`: people who collide are counted in the summary. `truth`: what the recording was compared with, or null.
void write_check_json(const std::string& file, const CheckedRecording& recording,
                      const detail::CheckSummary& summary, bool has_measures,
                      const detail::TruthCollisions* truth);

/// Returns the share of person-frames in overlap, in percent.
double percent_in_overlap(const detail::CheckSummary& summary);

/// Writes the summary to standard output.
/// Errors:  throws CheckFailed where more person-seconds are in overlap than outputs.fail_above.
void report(const CheckedRecording& recording, const detail::CheckSummary& summary,
            const CheckOutputs& outputs, const detail::TruthCollisions* truth);

/// Holds what is checked, and how: all that the answers depend on.
struct CheckInput {
  std::string file, truth, walls, unit, columns;
  double fps = 0;  ///< 0: what the file says
  double max_distance = 0;
  std::size_t max_pairs = 0;  ///< 0: what is usual
  ShapeOptions shapes;        ///< of which clips alone are asked for
  std::vector<std::string> characters;
  std::string depth = "all", leaves = "segments";
  BodyKind kind;
  std::vector<std::string> clip_speeds;  ///< NAME=SPEED each; these and the next of a baked set alone
  double facing = 0;                     ///< degrees
  std::string date;                      ///< for the page; empty: the file's
  std::vector<std::string> bodies;       ///< NAME=FILE each: what rows name beside the bodies of the library

  void add_to(CLI::App& command);
  /// Errors:  throws UsageError on options that do not belong together.
  void require_fitting(const CLI::App& command) const;
  /// Takes bodies of spheres where none are asked for. Errors: throws UsageError where outlines are.
  void require_spheres(const CLI::App& command);
  std::vector<std::string> files() const;
  std::uint32_t spheres() const { return kind.bodies == "spheres" ? kind.spheres : 0; }

 private:
  void add_bodies_to(CLI::App& command);
};

/// Adds the options of where answers go.
void add_outputs_to(CLI::App& command, CheckOutputs& outputs);

/// Represents a recording that is open, with its walls and the characters that people have.
struct OpenedCheck {
  std::optional<BakedShapes> baked;
  detail::CharacterLibrary library;
  std::vector<detail::Footprint> footprints;
  std::unique_ptr<detail::TrajectoryReader> reader;
  std::optional<ObstacleSet> walls;
  CheckedRecording recording;
  std::vector<BodyModel> bodies;                    ///< made by options(), where people have spheres
  std::unique_ptr<detail::TrajectoryReader> truth;  ///< or null

  /// Opens the recording. Errors: throws UsageError, InputError, TrajectoryError.
  explicit OpenedCheck(const CheckInput& input);
  /// Returns what to ask check(); as long as this lives. Makes models where people have spheres.
  /// Errors:  throws UsageError, InputError on models that cannot be made.
  detail::CheckOptions options(const CheckInput& input);
  /// Checks the recording by detail::check(), and writes its notes to standard error. Errors: throws InputError also on too many pairs.
  detail::CheckSummary check(
      const detail::CheckOptions& options,
      const std::function<void(const detail::CheckedFrame&, const ShapeSet&)>& seen) const;
};

/// Adds a subcommand to the program, as those of bench/cli/commands.hpp are.
std::function<void()> add_check_command(CLI::App& program);

}  // namespace bch::cli
