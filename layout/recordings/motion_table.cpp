// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/motion_table.hpp"

namespace bch::detail::trajectory {

std::uint32_t MotionTable::find(std::string_view character, std::string_view clip, const Places& places,
                                std::uint64_t line) {
  constexpr std::size_t longest_name = 255, most = 4096;
  if (character.empty() && clip.empty()) return TrackedPerson::no_motion;
  wanted_.assign(character).append("\n").append(clip);
  const auto known = number_of_.find(wanted_);
  if (known != number_of_.end()) return known->second;
  for (const std::string_view name : {character, clip})
    if (name.size() > longest_name)
      places.reject(line, "the name " + shown(name) + " has more than 255 bytes");
  if (all_.size() == most)
    places.reject(line, "character " + shown(character) + " and clip " + shown(clip) +
                            " are beyond the 4096 different pairs that a file may name");
  const auto number = static_cast<std::uint32_t>(all_.size());
  all_.push_back({std::string(character), std::string(clip), places.at(line)});
  number_of_.emplace(wanted_, number);
  return number;
}

}  // namespace bch::detail::trajectory
