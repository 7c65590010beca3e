// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "bench/workload/scene.hpp"

namespace bch::bench {

/// collide/<workload>/<implementation>/<boundary|solid>[_segments]/threads:<n>
/// The implementations are those of the kernel that run here, by instruction set, and the structures of
/// baselines::kinds(), which have boundary semantics and one thread. Threads are those of TBB, inside one
/// call. Before the time is taken the answers are checked; a benchmark whose answers are wrong is skipped
/// with an error. Counters:
///   ns_per_pair      median over the calls; see Stopwatch
///   hits             pairs that collide
///   false_positives  hits of pairs whose meshes do not intersect
///   tests_per_pair   volumes, triangles and segments tested, where the structure counts them
///   bytes_per_shape  memory, mean
/// The scene must outlive the benchmarks.
void register_collide_benchmarks(Scene& scene);

/// clearance/<workload>/<implementation|reference>/threads:<n> and time_of_impact/...: distances up to 0.5 m with their
/// directions, and first contacts while all agents walk 1.3 m/s for half a second. The reference is the scalar search
/// with the same pruning. A counter as above: ns_per_pair.
void register_distance_benchmarks(Scene& scene);

/// contacts/<workload>/<implementation|reference>/threads:<n> and penetration/..., of colliding pairs and of the crowd's;
/// collide_all/crowd/<implementation>/threads:<n>, of a pair that its broad phase finds. The reference is brute force.
void register_response_benchmarks(Scene& scene);

/// build/<stage>: a stage of construction (build_stages.hpp) on the scene's characters; build/<stage>/<triangles>: on the
/// built-in man with fewer and with more triangles. build/discs, build/discs_by_welzl, build/shape_set: the hierarchy's
/// discs alone, and a set of one shape. build/<kind>: a structure over a pose's triangles or its shape; beside them
/// build/single_cylinder, the disc around a pose's vertices, as in the paper's figure 3. An iteration builds one pose;
/// they take turns. What stages make is checked before.
void register_build_benchmarks(Scene& scene);

/// load/map and load/read: a baked file of the scene's poses, in the file cache, by either way. load/<part>_alone: what
/// that consists of; mapping includes its end.
void register_load_benchmarks(Scene& scene);

}  // namespace bch::bench
