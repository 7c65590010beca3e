// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <memory>
#include <string>
#include <vector>

#include "bench/base/exit_codes.hpp"
#include "bench/base/output.hpp"
#include "bench/recordings/recording_check.hpp"

namespace bch::cli {
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
