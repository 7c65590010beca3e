// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/fuzz/recording_checks.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/fuzz/target.hpp"

namespace bch::fuzz {
namespace {

void check_people(const std::vector<detail::TrackedPerson>& people, std::size_t motions) {
  require(!people.empty(), "frames have people");
  for (std::size_t i = 0; i < people.size(); ++i) {
    const detail::TrackedPerson& person = people[i];
    require(i == 0 || people[i - 1].id < person.id, "ids ascend");
    require(std::abs(person.x) <= 1e8 && std::abs(person.y) <= 1e8, "positions are in range");
    require(std::isnan(person.heading) || std::abs(person.heading) <= 1e9f, "headings are in range");
    require(std::isnan(person.stature) || (person.stature >= 1 && person.stature <= 2.5f),
            "people are of a height");
    require(person.motion == detail::TrackedPerson::no_motion || person.motion < motions,
            "motions are among those that were told");
  }
}

void check_info(const detail::TrajectoryInfo& info) {
  require(info.fps > 0 && info.fps <= 10'000, "rates are in range");
  require(info.rows > 0 && info.first_frame <= info.last_frame, "there are frames");
  require(info.people > 0 && info.people <= info.rows, "there are people");
  for (const std::string& assumption : info.assumptions)
    require(assumption.ends_with('.'), "assumptions are sentences");
}

}  // namespace

void check_recording(const std::filesystem::path& file, const detail::TrajectoryOptions& options) {
  try {
    const auto reader = detail::open_trajectory(file, options);
    const detail::TrajectoryInfo& info = reader->info();
    check_info(info);
    std::int64_t frame = 0, last = INT64_MIN;
    std::uint64_t rows = 0;
    for (std::vector<detail::TrackedPerson> people; reader->next(frame, people); last = frame) {
      require(frame > last, "frames ascend");
      require(frame >= info.first_frame && frame <= info.last_frame,
              "frames are within those that were told");
      check_people(people, info.motions.size());
      rows += people.size();
    }
    require(rows == info.rows && last == info.last_frame, "all rows are read");
  } catch (const detail::TrajectoryError& error) {
    const std::string message = error.what();
    require(message.starts_with(file.string()), "errors name the file");
    for (const char c : message)
      require(static_cast<unsigned char>(c) >= ' ' && c != '\x7f', "errors are a line");
  }
}

}  // namespace bch::fuzz
