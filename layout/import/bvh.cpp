// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cmath>

#include "layout/import/scene.hpp"
#include "layout/import/text.hpp"

namespace bch::detail::importing {
namespace {

/// Returns a whole number, or -1.
double integer(std::string_view word) {
  const double value = number_of(word).value_or(-1);
  return value == std::floor(value) ? value : -1;
}

/// Goes over the channels of a joint.
/// Returns: how many there are.
std::size_t skip_channels(const std::filesystem::path& file, std::string_view& text, std::string_view joint) {
  const double said = integer(next_word(text));
  std::size_t channels = 0, positions = 0;
  for (; static_cast<double>(channels) < said && !text.empty(); ++channels)
    positions += next_word(text).ends_with("position");
  if (positions > 0 && channels != 6)
    reject(file,
           "joint '" + std::string(joint) + "' has " + count(channels, "channel") +
               ", one of them a position, which is read only beside two more positions and three rotations");
  return channels;
}

}  // namespace

std::string check_bvh(const std::filesystem::path& file, std::string_view text) {
  std::size_t channels = 0;
  std::string_view joint;
  while (!text.empty()) {
    const std::string_view word = next_word(text);
    if (word == "MOTION") break;
    if (word == "ROOT" || word == "JOINT") joint = next_word(text);
    if (word == "CHANNELS") channels += skip_channels(file, text, joint);
  }
  if (next_word(text) != "Frames:") return "";  // assimp says what it misses
  const std::string_view said = next_word(text);
  const double frames = integer(said);
  if (!(frames >= 1)) reject(file, "'Frames: " + std::string(said) + "' is no number of frames");
  for (int i = 0; i < 3; ++i) next_word(text);  // Frame Time: seconds
  std::size_t numbers = 0;
  while (!next_word(text).empty()) ++numbers;

  if (channels == 0 || static_cast<double>(numbers) == frames * static_cast<double>(channels)) return "";
  const std::size_t left = numbers % channels;
  const std::string differ = "behind 'Frames: " + std::string(said) + "' stands motion of " +
                             count(numbers / channels, "frame") +
                             (left == 0 ? "" : " and " + count(left, "number"));
  if (static_cast<double>(numbers) < frames * static_cast<double>(channels)) reject(file, differ);
  return differ + ": what is beyond is not read";
}

}  // namespace bch::detail::importing
