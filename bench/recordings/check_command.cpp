// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/base/exit_codes.hpp"
#include "bench/base/options.hpp"
#include "bench/base/output.hpp"
#include "bench/recordings/recording_check.hpp"
#include "bench/recordings/recording_page.hpp"

namespace bch::cli {
namespace {

struct CheckCommandOptions {
  CheckInput input;
  CheckOutputs outputs;
  std::string html;
  PartOptions part;
  std::uint32_t threads = 0;
};

void check_whole(const CheckCommandOptions& options) {
  std::vector<OutputOption> files = options.outputs.files();
  files.push_back({"--html", options.html});
  require_outputs(files, options.input.files());
  OpenedCheck opened(options.input);  // before there are threads: see import_in_child()
  const Threads threads(options.threads);
  CheckTables tables(options.outputs);
  std::optional<RecordingPage> page;
  if (!options.html.empty()) page.emplace(opened.recording);
  detail::CheckOptions how = opened.options(options.input);
  how.draws = page.has_value();
  const detail::CheckSummary summary =
      opened.check(how, [&](const detail::CheckedFrame& frame, const ShapeSet& shapes) {
        tables.add(frame);
        if (page) page->add(frame, shapes);
      });
  tables.finish(opened.recording, summary);
  if (page) write_file(options.html, std::move(*page).finish(summary));
  report(opened.recording, summary, options.outputs);
}

void run_check(const CLI::App& command, const CheckCommandOptions& options) {
  options.input.require_fitting(command);
  if (!options.part.are_given()) return check_whole(options);
  require_absent(command, {"--events", "--frames", "--pairs", "--json", "--fail-above"},
                 "--part writes parts of all: it belongs to bch merge");
  require_absent(command, {"--html"}, "a page is not made in parts");
  const Threads threads(options.threads);
  write_standard_output(
      check_part(options.input, options.part.files(), run_of(command, options.input.files())));
}

}  // namespace

std::function<void()> add_check_command(CLI::App& program) {
  const auto options = std::make_shared<CheckCommandOptions>();
  CLI::App& command = *program.add_subcommand(
      "check", "Put bodies on a recorded or simulated crowd, and find who runs into whom");
  command.footer(
      R"(Reads JuPedSim's SQLite and HDF5, PeTrack and Juelich text, the Pedestrian Dynamics Data Archive's
HDF5, Pathfinder's CSV, TrajNet++, ETH/UCY, and plain CSV with columns id, frame or time, x, y. The
format is recognized by the content of the file, not by its name. If the file does not state the
frame rate or the unit of length, the program asks for --fps or --unit, and for --columns where they
have no names and their rows do not tell them. It prints every assumption.
Each row becomes a pedestrian of the person's stature, in the stride that belongs to the person's
speed, with the head above the recorded position.
Two people overlap if their outlines overlap, seen from above; with --bodies spheres if their bodies
meet in space, posed at each person's phase. The exit code is 1 if overlaps exceed --fail-above, and
else 0, whatever is found.
Example: bch check trajectories.sqlite --events events.csv)");
  options->input.add_to(command);
  add_outputs_to(command, options->outputs);
  OptionAdder{command}("--html", options->html, "FILE.html",
                       "Write a web page that plays the recording; it needs no network");
  options->part.add_to(command);
  add_threads_option(command, options->threads);
  return [options, &command] { run_check(command, *options); };
}

namespace {

struct MergeOptions {
  std::vector<std::string> parts;
  CheckOutputs outputs;
};

void run_merge(const CLI::App& command, const MergeOptions& options) {
  const WholeRun whole = find_parts(options.parts);
  require_outputs(options.outputs.files(), whole.files);
  if (whole.run.at("command") == "check") return merge_check(whole, options.outputs);
  require_absent(command, {"--events", "--frames", "--pairs", "--json", "--fail-above"},
                 "belongs to parts of bch check");
  write_standard_data(joined_tables(whole, answers_kind));
}

}  // namespace

std::function<void()> add_merge_command(CLI::App& program) {
  const auto options = std::make_shared<MergeOptions>();
  CLI::App& command =
      *program.add_subcommand("merge", "Join the parts that check --part or query --part wrote");
  command.footer(
      "Writes the same bytes as a single run. All parts have to be there, complete, and of the same run, "
      "with the same\n"
      "files, options and version. A page (check --html) cannot be made in parts.\n"
      "Example: seq 8 | xargs -P 4 -I{} bch check long.sqlite --part {}/8 --into parts && bch merge parts "
      "--json check.json");
  OptionAdder{command}("PARTS", options->parts, "", "Folder of the parts, or their manifests")->required();
  add_outputs_to(command, options->outputs);
  return [options, &command] { run_merge(command, *options); };
}

}  // namespace bch::cli
