// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <bch/obstacles.hpp>

#include "kernel/recordings/check.hpp"

// What a check says of a recording, on its page and elsewhere.

namespace bch::detail {

/// Holds what is known of a checked recording besides the answers.
struct CheckedRecording {
  std::string file;
  TrajectoryInfo info;
  std::uint32_t spheres;  ///< of a body; 0: people have outlines
  std::uint32_t depth;
  Leaves leaves;
  std::uint32_t characters;  ///< custom ones; 0: built-in pedestrians
  bool baked;                ///< those are of a baked set
  const ObstacleSet* walls;  ///< or null
  std::string date;          ///< for the page, or empty
  std::string options;       ///< that the answers depend on, as they were given
};

/// Writes a number in up to six digits: "0.5".
std::string number_text(double number);
double percent(std::uint64_t part, std::uint64_t whole);
/// Writes a share: "12.34 %".
std::string percent_text(std::uint64_t part, std::uint64_t whole);
/// Returns what the bodies are, in a few words.
std::string bodies_text(const CheckedRecording& recording);
/// Returns how many events of each kind there are.
std::string events_text(const CheckSummary& summary);
/// Returns the people per square metre of a class of density, as "1-2" with a dash.
std::string density_name(std::size_t density_class, std::string_view dash);

}  // namespace bch::detail
