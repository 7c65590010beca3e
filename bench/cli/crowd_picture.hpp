// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "bench/cli/crowd_answers.hpp"

namespace bch::cli {

struct CrowdPicture {
  std::span<const Shape> shapes;
  const Crowd& crowd;
  const CrowdAnswers& answers;
  std::uint32_t level = 0;  ///< whose discs are drawn and whose answers are coloured
  double density = 0;
};

/// Draws the middle of the crowd from above as SVG: outlines filled, discs over them. Colours show whether an
/// agent collides, only its single cylinder does, or neither. They differ in lightness as much as in hue, so
/// that they can be told apart with colour blindness and in grey print.
std::string draw_crowd(const CrowdPicture& picture);

}  // namespace bch::cli
