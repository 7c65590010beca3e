// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "layout/recordings/row.hpp"

// Private to the readers of recordings: the characters and clips, or the bodies, that rows name.

namespace bch::detail::trajectory {

/// Describes the body of a row that does not walk; without a kind there is none.
struct RowBody {
  std::string_view kind;
  int length = 0, width = 0;  ///< millimetres
};

/// Holds the different pairs of a character and a clip, and the different bodies, that the rows of a file name, so that each row has a number in their
/// place.
class MotionTable {
 public:
  /// Returns the number of a row's pair or body, no_motion where it has neither.
  /// Errors:  throws TrajectoryError, naming the line, on a name of more than 255 bytes, on a body beside a pair, and beyond 4096 pairs
  ///          and 65 536 bodies.
  std::uint32_t find(std::string_view character, std::string_view clip, const RowBody& body,
                     const Places& places, std::uint64_t line);
  const std::vector<NamedMotion>& all() const { return all_; }

 private:
  void require_new(std::string_view character, std::string_view clip, const RowBody& body,
                   const Places& places, std::uint64_t line) const;

  std::vector<NamedMotion> all_;
  std::size_t bodies_ = 0;  ///< of all
  std::unordered_map<std::string, std::uint32_t>
      number_of_;  ///< by both names, with a line end between them, or by a body's kind and sizes, with blanks
  std::string wanted_;
};

}  // namespace bch::detail::trajectory
