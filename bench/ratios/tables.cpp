// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "bench/base/text.hpp"
#include "bench/ratios/ratios.hpp"
#include "bench/workload/answer_checks.hpp"
#include "bench/workload/race.hpp"

namespace bch::bench {
namespace {

struct Requirement {
  std::string_view workload;
  Semantics semantics;
  double avx512, avx2, sse2;  ///< times the reference
  double aim;                 ///< for avx512

  QueryOptions query() const { return {.semantics = semantics, .leaves = Leaves::discs}; }
  double needed(std::string_view implementation) const {
    return implementation == "avx512" ? avx512 : implementation == "avx2" ? avx2 : sse2;
  }
};

constexpr Requirement requirements[] = {
    {"colliding", Semantics::boundary, 20, 14, 9, 40}, {"colliding", Semantics::solid, 24, 15, 10, 50},
    {"near_miss", Semantics::boundary, 10, 7, 5, 20},  {"near_miss", Semantics::solid, 10, 7, 5, 20},
    {"no_hit", Semantics::boundary, 10, 7, 5, 20},     {"no_hit", Semantics::solid, 10, 7, 5, 20},
    {"crowd", Semantics::boundary, 16, 11, 8, 30},     {"crowd", Semantics::solid, 16, 11, 8, 30},
};

/// The wide ones; the scalar one is there for processors without any of them, and nothing is asked of it.
std::vector<const kernel::Implementation*> wide_implementations() {
  std::vector<const kernel::Implementation*> wide;
  for (const kernel::Implementation& implementation : kernel::implementations())
    if (implementation.supported() && implementation.width > 1) wide.push_back(&implementation);
  return wide;
}

void print_row(const Requirement& row, const Workload& workload, std::span<const Contender> contenders,
               std::uint64_t hits) {
  const auto pairs = static_cast<double>(workload.pairs.size());
  const double reference = contenders[0].nanoseconds;
  fmt::print("{}, {}: {} pairs, {} hits; reference {:.1f} ns\n", row.workload,
             row.semantics == Semantics::solid ? "solid" : "boundary", cli::grouped(workload.pairs.size()),
             cli::grouped(hits), reference / pairs);
  for (const Contender& contender : contenders.subspan(1)) {
    const double ratio = reference / contender.nanoseconds;
    const std::string aim = contender.name == "avx512" ? fmt::format(", aim {:g}", row.aim) : "";
    fmt::print("  {:8}{:6.1f} ns{:7.1f} x   {}{}\n", contender.name, contender.nanoseconds / pairs, ratio,
               verdict(ratio, row.needed(contender.name)), aim);
  }
  std::fflush(stdout);
}

std::string per_call(const Workload& workload) {
  return fmt::format("{}, {} pairs", workload.name, cli::grouped(workload.pairs.size()));
}

/// The pairs in calls of `size`, those left over aside.
Contender in_batches(Scene& scene, const Workload& workload, std::size_t size) {
  const auto hits = std::make_shared<Hits>(workload.pairs.size());
  const auto call = [&set = scene.set(), &workload, hits, size] {
    const std::span<const Pair> pairs = workload.pairs;
    for (std::size_t i = 0; i + size <= pairs.size(); i += size)
      collide(set, workload.agents(), pairs.subspan(i, size), std::span(*hits).subspan(i, size), disc_query);
  };
  call();
  Hits complete = scene.expected(disc_query, workload);
  std::copy_n(hits->begin(), workload.pairs.size() / size * size, complete.begin());
  const std::string name = fmt::format("batches of {}", size);
  require_right(name, workload, wrong_kernel(scene, workload, disc_query, complete));
  return {name, call};
}

/// All pairs in one call, by so many threads.
Contender by_threads(Scene& scene, const Workload& workload, int threads) {
  const auto hits = std::make_shared<Hits>(workload.pairs.size());
  const auto arena = std::make_shared<tbb::task_arena>(threads);
  const auto call = [&set = scene.set(), &workload, hits, arena] {
    arena->execute([&] { collide(set, workload.agents(), workload.pairs, *hits, disc_query); });
  };
  call();
  const std::string name = fmt::format("{} threads", threads);
  require_right(name, workload,
                wrong_answers({scene.shapes(), {}, Leaves::discs}, workload.agents(), workload.pairs, *hits,
                              Semantics::boundary));
  return {name, call};
}

}  // namespace

void print_kernel_ratios(Scene& scene, std::uint32_t runs) {
  for (const Requirement& row : requirements) {
    const Workload& workload = scene.workload(row.workload);
    std::vector<Contender> contenders = {structure_contender(scene, workload, "reference")};
    for (const auto* implementation : wide_implementations())
      contenders.push_back(kernel_contender(scene, workload, row.query(), *implementation));
    race(contenders, runs, 1);
    const Hits& hits = scene.expected(row.query(), workload);
    print_row(row, workload, contenders, static_cast<std::uint64_t>(std::count(hits.begin(), hits.end(), 1)));
  }
}

void print_leaf_ratios(Scene& scene, std::uint32_t runs) {
  struct Row {
    std::string_view workload;
    Semantics semantics;
  };
  for (const auto& [name, semantics] :
       {Row{"crowd", Semantics::boundary}, Row{"crowd", Semantics::solid},
        Row{"colliding", Semantics::boundary}, Row{"near_miss", Semantics::boundary},
        Row{"no_hit", Semantics::boundary}}) {
    const Workload& workload = scene.workload(name);
    std::vector<Contender> contenders;
    for (const auto* implementation : wide_implementations())
      for (const Leaves leaves : {Leaves::discs, Leaves::segments})
        contenders.push_back(
            kernel_contender(scene, workload, {.semantics = semantics, .leaves = leaves}, *implementation));
    race(contenders, runs, 1);
    const auto pairs = static_cast<double>(workload.pairs.size());
    const auto hits = [&](Leaves leaves) {
      const Hits& all = scene.expected({.semantics = semantics, .leaves = leaves}, workload);
      return cli::grouped(static_cast<std::uint64_t>(std::count(all.begin(), all.end(), 1)));
    };
    fmt::print("exact leaves, {}, {}: {} pairs, {} hits with discs, {} with segments\n", name,
               semantics == Semantics::solid ? "solid" : "boundary", cli::grouped(workload.pairs.size()),
               hits(Leaves::discs), hits(Leaves::segments));
    for (std::size_t i = 0; i < contenders.size(); i += 2) {
      const double discs = contenders[i].nanoseconds, segments = contenders[i + 1].nanoseconds;
      fmt::print("  {:8}{:6.1f} ns, {:.1f} with segments{:7.2f} x   {}, aim 1.1\n", contenders[i].name,
                 discs / pairs, segments / pairs, segments / discs, verdict_at_most(segments / discs, 1.3));
    }
    std::fflush(stdout);
  }
}

void print_peer_ratios(Scene& scene, std::uint32_t runs) {
  const Workload& workload = scene.workload("colliding");
  struct Peer {
    std::string_view kind, name;
    double needed;  ///< 0: nothing is asked
  };
  constexpr Peer peers[] = {{"fcl_obb_contour", "FCL, walls", 200},
                            {"fcl_obb_segments", "FCL, one triangle a segment", 0},
                            {"obb_contour_2d", "obb_contour_2d", 40}};
  std::vector<Contender> contenders = {
      kernel_contender(scene, workload, disc_query, kernel::best_implementation())};
  for (const Peer& peer : peers)
    if (has_kind(peer.kind)) contenders.push_back(structure_contender(scene, workload, peer.kind));
  race(contenders, runs, 1);
  const auto pairs = static_cast<double>(workload.pairs.size());
  fmt::print("against boxes on the same outlines: {}, boundary; {} {:.1f} ns\n", per_call(workload),
             contenders[0].name, contenders[0].nanoseconds / pairs);
  for (const auto& [kind, name, needed] : peers) {
    const auto found = std::find_if(contenders.begin(), contenders.end(),
                                    [&, of = kind](const Contender& one) { return one.name == of; });
    if (found == contenders.end()) {
      fmt::print("  {:28} not in this build\n", name);
      continue;
    }
    const double ratio = found->nanoseconds / contenders[0].nanoseconds;
    fmt::print("  {:28}{:8.1f} ns{:7.1f} x   {}\n", name, found->nanoseconds / pairs, ratio,
               needed > 0 ? verdict(ratio, needed) : "");
  }
}

void print_call_ratios(Scene& scene, std::uint32_t runs) {
  Workload many = crowd_pairs(scene.set(), 50'000);
  many.pairs.resize(std::min<std::size_t>(many.pairs.size(), 100'000));
  std::vector<Contender> threads = {by_threads(scene, many, 1), by_threads(scene, many, 2)};
  race(threads, runs, 2);
  const double gain = threads[0].nanoseconds / threads[1].nanoseconds;
  fmt::print("2 threads over 1: {}: {:.2f} x   {}\n", per_call(many), gain, verdict(gain, 1.9));

  const Workload& workload = scene.workload("colliding");
  const std::size_t small = std::min<std::size_t>(16, workload.pairs.size());
  const std::size_t large = std::min<std::size_t>(512, workload.pairs.size());
  std::vector<Contender> batches = {in_batches(scene, workload, small), in_batches(scene, workload, large)};
  race(batches, runs, 1);
  const auto each = [&](std::size_t i, std::size_t size) {
    return batches[i].nanoseconds / static_cast<double>(workload.pairs.size() / size * size);
  };
  const double cost = each(0, small) / each(1, large);
  fmt::print("a pair in batches of 16 over 512: {}: {:.1f} ns over {:.1f}: {:.2f} x   {}\n", workload.name,
             each(0, small), each(1, large), cost, verdict_at_most(cost, 1.5));
}

}  // namespace bch::bench
