// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/cli/part_options.hpp"

#include <algorithm>
#include <array>

#include "bench/base/exit_codes.hpp"

namespace bch::cli {
namespace {

/// Options that say who does the work and where it goes.
constexpr std::array without_answers{"--part",   "--into",   "--parts", "--threads", "--isa",
                                     "--events", "--frames", "--pairs", "--json",    "--fail-above"};

}  // namespace

void PartOptions::add_to(CLI::App& command) {
  command.add_option("--part", part, "Do only part I of N, such as 1/8; bch merge joins the parts")
      ->type_name("I/N");
  command
      .add_option("--into", folder,
                  "Folder for the files of --part; a complete part of the same run is skipped")
      ->type_name("DIR");
}

bool PartOptions::are_given() const {
  if (part.empty() && !folder.empty()) throw UsageError("--into: belongs to --part");
  if (!part.empty() && folder.empty()) throw UsageError("--part: needs --into, the folder of parts");
  return !part.empty();
}

nlohmann::ordered_json run_of(const CLI::App& command, const std::vector<std::string>& inputs) {
  nlohmann::ordered_json options = nlohmann::ordered_json::object();
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() > 0 &&
        std::find(without_answers.begin(), without_answers.end(), name) == without_answers.end())
      options[name] = option->results();
  }
  return run_of(command.get_name(), options, inputs);
}

}  // namespace bch::cli
