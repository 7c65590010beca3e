// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/shape_table.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <chrono>
#include <stdexcept>

#include "bench/exit_codes.hpp"
#include "bench/progress.hpp"
#include "layout/skinning.hpp"
#include "layout/union_outline.hpp"

namespace bch::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point begin, Clock::time_point end) {
  return std::chrono::duration<double>(end - begin).count();
}

struct Timing {
  double outline = 0;
  double hierarchy = 0;
};

Timing build(const LoadedCharacter& from, Skinner& skinner, PoseTime at, double threshold, Shape& shape) {
  try {
    const auto begin = Clock::now();
    shape.outline = union_outline(skinner.pose(at), from.character.triangles);
    const auto middle = Clock::now();
    shape.hierarchy = contour_hierarchy(shape.outline, static_cast<float>(threshold));
    return {seconds_between(begin, middle), seconds_between(middle, Clock::now())};
  } catch (const std::logic_error& error) {
    // Out of the domain: a pose kilometres wide, say. domain_error, invalid_argument and length_error are all
    // logic errors.
    throw InputError(
        fmt::format("{}: {} at {} s: {}", from.source, clip_name(from, at), at.seconds, error.what()));
  }
}

}  // namespace

std::vector<ShapeSource> list_shapes(std::span<const LoadedCharacter> characters, std::uint32_t poses) {
  std::vector<ShapeSource> sources;
  for (std::uint32_t c = 0; c < characters.size(); ++c)
    for (const PoseTime at : sample_poses(characters[c].character, poses)) sources.push_back({c, at});
  return sources;
}

std::string clip_name(const LoadedCharacter& character, PoseTime at) {
  return at.clip == PoseTime::rest ? "rest pose" : character.character.clips[at.clip].name;
}

BuiltShapes build_shapes(std::span<const LoadedCharacter> characters, std::span<const ShapeSource> sources,
                         double threshold) {
  BuiltShapes built;
  built.shapes.resize(sources.size());
  std::vector<Timing> timings(sources.size());
  Progress progress("building shapes", sources.size());

  // Tens of milliseconds a shape: a task each balances best, and its own skinner costs nothing beside.
  tbb::parallel_for(std::size_t{0}, sources.size(), [&](std::size_t i) {
    const LoadedCharacter& from = characters[sources[i].character];
    Skinner skinner(from.character);
    timings[i] = build(from, skinner, sources[i].at, threshold, built.shapes[i]);
    progress.advance();
  });

  const double count = std::max(1.0, static_cast<double>(sources.size()));
  for (const Timing& timing : timings) {
    built.outline_seconds += timing.outline / count;
    built.hierarchy_seconds += timing.hierarchy / count;
  }
  return built;
}

}  // namespace bch::cli
