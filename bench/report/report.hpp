// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/report/experiment.hpp"

namespace bch::report {

struct Options {
  std::filesystem::path folder;
  std::vector<std::string> characters = {"default:male", "default:female"};
  std::filesystem::path real_characters;  ///< a folder of them; empty: none
  std::filesystem::path recordings;       ///< a folder of those of the test data; empty: none
  std::vector<std::string> experiments;   ///< none: all
  Sizes sizes = full_sizes;
  std::uint64_t seed = 1;
  std::string command;  ///< that does all this again
};

/// Runs experiments, in the order of the page, and writes into the folder of each
///   NAME*.csv   its tables,
///   NAME.json   the same, with machine, compiler, commit, seed, options and command;
/// and run.csv with the latter. Then make_page().
/// Errors:  throws cli::InputError where something cannot be read or written, as cli::load_character() does, and
///          whatever an experiment finds wrong.
void run_report(const Options& options);

/// Writes report.html from the CSV files in the folder and from nothing else: what experiments left there, at whatever
/// time. Beside it the scripts of the charts and what gnuplot made of them, where there is gnuplot.
/// Errors:  throws cli::InputError on files that are missing or not those of an experiment.
void make_page(const std::filesystem::path& folder);

}  // namespace bch::report
