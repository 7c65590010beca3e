// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "baselines/reference.hpp"
#include "baselines/structure.hpp"
#include "bench/workload/scene.hpp"

/// Checks of answers before they are timed. Each function says what is wrong; empty: nothing.
namespace bch::bench {

/// Checks the kernel's answers: the same bits as brute force over all discs, on every pair.
std::string wrong_kernel(Scene& scene, const Workload& workload, Leaves leaves, const Hits& hits);

/// Checks answers for shapes and levels that belong to no scene: equal to the reference going depth first, on
/// every pair.
std::string wrong_answers(const baselines::Reference& reference, const Agents& agents,
                          std::span<const Pair> pairs, const Hits& hits);

/// Checks a structure's answers by the properties in its row of baselines::kinds():
///   exact                  equal to the first other kind of the same truth
///   mesh, projection       outlines or meshes that meet are seen by what projects them
///   never_misses_outlines  1 wherever the outlines meet
///   reference              the same bits as brute force over all discs, where outlines cross
///   paper_descent          1 wherever the reference says so
/// An exact structure that went down to max_depth only must not miss anything that it sees at all depths.
std::string wrong_structure(Scene& scene, const Workload& workload, const baselines::Kind& kind,
                            const Hits& hits, std::uint32_t max_depth = all_depths);

/// Represents something to be timed, whose answers were compared.
struct Contender {
  std::function<void()> call;
  std::size_t items = 1;                        ///< of a call: pairs, agents or poses
  std::map<std::string, double> counters = {};  ///< what else is worth telling
};

/// Checks that nothing is wrong: throws std::runtime_error if `wrong` is not empty.
void require_right(std::string_view name, const Workload& workload, const std::string& wrong);

/// Returns whether this build has the kind.
bool has_kind(std::string_view kind);

}  // namespace bch::bench
