// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/motion_table.hpp"

namespace bch::detail::trajectory {

/// Errors:  throws TrajectoryError on what cannot be added.
void MotionTable::require_new(std::string_view character, std::string_view clip, const RowBody& body,
                              const Places& places, std::uint64_t line) const {
  constexpr std::size_t longest_name = 255, most = 4096, most_bodies = 65'536;
  for (const std::string_view name : {character, clip, body.kind})
    if (name.size() > longest_name)
      places.reject(line, "the name " + shown(name) + " has more than 255 bytes");
  if (body.kind.empty()) {
    if (all_.size() - bodies_ == most)
      places.reject(line, "character " + shown(character) + " and clip " + shown(clip) +
                              " are beyond the 4096 different pairs that a file may name");
    return;
  }
  if (bodies_ == most_bodies)
    places.reject(line, "body " + shown(body.kind) + " of " + std::to_string(body.length) + " mm by " +
                            std::to_string(body.width) +
                            " mm is beyond the 65536 different bodies that a file may have");
}

std::uint32_t MotionTable::find(std::string_view character, std::string_view clip, const RowBody& body,
                                const Places& places, std::uint64_t line) {
  const bool is_pair = !character.empty() || !clip.empty(), is_body = !body.kind.empty();
  if (!is_pair && !is_body) return TrackedPerson::no_motion;
  if (is_pair && is_body)
    places.reject(line, "has both a body, " + shown(body.kind) + ", and a " +
                            (character.empty() ? "clip, " + shown(clip) : "character, " + shown(character)));
  if (is_pair)
    wanted_.assign(character).append("\n").append(clip);
  else
    wanted_
        .assign(1, '\0')  // which no name begins with
        .append(std::to_string(body.length) + " " + std::to_string(body.width) + " ")
        .append(body.kind);
  const auto known = number_of_.find(wanted_);
  if (known != number_of_.end()) return known->second;
  require_new(character, clip, body, places, line);
  const auto number = static_cast<std::uint32_t>(all_.size());
  all_.push_back({std::string(character), std::string(clip), places.at(line), std::string(body.kind),
                  body.length / 1000.0, body.width / 1000.0});
  bodies_ += is_body;
  number_of_.emplace(wanted_, number);
  return number;
}

}  // namespace bch::detail::trajectory
