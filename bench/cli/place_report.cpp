// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/cli/place.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "bench/base/csv_input.hpp"
#include "bench/base/text.hpp"

namespace bch::cli {
namespace {

double per_square_metre(const PlaceRun& run) {
  return static_cast<double>(run.placement.people.size()) / (run.area.width * run.area.depth);
}

nlohmann::ordered_json json_of(const PlaceRun& run, const bench::PlacedPerson& person) {
  const bench::PlacedClip& clip = run.clips[person.clip];
  auto path = nlohmann::ordered_json::array();
  for (const PathKey& key : person.path) path.push_back({key.time, key.x, key.y, key.heading});
  return {{"id", person.id},
          {"character", clip.character},
          {"clip", clip.name},
          {"clip_begin", person.clip_begin},
          {"path", path}};
}

/// The time in a clip that goes round.
double clip_time(const bench::PlacedClip& clip, const bench::PlacedPerson& person, double time) {
  const double since = time - person.clip_begin;
  return clip.body.loops() ? std::fmod(since, clip.seconds) : std::min(since, clip.seconds);
}

}  // namespace

std::string text_report(const PlaceRun& run) {
  const bench::PlacingOptions& area = run.area;
  std::string out = fact("area", fmt::format("{:g} m x {:g} m, {:g} s, seed {}", area.width, area.depth,
                                             area.seconds, area.seed));
  if (!area.paths.empty())
    out += fact("paths", fmt::format("{} of {}", area.paths.size(), run.options.paths));
  for (const std::string& assumption : run.assumptions) out += fact("", assumption);
  for (const bench::PlacedClip& clip : run.clips)
    out += fact("clip", fmt::format("{}, {}: {:.2f} m/s, {:.0f} kB", clip.character, clip.name, clip.speed,
                                    static_cast<double>(clip.body.bytes()) / 1e3));
  out += fact("build", fmt::format("{:.1f} s for {}", run.build_seconds, counted(run.clips.size(), "clip"))) +
         fact("people", fmt::format("{}, {:.2f} per m2, of {} in {:.2f} s", run.placement.people.size(),
                                    per_square_metre(run), counted(run.placement.candidates, "candidate"),
                                    run.search_seconds));
  return out;
}

nlohmann::ordered_json json_report(const PlaceRun& run) {
  const bench::PlacingOptions& area = run.area;
  nlohmann::ordered_json json{{"width", area.width},     {"depth", area.depth},
                              {"seconds", area.seconds}, {"seed", area.seed},
                              {"tries", area.tries},     {"build_seconds", run.build_seconds}};
  json["people"] = run.placement.people.size();
  json["people_per_square_metre"] = per_square_metre(run);
  json["candidates"] = run.placement.candidates;
  json["search_seconds"] = run.search_seconds;
  json["placed"] = nlohmann::ordered_json::array();
  for (const bench::PlacedPerson& person : run.placement.people)
    json["placed"].push_back(json_of(run, person));
  return json;
}

std::string csv_report(const PlaceRun& run) {
  std::string out = "id,time,x,y,stature,heading,character,clip,clip_time\n";
  const auto& people = run.placement.people;
  const auto time_of = [&](std::uint64_t frame) { return static_cast<double>(frame) / run.options.fps; };
  for (std::uint64_t frame = 0; time_of(frame) <= run.area.seconds; ++frame) {
    const double time = time_of(frame);
    for (const bench::PlacedPerson& person : people) {
      const bench::PlacedClip& clip = run.clips[person.clip];
      const PathKey key = bench::at(person.path, time);
      fmt::format_to(std::back_inserter(out), "{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{},{},{:.6f}\n",
                     person.id, time, key.x, key.y, clip.stature, key.heading, csv_field(clip.character),
                     csv_field(clip.name), clip_time(clip, person, time));
    }
  }
  return out;
}

}  // namespace bch::cli
