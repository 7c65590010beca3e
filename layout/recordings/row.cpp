// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/row.hpp"

#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"
#include "layout/recordings/trajectory.hpp"

namespace bch::detail::trajectory {

std::string Places::row(std::uint64_t number) const {
  return (has_lines ? "line " : "row ") + std::to_string(number);
}

std::string Places::at(std::uint64_t number) const {
  std::string text = one_line(file.string());
  return text.append(has_lines ? ":" : ": ").append(has_lines ? std::to_string(number) : row(number));
}

void Places::reject(const std::string& reason) const {
  throw TrajectoryError(one_line(file.string() + ": " + reason));
}

void Places::reject(std::uint64_t number, const std::string& reason) const {
  throw TrajectoryError(one_line(at(number) + ": " + reason));
}

std::string coordinate_fault(double metres) {
  return is_finite(metres) ? "is not within +-1e8 m" : "is not finite";
}

void Heights::describe(std::vector<std::string>& assumptions) const {
  if (any_) assumptions.emplace_back("z is the person's height where it is from 1 to 2.5 m.");
  if (any_other_)
    assumptions.emplace_back("z below 1 m or above 2.5 m is not a person's height, and is ignored.");
}

double checked_fps(const Places& places, double fps, const std::string& what) {
  if (!(fps > 0 && fps <= largest_fps))
    places.reject(what + " is " + shortest(fps) + " frames a second, not above 0 and at most 10000");
  return fps;
}

}  // namespace bch::detail::trajectory
