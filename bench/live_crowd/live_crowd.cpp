// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/live_crowd/live_crowd.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <cmath>

#include <bch/collide.hpp>

#include "bench/base/stopwatch.hpp"
#include "layout/base/heading.hpp"
#include "layout/base/random.hpp"

namespace bch::bench {
namespace {

constexpr double density = 1;       ///< agents a square metre
constexpr double speed = 1.3;       ///< metres a second
constexpr float threshold = 0.01f;  ///< metres

std::vector<ShapeSource> random_sources(std::span<const Character> characters, std::uint32_t agents) {
  detail::Random random(71);
  std::vector<ShapeSource> sources;
  for (std::uint32_t i = 0; i < agents; ++i) {
    const std::uint32_t character = random.below(static_cast<std::uint32_t>(characters.size()));
    const auto& clips = characters[character].clips;
    PoseTime at;
    if (!clips.empty()) {
      at.clip = random.below(static_cast<std::uint32_t>(clips.size()));
      at.seconds = static_cast<float>(random.uniform(static_cast<double>(clips[at.clip].seconds)));
    }
    sources.push_back({character, at});
  }
  return sources;
}

}  // namespace

LiveCrowd::Workshop::Workshop(std::span<const Character> characters, const ShapeSetPlan& plan)
    : prepared(plan) {
  for (const Character& character : characters) shapers.emplace_back(character, plan, threshold);
}

const PreparedShape& LiveCrowd::Workshop::make(const ShapeSource& source, std::uint32_t shape) {
  prepared.prepare(shapers[source.character].shape(source.at), shape);
  return prepared;
}

LiveCrowd::LiveCrowd(std::span<const Character> characters, std::uint32_t agents, std::uint32_t depth)
    : characters_(characters),
      plan_{.depths = {depth}, .culling = false},  // no shape is in enough pairs for those
      crowd_(cli::place_crowd(agents, density, 1, 72)),
      sources_(random_sources(characters, agents)),
      shapes_(first_shapes()),
      workshops_([this] { return Workshop(characters_, plan_); }),
      outgrown_(agents) {
  for (std::uint32_t i = 0; i < agents; ++i) crowd_.shape[i] = i;
}

ShapeSet LiveCrowd::first_shapes() const {
  Workshop workshop(characters_, plan_);
  ShapeSetBuilder builder(plan_, sources_.size());
  for (std::uint32_t i = 0; i < sources_.size(); ++i) builder.add(workshop.make(sources_[i], i));
  return std::move(builder).finish();
}

FrameTime LiveCrowd::step(double seconds) {
  walk(seconds);
  const Stopwatch watch(0);
  build_shapes();
  const double built = watch.nanoseconds();
  pairs_ = broad_phase_.find(shapes_.set(), agents());
  const double found = watch.nanoseconds();
  hits_.resize(pairs_.size());
  collide(shapes_.set(), agents(), pairs_, hits_);
  return {1e-9 * built, 1e-9 * (found - built), 1e-9 * (watch.nanoseconds() - found)};
}

/// Who leaves the square comes in again on the other side.
void LiveCrowd::walk(double seconds) {
  for (std::size_t i = 0; i < crowd_.size(); ++i) {
    const detail::Rotation ahead = detail::rotation(crowd_.heading[i]);
    const auto wrap = [&](double x) { return x - crowd_.side * std::floor(x / crowd_.side); };
    crowd_.x[i] = wrap(crowd_.x[i] + speed * seconds * ahead.cosine);
    crowd_.y[i] = wrap(crowd_.y[i] + speed * seconds * ahead.sine);
    PoseTime& at = sources_[i].at;
    if (at.clip == PoseTime::rest) continue;
    const auto length = static_cast<double>(characters_[sources_[i].character].clips[at.clip].seconds);
    at.seconds = static_cast<float>(std::fmod(static_cast<double>(at.seconds) + seconds, length));
  }
}

void LiveCrowd::build_shapes() {
  const auto count = static_cast<std::uint32_t>(sources_.size());
  tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t i) {
    outgrown_[i] = !shapes_.try_replace(i, workshops_.local().make(sources_[i], i));
  });
  // Rare after the first frames; the arrays may move, so one after the other.
  for (std::uint32_t i = 0; i < count; ++i)
    if (outgrown_[i]) shapes_.replace(i, workshops_.local().make(sources_[i], i));
}

std::vector<std::uint8_t> LiveCrowd::hits_of_a_new_set() const {
  std::vector<PoseShaper> shapers;
  for (const Character& character : characters_) shapers.emplace_back(character, ShapeSetPlan(), threshold);
  std::vector<Shape> shapes;
  for (const ShapeSource& source : sources_) shapes.push_back(shapers[source.character].shape(source.at));
  std::vector<std::uint8_t> hits(pairs_.size());
  collide(ShapeSet(shapes, {.depths = plan_.depths}), agents(), pairs_, hits);
  return hits;
}

}  // namespace bch::bench
