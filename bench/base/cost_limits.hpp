// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>

namespace bch::cli {

/// Limits what a character file may cost once it has been read, while its shapes are built and written. No real
/// character comes near the defaults. Whatever goes beyond a limit is refused by one line that names the limit and the
/// option that raises it.
struct CostLimits {
  std::size_t triangles = 4'000'000;         ///< of a file, those of each instance of a mesh
  std::size_t contours = 1'000'000;          ///< of the outline of a pose
  std::size_t nodes = std::size_t{1} << 22;  ///< of the hierarchy of a pose
  std::size_t drawn_nodes = 100'000;         ///< of the hierarchy that a picture shows
  double seconds = 0;                        ///< for all shapes; 0: 60, and 1 more for each shape
  double memory = 0;                         ///< GiB of the program; 0: 4, and 1/1024 more for each shape

  /// Returns the two limits that depend on how many shapes were asked for.
  double seconds_for(std::size_t shapes) const {
    return seconds > 0 ? seconds : 60 + static_cast<double>(shapes);
  }
  double memory_for(std::size_t shapes) const {
    return memory > 0 ? memory : 4 + static_cast<double>(shapes) / 1024;
  }
};

/// Returns an error message: "12 contours, more than 10; --max-contours raises the limit".
inline std::string beyond_limit(std::size_t count, const char* what, std::size_t most, const char* option) {
  return fmt::format("{} {}, more than {}; {} raises the limit", count, what, most, option);
}

}  // namespace bch::cli
