// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <array>
#include <memory>
#include <optional>

#include <bch/collide.hpp>
#include <bch/pose_shape.hpp>
#include <bch/scene_plan.hpp>
#include <bch/shape_set_builder.hpp>

#include "baselines/slab_bodies.hpp"
#include "bench/ratios/ratios.hpp"
#include "bench/workload/answer_checks.hpp"

namespace bch::bench {
namespace {

constexpr std::array workloads = {std::string_view("crowd"), std::string_view("near_miss"),
                                  std::string_view("colliding")};

/// What a number of slabs may cost, times the whole body: time in a crowd with discs and with segments, time to build; and bytes.
struct SliceRow {
  std::uint32_t slabs;
  double discs, segments, build;
  double bytes;  ///< 0: nothing is asked of the row
};
constexpr SliceRow slice_rows[] = {
    {1, 0, 0, 0, 0},           {2, 0, 0, 0, 0}, {3, 2.0, 2.4, 2.2, 15 * 1024}, {4, 2.8, 3.3, 2.8, 19 * 1024},
    {8, 5, 6, 4.5, 36 * 1024},
};

/// The scene's poses in slabs.
class Sliced {
 public:
  Sliced(Scene& scene, const SliceRow& row) : scene_(scene), row_(row) {
    for (const cli::LoadedCharacter& character : scene.characters())
      shapers_.emplace_back(character.character, plan(), leaf_threshold);
    prepared_.emplace(plan());
    set_.emplace(build());
  }

  ShapeSetPlan plan() const { return {.slices = standing_slices(row_.slabs)}; }

  const Shape& shape(const ShapeSource& source) { return shapers_[source.character].shape(source.at); }

  ShapeSet build() {
    ShapeSetBuilder builder(plan(), scene_.sources().size());
    for (std::size_t i = 0; i < scene_.sources().size(); ++i) {
      prepared_->prepare(shape(scene_.sources()[i]), i);
      builder.add(*prepared_);
    }
    return std::move(builder).finish();
  }

  /// Answers, after they were compared with those pair by pair of parts.
  Contender query(const Workload& workload, Leaves leaves) {
    const QueryOptions query{.semantics = Semantics::solid, .leaves = leaves};
    const auto hits = std::make_shared<Hits>(workload.pairs.size());
    collide(*set_, workload.agents(), workload.pairs, *hits, query);
    const baselines::SlabBodies reference(scene_.shapes_in_slabs(row_.slabs), plan(), leaves);
    std::size_t count = 0;
    for (std::size_t i = 0; i < hits->size(); ++i) {
      count += (*hits)[i];
      if ((*hits)[i] !=
          reference.collide(workload.agents(), workload.pairs[i], baselines::Method::depth_first))
        throw std::runtime_error(fmt::format("{} in slabs: pair {} is answered wrongly", workload.name, i));
    }
    return {
        [this, &workload, hits, query] { collide(*set_, workload.agents(), workload.pairs, *hits, query); },
        hits->size(),
        {{"hits", static_cast<double>(count)}}};
  }

  double bytes_per_shape() const { return static_cast<double>(set_->bytes()) / set_->shape_count(); }

 private:
  Scene& scene_;
  const SliceRow& row_;
  std::vector<PoseShaper> shapers_;
  std::optional<PreparedShape> prepared_;
  std::optional<ShapeSet> set_;
};

std::string row_name(std::size_t row, std::string_view what) {
  return fmt::format("slices/{}/{}", row, what);
}

std::string query_name(std::size_t row, std::string_view workload, Leaves leaves) {
  return row_name(row, fmt::format("{}/{}", workload, name_of(leaves)));
}

void print_slices(const Results& results) {
  fmt::print("\n| slabs, one thread: ns a pair, discs / segments |");
  for (const std::string_view workload : workloads) fmt::print(" {} |", workload);
  fmt::print(
      " hits in the crowd | us to build a shape | bytes of a shape |\n|---|---|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < std::size(slice_rows); ++i) {
    fmt::print("| {} |", slice_rows[i].slabs);
    for (const std::string_view workload : workloads)
      fmt::print(" {:.1f} / {:.1f} |", results.at(query_name(i, workload, Leaves::discs)).nanoseconds,
                 results.at(query_name(i, workload, Leaves::segments)).nanoseconds);
    const Timing& build = results.at(row_name(i, "build"));
    fmt::print(" {:.0f} | {:.1f} | {:.0f} |\n",
               results.at(query_name(i, "crowd", Leaves::segments)).counters.at("hits"),
               build.nanoseconds / 1e3, build.counters.at("bytes_per_shape"));
  }
  const auto times_whole = [&](const std::string& name, const std::string& of_whole) {
    return results.at(name).nanoseconds / results.at(of_whole).nanoseconds;
  };
  for (std::size_t i = 0; i < std::size(slice_rows); ++i) {
    const SliceRow& row = slice_rows[i];
    if (row.bytes == 0) continue;
    fmt::print("{} slabs over the whole body:\n", row.slabs);
    for (const Leaves leaves : {Leaves::discs, Leaves::segments}) {
      const double ratio = times_whole(query_name(i, "crowd", leaves), query_name(0, "crowd", leaves));
      fmt::print("  crowd, {:8} {:6.2f} x   {}\n", name_of(leaves), ratio,
                 verdict_at_most(ratio, leaves == Leaves::discs ? row.discs : row.segments));
    }
    const double build = times_whole(row_name(i, "build"), row_name(0, "build"));
    fmt::print("  pose to flat shape{:5.2f} x   {}\n", build, verdict_at_most(build, row.build));
    const double bytes = results.at(row_name(i, "build")).counters.at("bytes_per_shape");
    fmt::print("  bytes of a shape{:7.0f}     {}\n", bytes, verdict_at_most(bytes, row.bytes));
  }
}

}  // namespace

std::vector<Table> slice_tables(Suite& suite, Scene& scene) {
  for (std::size_t i = 0; i < std::size(slice_rows); ++i) {
    const Shared<Sliced> sliced([&scene, i] { return std::make_shared<Sliced>(scene, slice_rows[i]); });
    for (const std::string_view workload : workloads)
      for (const Leaves leaves : {Leaves::discs, Leaves::segments})
        suite.add(query_name(i, workload, leaves), [sliced, &scene, workload, leaves]() -> Contender {
          const std::shared_ptr<Sliced> kept = sliced.get();
          Contender made = kept->query(scene.workload(workload), leaves);
          made.call = [kept, call = made.call] { call(); };
          return made;
        });
    suite.add(row_name(i, "build"), [sliced, &scene]() -> Contender {
      return {[kept = sliced.get()] { kept->build(); },
              scene.sources().size(),
              {{"bytes_per_shape", sliced.get()->bytes_per_shape()}}};
    });
  }
  return {{"slices", "^slices/", print_slices}};
}

}  // namespace bch::bench
