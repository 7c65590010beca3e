// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include <bch/files.hpp>
#include <bch/poses.hpp>
#include <bch/scene_plan.hpp>
#include <bch/shapes.hpp>

#include "bench/characters/baking.hpp"
#include "bench/ratios/ratios.hpp"
#include "bench/workload/scene.hpp"
#include "kernel/runtime/all_options.hpp"

namespace bch::bench {
namespace {

/// A set of poses by a plan, and what makes it anew.
class Baked {
 public:
  Baked(Scene& scene, const ShapeSetPlan& plan, std::vector<PoseId> sources)
      : plan_(plan), sources_(std::move(sources)), prepared_(plan) {
    for (const cli::LoadedCharacter& character : scene.characters())
      shape_builders_.emplace_back(character.character, plan, leaf_threshold);
    set_.emplace(build());
  }

  ShapeSet build() {
    ShapeSetBuilder builder(plan_, sources_.size());
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      prepared_.prepare(shape_builders_[sources_[i].character].shape(sources_[i].at), i);
      builder.add(prepared_);
    }
    return std::move(builder).finish();
  }

  const ShapeSetPlan& plan() const { return plan_; }
  const ShapeSet& set() const { return *set_; }

  Contender contender() {
    const auto bytes = static_cast<double>(set_->bytes()) / set_->shape_count();
    return {[this] { build(); }, sources_.size(), {{"bytes", bytes}}};
  }

 private:
  ShapeSetPlan plan_;
  std::vector<PoseId> sources_;
  std::vector<ShapeBuilder> shape_builders_;
  BuiltShape prepared_;
  std::optional<ShapeSet> set_;
};

std::function<std::uint32_t(double)> always(std::uint32_t depth) {
  return [depth](double) { return depth; };
}

/// Who looks stands in the middle of the crowd, 58 m wide.
std::uint32_t by_distance(double metres) {
  return metres < 20 ? all_depths : 0;
}

/// The scene's crowd, and its shapes and levels as a plan for it has them.
struct Planned {
  const Workload& workload;
  SceneRequirements requirements;
  ScenePlan plan;
  Baked baked;

  Planned(Scene& scene, const SceneRequirements& of)
      : workload(scene.workload("crowd")),
        requirements(of),
        plan(plan_of(scene)),
        baked(scene, plan.set, plan.shapes) {}

  ScenePlan plan_of(Scene& scene) const {
    const cli::Crowd& crowd = workload.crowd;
    std::vector<ScenePlan::Agent> agents;
    for (std::size_t i = 0; i < crowd.size(); ++i)
      agents.push_back({scene.sources()[crowd.shape[i]],
                        std::hypot(crowd.x[i] - 0.5 * crowd.side, crowd.y[i] - 0.5 * crowd.side)});
    return plan_scene(agents, requirements);
  }

  /// Answers are compared with the reference's over the scene's own shapes.
  Contender query(Scene& scene) const {
    const cli::Crowd& crowd = workload.crowd;
    const detail::AllOptions query{.leaves = requirements.outlines ? Leaves::segments : Leaves::discs};
    return collide_contender(baked.set(),
                             {plan.agent_shape, crowd.x, crowd.y, crowd.heading, plan.agent_level},
                             workload.pairs, query, [&](const Hits& hits) {
                               return wrong_answers({scene.shapes(), plan.set, query.leaves},
                                                    crowd.at_level(plan.agent_level), workload.pairs, hits);
                             });
  }
};

void add_plan(Scene& scene, const std::string& name, const SceneRequirements& requirements) {
  const auto planned =
      once([&scene, requirements] { return std::make_shared<Planned>(scene, requirements); });
  add(name + "/bake", [planned] { return planned().baked.contender(); });
  add(name + "/query", [planned, &scene] { return planned().query(scene); });
}

/// A file in the file cache, by either way.
Contender load_contender(Scene& scene, FileAccess access) {
  const auto file = std::filesystem::temp_directory_path() / fmt::format("bch_ratios_{}.bch", getpid());
  cli::bake_file(file, scene.characters(), scene.sources(), double{leaf_threshold}, {});
  const std::shared_ptr<const std::filesystem::path> kept(new std::filesystem::path(file),
                                                          [](const std::filesystem::path* path) {
                                                            std::error_code ignored;
                                                            std::filesystem::remove(*path, ignored);
                                                            delete path;
                                                          });
  return {[kept, access] { benchmark::DoNotOptimize(load_baked(*kept, access)); },
          1,
          {{"shapes", static_cast<double>(scene.sources().size())},
           {"bytes", static_cast<double>(std::filesystem::file_size(file))}}};
}

}  // namespace

void add_sets(Scene& scene) {
  add("load/map", [&scene] { return load_contender(scene, FileAccess::map); });
  add("load/read", [&scene] { return load_contender(scene, FileAccess::read); });
  add_plan(scene, "plans/single_cylinder", {.depth = always(0)});
  add_plan(scene, "plans/depth_3", {.depth = always(3)});
  add_plan(scene, "plans/depth_6", {.depth = always(6)});
  add_plan(scene, "plans/all", {});
  add_plan(scene, "plans/mixed", {.depth = by_distance});
  add_plan(scene, "plans/all_discs", {.outlines = false});
  add_plan(scene, "plans/one_frame", {.outlines = false, .pairs_per_shape = 0});
}

}  // namespace bch::bench
