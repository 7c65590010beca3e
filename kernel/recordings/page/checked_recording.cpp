// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/page/checked_recording.hpp"

#include <charconv>

#include <bch/hierarchy.hpp>

#include "layout/base/text.hpp"

namespace bch::detail {

std::string number_text(double number) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 6).ptr;
  return {digits, end};
}

double percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(whole);
}

std::string percent_text(std::uint64_t part, std::uint64_t whole) {
  char digits[32];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, percent(part, whole), std::chars_format::fixed, 2).ptr;
  return std::string(digits, end) + " %";
}

std::string bodies_text(const CheckedRecording& recording) {
  const std::string whose = recording.characters == 0 ? std::string("built-in pedestrians")
                                                      : counted(recording.characters, "character");
  if (recording.spheres > 0) return whose + ", " + counted(recording.spheres, "sphere") + " each";
  if (recording.depth != all_depths) return whose + ", discs of depth " + std::to_string(recording.depth);
  return whose + (recording.leaves == Leaves::segments ? ", their outlines" : ", discs of their leaves");
}

std::string events_text(const CheckSummary& summary) {
  return grouped(summary.overlap_events) + " in overlap, " + grouped(summary.passings) +
         " passing between two frames, " + grouped(summary.wall_events) + " in a wall";
}

std::string density_name(std::size_t density_class, std::string_view dash) {
  const bool is_last = density_class + 1 == density_classes.size();
  return number_text(density_classes[density_class]) + std::string(dash) +
         (is_last ? "" : number_text(density_classes[density_class + 1]));
}

}  // namespace bch::detail
