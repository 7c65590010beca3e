// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <bch/pose_shape.hpp>
#include <bch/scene_plan.hpp>
#include <bch/shape_set_builder.hpp>

#include "bench/ratios/ratios.hpp"
#include "bench/workload/answer_checks.hpp"

namespace bch::bench {
namespace {

std::function<std::uint32_t(double)> always(std::uint32_t depth) {
  return [depth](double) { return depth; };
}

/// Who looks stands in the middle of the crowd, 58 m wide.
std::uint32_t by_distance(double metres) {
  return metres < 5 ? all_depths : metres < 10 ? 6 : metres < 20 ? 3 : 0;
}

struct PlanRow {
  const char* name;
  SceneUse use;
};

const std::vector<PlanRow>& plan_rows() {
  static const std::vector<PlanRow> all = {
      {"single cylinder", {.depth = always(0)}},
      {"depth 3", {.depth = always(3)}},
      {"depth 6", {.depth = always(6)}},
      {"all", {}},
      {"mixed: all to 5 m, 6 to 10 m, 3 to 20 m, then 0", {.depth = by_distance}},
      {"all, solid", {.solid = true}},
      {"all, discs as leaves", {.leaves = Leaves::discs}},
      {"all, discs, without culling data: shapes of one frame",
       {.leaves = Leaves::discs, .pairs_per_shape = 0}},
  };
  return all;
}

/// The scene's crowd, as a plan for it has it.
class Planned {
 public:
  Planned(Scene& scene, const PlanRow& row)
      : workload_(scene.workload("crowd")),
        query_{row.use.solid ? Semantics::solid : Semantics::boundary, nullptr, row.use.leaves} {
    const cli::Crowd& crowd = workload_.crowd;
    std::vector<SceneAgent> agents;
    for (std::size_t i = 0; i < crowd.size(); ++i)
      agents.push_back({scene.sources()[crowd.shape[i]],
                        std::hypot(crowd.x[i] - 0.5 * crowd.side, crowd.y[i] - 0.5 * crowd.side)});
    plan_ = plan_scene(agents, row.use);
    for (const cli::LoadedCharacter& character : scene.characters())
      shapers_.emplace_back(character.character, plan_.set, leaf_threshold);
    prepared_.emplace(plan_.set);
    set_.emplace(build());
    hits_.resize(workload_.pairs.size());
    answer();
    // Against the reference over the scene's own shapes.
    require_right(row.name, workload_,
                  wrong_answers({scene.shapes(), plan_.set, query_.leaves}, crowd.at_level(plan_.agent_level),
                                workload_.pairs, hits_, query_.semantics));
  }

  ShapeSet build() {
    ShapeSetBuilder builder(plan_.set, plan_.shapes.size());
    for (std::size_t i = 0; i < plan_.shapes.size(); ++i) {
      prepared_->prepare(shapers_[plan_.shapes[i].character].shape(plan_.shapes[i].at, plan_.shapes[i].whole),
                         i);
      builder.add(*prepared_);
    }
    return std::move(builder).finish();
  }

  void answer() { collide(*set_, agents(), workload_.pairs, hits_, query_); }

  std::size_t shapes() const { return plan_.shapes.size(); }
  std::size_t pairs() const { return workload_.pairs.size(); }
  double bytes_per_shape() const {
    return static_cast<double>(set_->bytes()) / static_cast<double>(shapes());
  }

 private:
  Agents agents() const {
    const cli::Crowd& crowd = workload_.crowd;
    return {plan_.agent_shape, crowd.x, crowd.y, crowd.heading, plan_.agent_level};
  }

  const Workload& workload_;
  const QueryOptions query_;
  ScenePlan plan_;
  std::vector<PoseShaper> shapers_;
  std::optional<PreparedShape> prepared_;
  std::optional<ShapeSet> set_;
  Hits hits_;
};

std::string plan_name(std::size_t row, std::string_view what) {
  return fmt::format("plans/{}/{}", row, what);
}

void print_plans(const Results& results) {
  fmt::print(
      "\n| plan of a scene: a crowd, one thread | bytes per shape | us to bake a shape | ns per pair "
      "|\n|---|---|---|---|\n");
  for (std::size_t i = 0; i < plan_rows().size(); ++i) {
    const Timing &bake = results.at(plan_name(i, "bake")), &query = results.at(plan_name(i, "query"));
    fmt::print("| {} | {:.0f} | {:.1f} | {:.1f} |\n", plan_rows()[i].name,
               bake.counters.at("bytes_per_shape"), bake.nanoseconds / 1e3, query.nanoseconds);
  }
}

}  // namespace

std::vector<Table> plan_tables(Suite& suite, Scene& scene) {
  for (std::size_t i = 0; i < plan_rows().size(); ++i) {
    const Shared<Planned> plan([&scene, i] { return std::make_shared<Planned>(scene, plan_rows()[i]); });
    suite.add(plan_name(i, "bake"), [plan]() -> Contender {
      return {[kept = plan.get()] { kept->build(); },
              plan.get()->shapes(),
              {{"bytes_per_shape", plan.get()->bytes_per_shape()}}};
    });
    suite.add(plan_name(i, "query"), [plan]() -> Contender {
      return {[kept = plan.get()] { kept->answer(); }, plan.get()->pairs()};
    });
  }
  return {{"plans", "^plans/", print_plans}};
}

}  // namespace bch::bench
