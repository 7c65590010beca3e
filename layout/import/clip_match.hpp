// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <string>
#include <vector>

// Private to the importer: whether a clip of another file was made for the character's skeleton.

namespace bch::detail::importing {

/// Holds what the skeletons of a character and of a clip's file have in common.
struct ClipMatch {
  std::vector<std::string> matched, unmatched;  ///< the nodes of the clip's channels
  std::size_t joints = 0;                       ///< of the character
  std::size_t joints_in_file = 0;               ///< of these, those that the clip's file has by name
  std::size_t bones = 0;                        ///< of the character: joints with a parent
  std::size_t bones_in_file = 0;  ///< of these, those that join the same two joints in the clip's file
  double alignment = 1;           ///< mean cosine between the bones that both have and the clip moves
};

/// Returns the reason why the clip belongs to another skeleton, with some of the names; empty where it belongs to this one.
/// It does where the character has no bones or shares one with the file, where at least half of the clip's channels
/// move the character or the file has at least half of the character's joints, and where bones point the same way.
std::string mismatch(const ClipMatch& match);

}  // namespace bch::detail::importing
