// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <bch/crowd.hpp>
#include <bch/poses.hpp>
#include <bch/scene_plan.hpp>
#include <bch/shapes.hpp>

#include "bench/base/median.hpp"
#include "bench/base/stopwatch.hpp"
#include "bench/base/text.hpp"
#include "bench/characters/walking_crowd.hpp"
#include "bench/ratios/ratios.hpp"

namespace bch::bench {
namespace {

constexpr double live_density = 1;  ///< agents a square metre
constexpr int frames_until_places_fit = 30;

/// A crowd in which every character is posed anew in every frame: an example of how a simulator that does so uses
/// the library. Each agent has a shape of its own, which is skinned, outlined, divided and put into the set's arrays
/// while other threads do so with others.
class LiveCrowd {
 public:
  LiveCrowd(Scene& scene, std::uint32_t agents, std::uint32_t depth)
      : scene_(scene),
        plan_{.depths = {depth}, .culling = false},  // no shape is in enough pairs for those
        crowd_(scene.characters(), agents, live_density, 72),
        shapes_(first_shapes()),
        workshops_([this] { return Workshop(scene_, plan_); }),
        outgrown_(agents) {}

  /// Computes the next frame. Runs in the caller's TBB arena.
  void step() {
    crowd_.step();
    const Stopwatch watch(0);
    build_shapes();
    const double built = watch.nanoseconds();
    pairs_ = finder_.candidates(shapes_.set(), crowd_.crowd().agents()).span();
    const double found = watch.nanoseconds();
    hits_.resize(pairs_.size());
    collide(shapes_.set(), crowd_.crowd().agents(), pairs_, hits_);
    shapes_ms.push_back(built / 1e6), pairs_ms.push_back((found - built) / 1e6);
    answers_ms.push_back((watch.nanoseconds() - found) / 1e6);
  }

  /// Compares answers with those for a set that is built from the same poses, with everything that a set can have.
  void require_right() {
    std::vector<Shape> all;
    Workshop workshop(scene_, {});
    for (const ShapeSource& source : crowd_.poses())
      all.push_back(workshop.shapers[source.character].shape(source.at));
    Hits hits(pairs_.size());
    collide(ShapeSet(all, {.depths = plan_.depths}), crowd_.crowd().agents(), pairs_, hits);
    if (hits != hits_) throw std::runtime_error("a set whose shapes were replaced answers unlike a new one");
  }

  std::map<std::string, double> counters() const {
    return {{"shapes_ms", cli::median(shapes_ms)},
            {"pairs_ms", cli::median(pairs_ms)},
            {"answers_ms", cli::median(answers_ms)},
            {"pairs", static_cast<double>(pairs_.size())},
            {"hits", static_cast<double>(std::ranges::count(hits_, 1))}};
  }

 private:
  /// Holds memory that a thread keeps from shape to shape.
  struct Workshop {
    std::vector<PoseShaper> shapers;
    PreparedShape prepared;

    Workshop(Scene& scene, const ShapeSetPlan& plan) : prepared(plan) {
      for (const cli::LoadedCharacter& loaded : scene.characters())
        shapers.emplace_back(loaded.character, plan, leaf_threshold);
    }
    const PreparedShape& make(const ShapeSource& source, std::uint32_t shape) {
      prepared.prepare(shapers[source.character].shape(source.at), shape);
      return prepared;
    }
  };

  ShapeSet first_shapes() const {
    Workshop workshop(scene_, plan_);
    ShapeSetBuilder builder(plan_, crowd_.poses().size());
    for (std::uint32_t i = 0; i < crowd_.poses().size(); ++i)
      builder.add(workshop.make(crowd_.poses()[i], i));
    return std::move(builder).finish();
  }

  void build_shapes() {
    const auto count = static_cast<std::uint32_t>(crowd_.poses().size());
    tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t i) {
      outgrown_[i] = !shapes_.try_replace(i, workshops_.local().make(crowd_.poses()[i], i));
    });
    // Rare after the first frames; the arrays may move, so one after the other.
    for (std::uint32_t i = 0; i < count; ++i)
      if (outgrown_[i]) shapes_.replace(i, workshops_.local().make(crowd_.poses()[i], i));
  }

  Scene& scene_;
  ShapeSetPlan plan_;
  cli::WalkingCrowd crowd_;
  DynamicShapeSet shapes_;
  tbb::enumerable_thread_specific<Workshop> workshops_;
  std::vector<std::uint8_t> outgrown_;  ///< per shape: it needs a larger place
  bch::Crowd finder_;
  std::span<const Pair> pairs_;
  Hits hits_;
  std::vector<double> shapes_ms, pairs_ms, answers_ms;  ///< of frames
};

}  // namespace

void add_live(Scene& scene) {
  const int threads = tbb::info::default_concurrency();
  for (const std::uint32_t agents : {300u, 1000u})
    for (const std::uint32_t depth : {all_depths, 6u, 3u, 0u})
      add(
          fmt::format("live/{}/{}", agents, cli::depth_name(depth)),
          [&scene, agents, depth, threads]() -> Contender {
            const auto crowd = std::make_shared<LiveCrowd>(scene, agents, depth);
            tbb::task_arena arena(threads);
            arena.execute([&] {
              for (int i = 0; i < frames_until_places_fit; ++i) crowd->step();
            });
            crowd->require_right();
            return {[crowd] { crowd->step(); }, 1, crowd->counters()};
          },
          threads);
}

}  // namespace bch::bench
