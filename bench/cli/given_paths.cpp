// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/cli/place.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "kernel/recordings/walkers.hpp"

namespace bch::cli {
namespace {

/// A path that is read: when it began, and its keys since.
struct BegunPath {
  double begin;
  std::vector<PathKey> keys;

  /// Adds a place, to which the person turns by less than a half turn.
  void add(double time, const detail::Walker& at) {
    double heading = at.heading;
    if (!keys.empty())
      heading = keys.back().heading + std::remainder(heading - keys.back().heading, 2 * std::numbers::pi);
    keys.push_back({time - begin, at.x, at.y, heading});
  }
};

/// Lets a path end at a time.
void end_at(double seconds, std::vector<PathKey>& keys) {
  PathKey last = bench::at(keys, seconds);
  last.time = seconds;
  while (!keys.empty() && keys.back().time >= seconds) keys.pop_back();
  keys.push_back(last);
}

void set_area(GivenPaths& given) {
  PathKey low = given.paths[0].keys[0], high = low;
  for (const bench::GivenPath& path : given.paths)
    for (const PathKey& key : path.keys) {
      low.x = std::min(low.x, key.x), low.y = std::min(low.y, key.y);
      high.x = std::max(high.x, key.x), high.y = std::max(high.y, key.y);
    }
  given.width = std::max(1.0, high.x - low.x), given.depth = std::max(1.0, high.y - low.y);
}

/// Opens a recording. What its message asks to be given by an option of `bch check` stands in the file here.
std::unique_ptr<detail::TrajectoryReader> opened(const std::string& file) {
  try {
    return detail::open_trajectory(file);
  } catch (const detail::TrajectoryError& error) {
    const std::string message = error.what();
    const std::size_t advice = message.rfind(": --");
    if (advice == std::string::npos) throw;
    throw detail::TrajectoryError(
        message.substr(0, advice) +
        ": --paths needs it in the file, such as CSV with the header id,time,x,y, in "
        "seconds and metres");
  }
}

}  // namespace

GivenPaths read_paths(const std::string& file, double seconds) {
  const std::unique_ptr<detail::TrajectoryReader> reader = opened(file);
  detail::WalkerReader walkers(*reader);
  std::map<std::int64_t, BegunPath> begun;
  for (detail::WalkerFrame frame; walkers.next(frame);) {
    const double time = static_cast<double>(frame.frame) / reader->info().fps;
    for (const detail::Walker& walker : frame.people) {
      BegunPath& path = begun.try_emplace(walker.id, BegunPath{time, {}}).first->second;
      if (path.keys.empty() || path.keys.back().time < seconds) path.add(time, walker);
    }
  }
  GivenPaths given{{}, reader->info().assumptions};
  for (auto& [id, path] : begun) {
    end_at(seconds, path.keys);
    given.paths.push_back({id, std::move(path.keys)});
  }
  set_area(given);
  return given;
}

}  // namespace bch::cli
