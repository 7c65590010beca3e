// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Command lines of the options that commands share, one word up to each zero byte.

#include <cmath>

#include "bench/base/exit_codes.hpp"
#include "bench/base/options.hpp"
#include "tests/fuzz/target.hpp"

namespace bch::fuzz {
namespace {

struct Line {
  cli::ShapeOptions shapes;
  cli::AnswerOptions answer;
  std::vector<std::string> files;
};

void check(const Line& line) {
  require(line.shapes.poses >= 1 && line.shapes.poses <= 1'000'000, "the poses are in range");
  require(line.shapes.threshold >= 1e-4 && line.shapes.threshold <= 100, "the threshold is in range");
  require(line.answer.threads <= 1024, "the threads are in range");
  const ImportOptions import = line.shapes.import_options();
  require(!import.scale || (std::isfinite(*import.scale) && *import.scale > 0), "the scale is positive");
  require(!import.up || *import.up <= ImportOptions::UpAxis::z, "there are three axes");
  const std::vector<std::uint32_t> depths = line.answer.cut_depths();
  validate(ShapeSetPlan{depths});
  require(line.answer.query_options().implementation != nullptr, "there is a kernel");
}

}  // namespace
}  // namespace bch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bch;
  fuzz::Bytes bytes(data, size);
  std::vector<std::string> words;
  while (!bytes.empty()) words.push_back(bytes.text());
  std::reverse(words.begin(), words.end());  // as the parser takes them

  CLI::App program;
  fuzz::Line line;
  CLI::App& command = *program.add_subcommand("bake");
  command.add_option("FILE", line.files)->required();
  line.shapes.add_to(command);
  line.answer.add_to(command);
  try {
    program.parse(words);
    if (command.parsed()) fuzz::check(line);
  } catch (const CLI::ParseError&) {
  } catch (const cli::UsageError&) {
  }
  return 0;
}
