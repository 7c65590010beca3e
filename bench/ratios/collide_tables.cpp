// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>
#include <oneapi/tbb/info.h>

#include <algorithm>

#include "baselines/structure.hpp"
#include "bench/base/text.hpp"
#include "bench/ratios/ratios.hpp"
#include "kernel/runtime/kernels.hpp"
#include "layout/base/instruction_set.hpp"

namespace bch::bench {
namespace {

struct Requirement {
  std::string_view workload;
  Semantics semantics;
  double avx512, avx2, base;  ///< times the reference
  double aim;                 ///< for avx512

  double needed(std::string_view implementation) const {
    return implementation == "avx512" ? avx512 : implementation == "avx2" ? avx2 : base;
  }
};

constexpr Requirement requirements[] = {
    {"colliding", Semantics::boundary, 20, 14, 9, 40}, {"colliding", Semantics::solid, 24, 15, 10, 50},
    {"near_miss", Semantics::boundary, 10, 7, 5, 20},  {"near_miss", Semantics::solid, 10, 7, 5, 20},
    {"no_hit", Semantics::boundary, 10, 7, 5, 20},     {"no_hit", Semantics::solid, 10, 7, 5, 20},
    {"crowd", Semantics::boundary, 16, 11, 8, 30},     {"crowd", Semantics::solid, 16, 11, 8, 30},
};

/// Boxes on the same outlines.
struct Peer {
  std::string_view kind, name;
  double needed;  ///< 0: nothing is asked
};
constexpr Peer peers[] = {{"fcl_obb_contour", "FCL, walls", 200},
                          {"fcl_obb_segments", "FCL, one triangle a segment", 0},
                          {"obb_contour_2d", "obb_contour_2d", 40}};

/// What the paper timed, and what here answers the same.
struct PaperRow {
  std::string_view what;
  double paper;           ///< nanoseconds there; 0: not in the paper
  std::string_view kind;  ///< empty: the kernel
};
constexpr PaperRow paper_rows[] = {
    {"BCH, outline, this batch kernel", 0, ""},
    {"BCH, outline, one pair after the other", 2660, "reference"},
    {"OBB tree, outline", 4630, "obb_contour"},
    {"OBB tree, outline, rectangles in 2D", 0, "obb_contour_2d"},
    {"OBB tree, outline, FCL's, two triangles a segment", 0, "fcl_obb_contour"},
    {"OBB tree, outline, FCL's, one triangle a segment", 0, "fcl_obb_segments"},
    {"OBB tree, all triangles seen from above", 20660, "obb_projected"},
};
constexpr std::string_view paper_columns[] = {"paper500", "paper500_cached", "colliding"};

std::string structure_name(std::string_view workload, std::string_view kind) {
  return fmt::format("collide/{}/boundary/{}", workload, kind);
}

std::string best_name(std::string_view workload) {
  return collide_name(workload, disc_query, best_implementation().name);
}

std::string grouped(double count) {
  return cli::grouped(static_cast<std::uint64_t>(count));
}

void print_kernel(const Results& results) {
  for (const Requirement& row : requirements) {
    const Timing& reference = results.at(structure_name(row.workload, "reference"));
    const QueryOptions query{.semantics = row.semantics, .leaves = Leaves::discs};
    const auto of = [&](const std::string& set) {
      return results.at(collide_name(row.workload, query, set));
    };
    fmt::print("{}, {}: {} pairs, {} hits; reference {:.1f} ns\n", row.workload, name_of(row.semantics),
               cli::grouped(reference.items), grouped(of(base_implementation()).counters.at("hits")),
               reference.nanoseconds);
    for (const std::string& set : wide_implementations()) {
      const double taken = of(set).nanoseconds, ratio = reference.nanoseconds / taken;
      const std::string aim = set == "avx512" ? fmt::format(", aim {:g}", row.aim) : "";
      fmt::print("  {:8}{:6.1f} ns{:7.1f} x   {}{}\n", set, taken, ratio, verdict(ratio, row.needed(set)),
                 aim);
    }
  }
}

void print_leaves(const Results& results) {
  struct Row {
    std::string_view workload;
    Semantics semantics;
  };
  for (const auto& [workload, semantics] :
       {Row{"crowd", Semantics::boundary}, Row{"crowd", Semantics::solid},
        Row{"colliding", Semantics::boundary}, Row{"near_miss", Semantics::boundary},
        Row{"no_hit", Semantics::boundary}}) {
    const auto of = [&, workload = workload, semantics = semantics](const std::string& set, Leaves leaves) {
      return results.at(collide_name(workload, {.semantics = semantics, .leaves = leaves}, set));
    };
    const Timing with_discs = of(base_implementation(), Leaves::discs);
    fmt::print("exact leaves, {}, {}: {} pairs, {} hits with discs, {} with segments\n", workload,
               name_of(semantics), cli::grouped(with_discs.items), grouped(with_discs.counters.at("hits")),
               grouped(of(base_implementation(), Leaves::segments).counters.at("hits")));
    for (const std::string& set : wide_implementations()) {
      const double discs = of(set, Leaves::discs).nanoseconds,
                   segments = of(set, Leaves::segments).nanoseconds;
      fmt::print("  {:8}{:6.1f} ns, {:.1f} with segments{:7.2f} x   {}, aim 1.1\n", set, discs, segments,
                 segments / discs, verdict_at_most(segments / discs, 1.3));
    }
  }
}

void print_peers(const Results& results) {
  const Timing& own = results.at(best_name("colliding"));
  fmt::print("against boxes on the same outlines: colliding, {} pairs, boundary; {} {:.1f} ns\n",
             cli::grouped(own.items), best_implementation().name, own.nanoseconds);
  for (const auto& [kind, name, needed] : peers) {
    const auto found = results.find(structure_name("colliding", kind));
    if (found == results.end()) {
      fmt::print("  {:28} not in this build\n", name);
      continue;
    }
    const double taken = found->second.nanoseconds, ratio = taken / own.nanoseconds;
    fmt::print("  {:28}{:8.1f} ns{:7.1f} x   {}\n", name, taken, ratio,
               needed > 0 ? verdict(ratio, needed) : "");
  }
}

/// Writes a time and its ratio to the scalar reference's time; that ratio does not depend on the hardware.
std::string cell(double nanoseconds, double plain) {
  if (!(nanoseconds > 0)) return {};
  const double ratio = nanoseconds / plain;
  return ratio < 10 ? fmt::format("{:.0f} ({:.2g} x)", nanoseconds, ratio)
                    : fmt::format("{:.0f} ({:.0f} x)", nanoseconds, ratio);
}

void print_paper(const Results& results) {
  fmt::print(
      "\n| ns per colliding pair, one thread | paper | 500 pairs in sequence | 500, each repeated | "
      "distinct pairs |\n|---|---|---|---|---|\n");
  for (const auto& [what, paper, kind] : paper_rows) {
    if (!kind.empty() && !has_kind(kind)) continue;
    fmt::print("| {} | {} |", what, cell(paper, paper_rows[1].paper));
    for (const std::string_view column : paper_columns)
      fmt::print(" {} |",
                 cell(results.at(kind.empty() ? best_name(column) : structure_name(column, kind)).nanoseconds,
                      results.at(structure_name(column, "reference")).nanoseconds));
    fmt::print("\n");
  }
}

void add_kernel(Suite& suite, Scene& scene, std::string_view workload, const Implementation& implementation) {
  for (const Semantics semantics : {Semantics::boundary, Semantics::solid})
    for (const Leaves leaves : {Leaves::discs, Leaves::segments})
      for (const int threads : thread_counts()) {
        const QueryOptions query{.semantics = semantics, .leaves = leaves};
        suite.add(
            with_threads(collide_name(workload, query, implementation.name), threads),
            [&scene, workload, query, &implementation] {
              return kernel_contender(scene, scene.workload(workload), query, implementation);
            },
            threads);
      }
}

}  // namespace

std::string collide_name(std::string_view workload, const QueryOptions& query,
                         std::string_view implementation) {
  return fmt::format("collide/{}/{}/{}/{}", workload, name_of(query.semantics), name_of(query.leaves),
                     implementation);
}

std::vector<int> thread_counts() {
  const int most = tbb::info::default_concurrency();
  std::vector<int> counts;
  for (int n = 1; n < most; n *= 2) counts.push_back(n);
  counts.push_back(most);
  return counts;
}

std::string with_threads(const std::string& name, int threads) {
  return threads == 1 ? name : fmt::format("{}/threads:{}", name, threads);
}

std::string base_implementation() {
  return std::string(detail::base.name);
}

std::vector<std::string> wide_implementations() {
  std::vector<std::string> wide;
  for (const Implementation& implementation : implementations())
    if (implementation.supported() && implementation.kernels->width > 1)
      wide.emplace_back(implementation.name);
  return wide;
}

std::vector<Table> collide_tables(Suite& suite, Scene& scene) {
  for (const std::string_view workload : workload_names()) {
    for (const Implementation& implementation : implementations())
      if (implementation.supported()) add_kernel(suite, scene, workload, implementation);
    for (const baselines::Kind& kind : baselines::kinds())
      suite.add(structure_name(workload, kind.name), [&scene, workload, &kind] {
        return structure_contender(scene, scene.workload(workload), kind.name);
      });
  }
  const std::string wide = fmt::format("({})$", fmt::join(wide_implementations(), "|"));
  const std::string best = fmt::format("discs/{}", best_implementation().name);
  return {
      {"kernel",
       "^collide/(colliding|near_miss|no_hit|crowd)/(boundary/reference$|(boundary|solid)/discs/" + wide +
           ")",
       print_kernel},
      {"leaves",
       "^collide/((colliding|near_miss|no_hit)/boundary|crowd/(boundary|solid))/(discs|segments)/" + wide,
       print_leaves},
      {"peers", "^collide/colliding/boundary/(" + best + "|fcl_obb_contour|fcl_obb_segments|obb_contour_2d)$",
       print_peers},
      {"paper",
       "^collide/(paper500|paper500_cached|colliding)/boundary/(" + best +
           "|reference|obb_contour|obb_contour_2d|fcl_obb_contour|fcl_obb_segments|obb_projected)$",
       print_paper}};
}

}  // namespace bch::bench
