// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace bch::bench {
namespace {

using baselines::Truth;

/// Counts the pairs that are answered otherwise; with `no_miss` only those that miss a hit of the others.
std::string compare(const Hits& hits, const Hits& others, std::string_view what, bool no_miss) {
  std::size_t wrong = 0, first = 0;
  for (std::size_t i = hits.size(); i-- > 0;)
    if (no_miss ? hits[i] < others[i] : hits[i] != others[i]) ++wrong, first = i;
  if (wrong == 0) return {};
  return fmt::format("{} {} fails for {} of {} pairs, the first of them {}",
                     no_miss ? "never missing a hit of" : "equal to", what, wrong, hits.size(), first);
}

/// The first other kind with the same truth: who wrote it does not matter, as all have to agree.
const baselines::Kind* peer_of(const baselines::Kind& kind) {
  for (const baselines::Kind& other : baselines::kinds())
    if (other.exact == kind.exact && other.name != kind.name) return &other;
  return nullptr;
}

}  // namespace

void require_right(std::string_view name, const Workload& workload, const std::string& wrong) {
  if (!wrong.empty()) throw std::runtime_error(fmt::format("{} on {}: {}", name, workload.name, wrong));
}

bool has_kind(std::string_view kind) {
  return std::ranges::any_of(baselines::kinds(),
                             [&](const baselines::Kind& row) { return row.name == kind; });
}

std::string wrong_kernel(Scene& scene, const Workload& workload, Leaves leaves, const Hits& hits) {
  return compare(hits, scene.expected(leaves, workload), "brute force", false);
}

std::string wrong_answers(const baselines::Reference& reference, const Agents& agents,
                          std::span<const Pair> pairs, const Hits& hits) {
  constexpr auto method = baselines::Method::depth_first;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (hits[i] != reference.solid(agents, pairs[i], method))
      return fmt::format("pair {} is answered wrongly", i);
  }
  return {};
}

std::string wrong_structure(Scene& scene, const Workload& workload, const baselines::Kind& kind,
                            const Hits& hits, std::uint32_t max_depth) {
  const auto expect_no_miss = [&](std::string_view other, std::string_view what) {
    return compare(hits, scene.hits(other, workload), what, true);
  };
  if (kind.exact != Truth::none && max_depth != all_depths)
    return expect_no_miss(kind.name, "itself at all depths");
  std::string wrong;
  if (kind.name == "reference")
    wrong = compare(hits, scene.boundary(Leaves::discs, workload), "brute force", false);
  if (kind.name == "reference_segments")
    wrong = compare(hits, scene.expected(Leaves::segments, workload), "brute force", false);
  if (kind.name == "paper_descent") wrong = expect_no_miss("reference", "reference");
  const baselines::Kind* const peer = kind.exact == Truth::none ? nullptr : peer_of(kind);
  if (peer != nullptr && wrong.empty())
    wrong = compare(hits, scene.hits(peer->name, workload), peer->name, false);
  if (wrong.empty() && (kind.never_misses_outlines || kind.exact == Truth::projection))
    wrong = expect_no_miss("obb_contour", "obb_contour");
  if (wrong.empty() && kind.exact == Truth::projection) wrong = expect_no_miss("obb_full", "obb_full");
  return wrong;
}

}  // namespace bch::bench
