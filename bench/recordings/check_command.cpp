// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/base/exit_codes.hpp"
#include "bench/base/options.hpp"
#include "bench/base/output.hpp"
#include "bench/recordings/recording_check.hpp"
#include "bench/recordings/resolved_recording.hpp"
#include "kernel/recordings/page/recording_page.hpp"

namespace bch::cli {
namespace {

struct CheckCommandOptions {
  CheckInput input;
  CheckOutputs outputs;
  std::string html, resolved;
  std::uint32_t threads = 0;
};

/// The options that the answers depend on, as they were given.
std::string given_options(const CLI::App& command) {
  constexpr std::string_view of_outputs[] = {"--events",   "--frames",    "--pairs",      "--json",
                                             "--html",     "--date",      "--fail-above", "--threads",
                                             "--measures", "--conflicts", "--resolve"};
  std::string text;
  for (const CLI::Option* const option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || !name.starts_with("--") || std::ranges::count(of_outputs, name) > 0) continue;
    for (const std::string& value : option->results()) text += (text.empty() ? "" : " ") + name + " " + value;
  }
  return text;
}

void run_check(const CLI::App& command, CheckCommandOptions options) {
  if (!options.resolved.empty()) options.input.require_spheres(command);
  options.input.require_fitting(command);
  std::vector<OutputOption> files = options.outputs.files();
  files.push_back({"--html", options.html});
  files.push_back({"--resolve", options.resolved});
  require_outputs(files, options.input.files());
  OpenedCheck opened(options.input);  // before there are threads: see import_in_child()
  opened.recording.options = given_options(command);
  const Threads threads(options.threads);
  CheckTables tables(options.outputs);
  std::optional<detail::RecordingPage> page;
  if (!options.html.empty()) page.emplace(opened.recording);
  detail::CheckOptions how = opened.options(options.input);
  how.draws = page.has_value();
  how.measures = options.outputs.has_measures();
  std::optional<ResolvedRecording> resolved;
  if (!options.resolved.empty()) resolved.emplace(opened);
  std::optional<detail::TruthCollisions> truth;
  if (opened.truth) truth.emplace(*opened.truth, opened.reader->info(), how);
  const detail::CheckSummary summary =
      opened.check(how, [&](const detail::CheckedFrame& frame, const ShapeSet& shapes) {
        tables.add(frame);
        if (page) page->add(frame, shapes);
        if (truth) truth->add(frame);
        if (resolved) resolved->add(frame);
      });
  const detail::TruthCollisions* const of_truth = truth ? &*truth : nullptr;
  tables.finish(opened.recording, summary, of_truth);
  if (page) write_file(options.html, std::move(*page).finish(summary));
  report(opened.recording, summary, options.outputs, of_truth);
  if (!resolved) return;
  resolved->resolve();
  write_file(options.resolved, resolved->csv());
  write_standard_output(resolved->report());
}

}  // namespace

std::function<void()> add_check_command(CLI::App& program) {
  const auto options = std::make_shared<CheckCommandOptions>();
  CLI::App& command = *program.add_subcommand(
      "check", "Put bodies on a recorded or simulated crowd, and find the people who overlap");
  command.footer(
      R"(Reads JuPedSim's SQLite and HDF5, PeTrack and Juelich text, the Pedestrian Dynamics Data Archive's
HDF5, Pathfinder's CSV, TrajNet++, ETH/UCY, and plain CSV with columns id, frame or time, x, y. The
format is recognized by the content of the file, not by its name. If the file does not state the
frame rate or the unit of length, --fps or --unit is required; if its columns have no names and
cannot be recognized, --columns is required. The program prints every assumption.
Each row becomes a pedestrian of the person's stature, in the walking pose of the person's speed, with the
head above the recorded position.
Two people overlap if their outlines, seen from above, do; with --bodies spheres, if their bodies
do in 3D. The exit code is 1 if overlaps exceed --fail-above, and otherwise 0, even if people overlap.
Example: bch check trajectories.sqlite --events events.csv)");
  options->input.add_to(command);
  add_outputs_to(command, options->outputs);
  OptionAdder{command}("--html", options->html, "FILE.html",
                       "Write a web page that plays the recording; it needs no network");
  OptionAdder{command}(
      "--resolve", options->resolved, "FILE.csv",
      "Write the recording with people moved, by small and smooth shifts, until no bodies overlap");
  OptionAdder{command}("--date", options->input.date, "TEXT",
                       "Date to show on the page of --html [the file's]");
  add_threads_option(command, options->threads);
  return [options, &command] { run_check(command, *options); };
}

}  // namespace bch::cli
