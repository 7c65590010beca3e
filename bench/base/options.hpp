// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <bch/import.hpp>
#include <bch/pairs.hpp>

#include "bench/base/command_line.hpp"
#include "bench/base/cost_limits.hpp"
#include "kernel/runtime/all_options.hpp"

namespace bch::cli {

/// Holds the options that choose the poses of characters and their hierarchies: the same ones in every
/// command.
struct ShapeOptions {
  std::vector<std::string> clips;
  bool force_clips = false;
  std::string up;
  double scale = 0;  ///< 0: what the file says
  std::uint32_t poses = 100;
  double threshold = 0.01;
  CostLimits limits;

  void add_to(CLI::App& command);
  /// Adds the options of import_options(), or --poses, alone.
  void add_import_to(CLI::App& command);
  void add_poses_to(CLI::App& command);
  ImportOptions import_options() const;
  /// Returns all files that are read: these, and the clips' files.
  std::vector<std::string> inputs(std::vector<std::string> files) const;

 private:
  void add_limits_to(CLI::App& command);
};

/// Holds the options that choose how pairs are answered.
struct AnswerOptions {
  std::string depths = "0,3,6,all";
  std::string leaves;  ///< empty: segments where there are some
  std::string isa;
  std::uint32_t threads = 0;  ///< 0: all

  void add_to(CLI::App& command);
  /// Adds those of levels and threads alone.
  void add_levels_to(CLI::App& command);
  /// Errors of all: throw UsageError naming the option and the value.
  std::vector<std::uint32_t> cut_depths() const;
  detail::AllOptions query_options() const;
};

/// Parses a depth: a number, or "all".
/// Errors:  throws UsageError naming the option.
std::uint32_t parse_depth(const std::string& option, const std::string& text);

/// Refuses options that do not fit to others.
/// Errors:  throws UsageError naming the option and the reason if one of them was given.
void require_absent(const CLI::App& command, const std::vector<const char*>& options,
                    const std::string& reason);
/// Refuses the options of shapes and levels, as far as the command has them, since they have no effect on a
/// baked file.
/// Errors:  as require_absent() throws.
void require_unsettled(const CLI::App& command, const std::string& baked_file);

/// Adds the option --max-pairs: of `what`, of whom one is `one`.
void add_max_pairs_option(CLI::App& command, std::size_t& most, const char* what, const char* one);
void add_threads_option(CLI::App& command, std::uint32_t& threads);
/// Adds the option of what decides at the deepest level. `centimetres`: by how much sooner discs do.
void add_leaves_option(CLI::App& command, std::string& leaves, int centimetres);
/// Adds the option --seed, which chooses `what`.
void add_seed_option(CLI::App& command, std::uint64_t& seed, const std::string& what);

/// Rejects every other word. `renamed`: old words with the new ones, which the message names.
CLI::Validator one_of(std::vector<std::string> words, std::map<std::string, std::string> renamed = {});

/// Rejects what is not a finite number in [low, high], NaN included.
CLI::Validator number_between(double low, double high);

/// Rejects what is not a whole number in [low, high], in decimal digits.
CLI::Validator whole_between(std::uint64_t low, std::uint64_t high);

/// Sets how many threads work during this object's lifetime; 0: all.
class Threads {
 public:
  explicit Threads(std::uint32_t wanted);

  const unsigned count;

 private:
  std::shared_ptr<const void> limit_;
};

}  // namespace bch::cli
