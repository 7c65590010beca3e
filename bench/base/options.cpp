// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "bench/base/exit_codes.hpp"
#include "bench/base/text.hpp"

namespace bch::cli {
CLI::Validator one_of(std::vector<std::string> words, std::map<std::string, std::string> renamed) {
  const auto check = [words = std::move(words),
                      renamed = std::move(renamed)](const std::string& text) -> std::string {
    if (std::find(words.begin(), words.end(), text) != words.end()) return {};
    if (const auto found = renamed.find(text); found != renamed.end())
      return fmt::format("'{}' is called {} now", text, found->second);
    return fmt::format("'{}' is not one of {}", text, fmt::join(words, ", "));
  };
  return CLI::Validator(check, "", "word");
}

CLI::Validator number_between(double low, double high) {
  // Whole numbers in full: 1e7 is 10000000.
  const auto name = [](double limit) {
    return limit == std::floor(limit) ? fmt::format("{:.0f}", limit) : fmt::format("{}", limit);
  };
  const auto check = [low, high, name](const std::string& text) -> std::string {
    const auto value = parse_number(text);
    if (value && *value >= low && *value <= high) return {};
    return fmt::format("'{}' is not a number from {} to {}", text, name(low), name(high));
  };
  return CLI::Validator(check, "", "number");
}

CLI::Validator whole_between(std::uint64_t low, std::uint64_t high) {
  const auto check = [low, high](const std::string& text) -> std::string {
    std::uint64_t value = 0;
    const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(begin, end, value);
    // CLI11 would read digits behind a zero as octal.
    const bool digits = error == std::errc() && stop == end && (*begin != '0' || end - begin == 1);
    if (digits && value >= low && value <= high) return {};
    return fmt::format("'{}' is not a whole number from {} to {}, in digits such as {}", text, low, high,
                       std::clamp<std::uint64_t>(1000, low, high));
  };
  return CLI::Validator(check, "", "number");
}

void require_absent(const CLI::App& command, const std::vector<const char*>& options,
                    const std::string& reason) {
  for (const char* option : options)
    if (command.count(option) > 0) throw UsageError(fmt::format("{}: {}", option, reason));
}

void require_unsettled(const CLI::App& command, const std::string& baked_file) {
  for (const char* option :
       {"--clips", "--force-clips", "--up", "--scale", "--poses", "--threshold", "--depths",
        "--max-triangles", "--max-contours", "--max-nodes", "--max-seconds", "--max-memory"})
    if (command.get_option_no_throw(option) != nullptr && command.count(option) > 0)
      throw UsageError(
          fmt::format("{} has no effect with {}: the baked file already contains its shapes and levels",
                      option, baked_file));
}

void add_seed_option(CLI::App& command, std::uint64_t& seed, const std::string& what) {
  OptionAdder{command}("--seed", seed, "N", "Random seed for " + what + " [1]",
                       whole_between(0, std::numeric_limits<std::uint64_t>::max()));
}

void add_max_pairs_option(CLI::App& command, std::size_t& most, const char* what, const char* one) {
  OptionAdder{command, "Limits"}("--max-pairs", most, "N",
                                 fmt::format("Pairs of {} [4 million plus 100 per {}]", what, one),
                                 whole_between(1, 1'000'000'000));
}

void add_threads_option(CLI::App& command, std::uint32_t& threads) {
  OptionAdder{command}("--threads", threads, "N", "Number of threads [one per processor]",
                       whole_between(1, 1024));
}

std::uint32_t parse_depth(const std::string& option, const std::string& text) {
  if (text == "all") return all_depths;
  std::uint32_t depth = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, depth);
  if (error != std::errc() || stop != end || depth == all_depths)
    throw UsageError(fmt::format("{}: '{}' is neither a depth (0, 1, 2 ...) nor 'all'", option, text));
  return depth;
}

void ShapeOptions::add_import_to(CLI::App& command) {
  CLI::Option& clips_option = add_repeatable_option(
      command, "--clips", clips, "Add the clips of this file, matched by bone name (repeatable)", "FILE");
  command.add_flag("--force-clips", force_clips, "Also accept clips that belong to another skeleton")
      ->needs(&clips_option);
  const OptionAdder add(command);
  add("--up", up, "x|y|z", "Up axis of the file [as the file states, else a guess]", one_of({"x", "y", "z"}));
  add("--scale", scale, "METRES", "Metres per unit of the file [as the file states, else a guess]",
      number_between(1e-9, 1e9));
}

void ShapeOptions::add_poses_to(CLI::App& command) {
  OptionAdder{command}("--poses", poses, "N", "Poses per character, spread evenly over its clips [100]",
                       whole_between(1, 1'000'000));
}

void ShapeOptions::add_to(CLI::App& command) {
  add_import_to(command);
  add_poses_to(command);
  const OptionAdder add(command);
  add("--threshold", threshold, "METRES", "Discs with a smaller radius are not divided [0.01 m]",
      number_between(1e-4, 100));
  add_limits_to(command);
}

void ShapeOptions::add_limits_to(CLI::App& command) {
  const OptionAdder add(command, "Limits");
  const auto add_count = [&](const char* name, std::size_t& value, const char* what) {
    add(name, value, "N", fmt::format("{} [{}]", what, value), whole_between(1, 1'000'000'000));
  };
  add_count("--max-triangles", limits.triangles, "Triangles of a file, counted once per instance of a mesh");
  add_count("--max-contours", limits.contours, "Contours in the outline of a pose");
  add_count("--max-nodes", limits.nodes, "Nodes in the hierarchy of a pose");
  add("--max-seconds", limits.seconds, "SECONDS", "Time to build and write shapes [60 s plus 1 s per shape]",
      number_between(1e-3, 1e9));
  add("--max-memory", limits.memory, "GIB",
      "Memory while shapes are built and written [4 GiB plus 1 MiB per shape]", number_between(1e-3, 1e6));
}

ImportOptions ShapeOptions::import_options() const {
  ImportOptions options;
  if (!up.empty()) options.up = static_cast<ImportOptions::UpAxis>(up[0] - 'x');
  if (scale > 0) options.scale = static_cast<float>(scale);
  options.clip_files.assign(clips.begin(), clips.end());
  options.force_clips = force_clips;
  options.max_triangles = limits.triangles;
  return options;
}

std::vector<std::string> ShapeOptions::inputs(std::vector<std::string> files) const {
  files.insert(files.end(), clips.begin(), clips.end());
  return files;
}

void add_leaves_option(CLI::App& command, std::string& leaves, int centimetres) {
  OptionAdder{command}(
      "--leaves", leaves, "NAME",
      fmt::format("With depth all, test outlines (segments) or discs, which collide up to {} cm "
                  "earlier [segments]",
                  centimetres),
      one_of({"segments", "discs"}));
}

void AnswerOptions::add_levels_to(CLI::App& command) {
  const OptionAdder add(command);
  add("--depths", depths, "LIST", "Levels of detail: cut depths, ascending [0,3,6,all]");
  add_threads_option(command, threads);
}

void AnswerOptions::add_to(CLI::App& command) {
  add_levels_to(command);
  add_leaves_option(command, leaves, 2);
  std::vector<std::string_view> names;
  for (const Implementation& each : implementations()) names.push_back(each.name);
  OptionAdder{command}(
      "--isa", isa, "NAME",
      fmt::format("Instruction set of the kernel: {} [the best of this processor]", fmt::join(names, ", ")));
}

std::vector<std::uint32_t> AnswerOptions::cut_depths() const {
  std::vector<std::uint32_t> list;
  for (std::size_t begin = 0; begin <= depths.size();) {
    const std::size_t end = std::min(depths.find(',', begin), depths.size());
    const std::uint32_t depth = parse_depth("--depths", depths.substr(begin, end - begin));
    if (!list.empty() && depth <= list.back())
      throw UsageError(fmt::format("--depths: '{}' does not ascend", depths));
    list.push_back(depth);
    begin = end + 1;
  }
  if (list.size() > 32) throw UsageError("--depths: more than 32 levels");
  return list;
}

detail::AllOptions AnswerOptions::query_options() const {
  try {
    return {isa.empty() ? &best_implementation() : &implementation(isa),
            leaves == "discs" ? Leaves::discs : Leaves::segments};
  } catch (const std::invalid_argument& error) {
    throw UsageError(
        fmt::format("{}: {}", isa.empty() ? "environment variable BCH_ISA" : "--isa", error.what()));
  }
}

}  // namespace bch::cli
