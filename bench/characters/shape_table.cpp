// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/characters/shape_table.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "bench/base/exit_codes.hpp"
#include "bench/base/progress.hpp"
#include "bench/base/text.hpp"
#include "kernel/runtime/spares.hpp"
#include "kernel/runtime/tasks.hpp"
#include "layout/base/random.hpp"

namespace bch::cli {
namespace {

constexpr double max_shapes = 1e7;

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point begin, Clock::time_point end) {
  return std::chrono::duration<double>(end - begin).count();
}

}  // namespace

std::vector<PoseId> list_shapes(std::span<const LoadedCharacter> characters, std::uint32_t poses) {
  std::vector<PoseId> sources;
  for (std::uint32_t c = 0; c < characters.size(); ++c)
    for (const PoseTime at : sample_poses(characters[c].character, poses)) sources.push_back({c, at});
  return sources;
}

std::vector<PoseId> list_random_shapes(std::span<const LoadedCharacter> characters, std::uint32_t poses,
                                       std::uint64_t seed) {
  constexpr std::uint32_t finer = 100;  // a random time is one of so many even ones a pose
  detail::Random random(seed);
  std::vector<PoseId> sources;
  for (std::uint32_t c = 0; c < characters.size(); ++c) {
    const Character& character = characters[c].character;
    const std::vector<PoseTime> even = sample_poses(character, finer * poses);
    const std::uint32_t count = character.clips.empty() ? 1 : poses;
    for (std::uint32_t i = 0; i < count; ++i)
      sources.push_back({c, even[random.below(static_cast<std::uint32_t>(even.size()))]});
  }
  return sources;
}

std::vector<PoseId> list_shapes_at_rate(std::span<const LoadedCharacter> characters, double rate) {
  std::vector<PoseId> sources;
  for (std::uint32_t c = 0; c < characters.size(); ++c) {
    const auto& clips = characters[c].character.clips;
    if (clips.empty()) sources.push_back({c, {}});
    for (std::uint32_t k = 0; k < clips.size(); ++k) {
      const double poses = std::max(1.0, std::floor(static_cast<double>(clips[k].seconds) * rate));
      if (static_cast<double>(sources.size()) + poses > max_shapes)
        throw InputError(
            fmt::format("{}: more than {} poses at {} a second", characters[c].source, max_shapes, rate));
      for (double i = 0; i < poses; ++i) sources.push_back({c, {k, static_cast<float>(i / rate)}});
    }
  }
  return sources;
}

PoseId source_at(const LoadedCharacter& from, const std::string& name, double seconds) {
  const auto& clips = from.character.clips;
  for (std::uint32_t i = 0; i < clips.size(); ++i) {
    if (clips[i].name != name) continue;
    if (!(seconds >= 0 && seconds <= static_cast<double>(clips[i].seconds)))
      throw InputError(fmt::format("{}: clip '{}' lasts {} s and has no time {} s", from.source, name,
                                   clips[i].seconds, seconds));
    return {0, {i, static_cast<float>(seconds)}};
  }
  throw InputError(fmt::format("{}: has no clip '{}' ({})", from.source, name,
                               clips.empty()
                                   ? std::string("nor any other")
                                   : counted(clips.size(), "clip") + ", see bch inspect without --clip"));
}

std::string clip_name(const LoadedCharacter& character, PoseTime at) {
  return at.clip == PoseTime::rest ? "rest pose" : character.character.clips[at.clip].name;
}

namespace {

[[noreturn]] void reject(const LoadedCharacter& character, PoseTime at, const std::string& reason) {
  throw InputError(
      fmt::format("{}: {} at {} s: {}", character.source, clip_name(character, at), at.seconds, reason));
}

}  // namespace

void require_contours(const LoadedCharacter& from, PoseTime at, const Shape& shape,
                      const CostLimits& limits) {
  const std::size_t contours = shape.outline.contours();
  if (contours > limits.contours)
    reject(from, at,
           "its outline has " + beyond_limit(contours, "contours", limits.contours, "--max-contours"));
}

namespace {

struct ShapeTiming {
  double outline = 0;    ///< seconds: skinning and outline
  double hierarchy = 0;  ///< seconds
};

/// Makes shapes one after the other; prepares a character's mesh when it is first asked for it.
struct ShapeMaker {
  std::span<const LoadedCharacter> characters;
  double threshold;
  const ShapeSetPlan& plan;
  const CostLimits& limits;
  std::vector<std::optional<ShapeBuilder>> shape_builders{characters.size()};

  ShapeTiming make(const PoseId& source, Shape& made) {
    const LoadedCharacter& from = characters[source.character];
    auto& shape_builder = shape_builders[source.character];
    try {
      if (!shape_builder) {
        shape_builder.emplace(from.character, plan, static_cast<float>(threshold));
        shape_builder->limit_nodes(limits.nodes);
      }
      const auto begin = Clock::now();
      const Shape& shape = shape_builder->make_outline(source.at);
      require_contours(from, source.at, shape, limits);
      const auto middle = Clock::now();
      shape_builder->make_hierarchy();
      const ShapeTiming timing{seconds_between(begin, middle), seconds_between(middle, Clock::now())};
      made = shape;
      return timing;
    } catch (const std::length_error& error) {
      reject(from, source.at, std::string(error.what()) + "; --max-nodes raises the limit");
    } catch (const std::logic_error& error) {
      // Out of the domain: a pose kilometres wide, say. domain_error and invalid_argument are both logic errors.
      reject(from, source.at, error.what());
    }
  }
};

}  // namespace

BuiltShapes build_shapes(std::span<const LoadedCharacter> characters, std::span<const PoseId> sources,
                         double threshold, const ShapeSetPlan& plan, const CostLimits& limits) {
  BuiltShapes built;
  built.shapes.resize(sources.size());
  std::vector<ShapeTiming> timings(sources.size());
  Progress progress("building shapes", sources.size());

  // Learning a mesh takes as long as tens of shapes, so that a thread keeps what it learned.
  detail::Spares<ShapeMaker> makers;
  detail::run_each(sources.size(), [&](std::size_t i) {
    const auto maker = makers.borrow([&] { return ShapeMaker{characters, threshold, plan, limits}; });
    timings[i] = maker->make(sources[i], built.shapes[i]);
    progress.advance();
  });

  const double count = std::max(1.0, static_cast<double>(sources.size()));
  for (const ShapeTiming& timing : timings) {
    built.outline_seconds += timing.outline / count;
    built.hierarchy_seconds += timing.hierarchy / count;
  }
  return built;
}

}  // namespace bch::cli
