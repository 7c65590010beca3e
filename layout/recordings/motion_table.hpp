// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "layout/recordings/row.hpp"

// Private to the readers of recordings: the characters and clips that rows name.

namespace bch::detail::trajectory {

/// Holds the different pairs of a character and a clip that the rows of a file name, so that each row has a number in their place.
class MotionTable {
 public:
  /// Returns the number of a row's pair, no_motion where both names are empty.
  /// Errors:  throws TrajectoryError, naming the line, on a name of more than 255 bytes, and beyond 4096 pairs.
  std::uint32_t find(std::string_view character, std::string_view clip, const Places& places,
                     std::uint64_t line);
  const std::vector<NamedMotion>& all() const { return all_; }

 private:
  std::vector<NamedMotion> all_;
  std::unordered_map<std::string, std::uint32_t> number_of_;  ///< by both names, with a line end between them
  std::string wanted_;
};

}  // namespace bch::detail::trajectory
