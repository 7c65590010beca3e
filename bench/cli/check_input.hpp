// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <bch/baked.hpp>
#include <bch/obstacles.hpp>

#include "bench/cli/check_output.hpp"
#include "bench/cli/options.hpp"
#include "kernel/recordings/check.hpp"

namespace bch::cli {

/// Holds what is checked, and how: all that the answers depend on.
struct CheckInput {
  std::string file, walls, unit, columns;
  double fps = 0;  ///< 0: what the file says
  double max_distance = 0;
  std::size_t max_pairs = 0;  ///< 0: what is usual
  ShapeOptions shapes;        ///< of which slices and clips alone are asked for
  std::vector<std::string> characters;
  std::string depth = "all", leaves = "segments";
  std::vector<std::string> clip_speeds;  ///< NAME=SPEED each; these and the next of a baked set alone
  double facing = 0;                     ///< degrees

  void add_to(CLI::App& command);
  std::vector<std::string> files() const;

 private:
  void add_bodies_to(CLI::App& command);
};

/// Adds the options of where answers go.
void add_outputs_to(CLI::App& command, CheckOutputs& outputs);

/// Represents a recording that is open, with its walls and the characters that people have.
struct OpenedCheck {
  std::optional<BakedShapes> baked;
  detail::Cast cast;
  std::unique_ptr<detail::TrajectoryReader> reader;
  std::string floor;  ///< as WKT, or empty
  std::optional<ObstacleSet> walls;
  CheckedRecording recording;

  /// Opens the recording. Errors: throws UsageError, InputError, TrajectoryError.
  explicit OpenedCheck(const CheckInput& input);
  /// Returns what to ask check(); as long as this lives.
  detail::CheckOptions options(const CheckInput& input) const;
  /// Checks the recording by detail::check(). Errors: throws InputError also on too many pairs.
  detail::CheckSummary check(
      const detail::CheckOptions& options,
      const std::function<void(const detail::CheckedFrame&, const ShapeSet&)>& seen) const;
};

}  // namespace bch::cli
