// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/answer_checks.hpp"

#include <fmt/format.h>

#include <functional>

namespace bch::bench {
namespace {

using baselines::Truth;

/// The pairs on which two lists of answers do not stand to each other as they should.
std::string compare(const Hits& hits, const Hits& others, std::string_view relation,
                    const std::function<bool(bool, bool)>& holds) {
  std::size_t wrong = 0, first = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (holds(hits[i] != 0, others[i] != 0)) continue;
    if (wrong++ == 0) first = i;
  }
  if (wrong == 0) return {};
  return fmt::format("{} fails for {} of {} pairs, the first of them {}", relation, wrong, hits.size(),
                     first);
}

std::string expect_equal(const Hits& hits, const Hits& others, std::string_view what) {
  return compare(hits, others, fmt::format("equal to {}", what), [](bool a, bool b) { return a == b; });
}

std::string expect_no_miss(const Hits& hits, const Hits& others, std::string_view what) {
  return compare(hits, others, fmt::format("never missing a hit of {}", what),
                 [](bool a, bool b) { return a || !b; });
}

/// The first other kind with the same truth: who wrote it does not matter, as all have to agree.
const baselines::Kind* peer_of(const baselines::Kind& kind) {
  for (const baselines::Kind& other : baselines::kinds())
    if (other.exact == kind.exact && other.name != kind.name) return &other;
  return nullptr;
}

}  // namespace

std::string wrong_kernel(Scene& scene, const Workload& workload, const QueryOptions& query,
                         const Hits& hits) {
  return expect_equal(hits, scene.expected(query, workload), "brute force");
}

std::string wrong_answers(const baselines::Reference& reference, const Agents& agents,
                          std::span<const Pair> pairs, const Hits& hits, Semantics semantics) {
  constexpr auto method = baselines::Method::depth_first;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const bool expected = semantics == Semantics::solid ? reference.solid(agents, pairs[i], method)
                                                        : reference.boundary(agents, pairs[i], method);
    if (hits[i] != expected) return fmt::format("pair {} is answered wrongly", i);
  }
  return {};
}

std::string wrong_structure(Scene& scene, const Workload& workload, const baselines::Kind& kind,
                            const Hits& hits, std::uint32_t max_depth) {
  if (kind.exact != Truth::none && max_depth != all_depths)
    return expect_no_miss(hits, scene.hits(kind.name, workload), "itself at all depths");
  std::string wrong;
  if (kind.name == "reference") wrong = wrong_kernel(scene, workload, disc_query, hits);
  if (kind.name == "paper_descent")
    wrong = expect_no_miss(hits, scene.hits("reference", workload), "reference");
  if (const auto* peer = kind.exact == Truth::none ? nullptr : peer_of(kind);
      peer != nullptr && wrong.empty())
    wrong = expect_equal(hits, scene.hits(peer->name, workload), peer->name);
  if (wrong.empty() && (kind.never_misses_outlines || kind.exact == Truth::projection))
    wrong = expect_no_miss(hits, scene.hits("obb_contour", workload), "obb_contour");
  if (wrong.empty() && kind.exact == Truth::projection)
    wrong = expect_no_miss(hits, scene.hits("obb_full", workload), "obb_full");
  return wrong;
}

}  // namespace bch::bench
