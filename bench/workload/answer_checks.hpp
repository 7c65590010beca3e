// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <string>

#include "baselines/reference.hpp"
#include "baselines/structure.hpp"
#include "bench/workload/scene.hpp"

/// What answers must hold before they are worth timing. Each function says what is wrong; empty: nothing.
namespace bch::bench {

/// The kernel: the same bits as brute force over all discs, on every pair.
std::string wrong_kernel(Scene& scene, const Workload& workload, const QueryOptions& query, const Hits& hits);

/// The same of shapes and levels that are no scene's: equal to the reference going depth first, on every pair.
std::string wrong_answers(const baselines::Reference& reference, const Agents& agents,
                          std::span<const Pair> pairs, const Hits& hits, Semantics semantics);

/// A structure, by what its row of baselines::kinds() says of it:
///   exact                  equal to the first other kind of the same truth
///   mesh, projection       outlines or meshes that meet are seen by what projects them
///   never_misses_outlines  1 wherever the outlines meet
///   reference              the same bits as brute force over all discs
///   paper_descent          1 wherever the reference says so
/// One that is exact, when it went down to max_depth only: it misses nothing that it sees at all depths.
std::string wrong_structure(Scene& scene, const Workload& workload, const baselines::Kind& kind,
                            const Hits& hits, std::uint32_t max_depth = all_depths);

}  // namespace bch::bench
