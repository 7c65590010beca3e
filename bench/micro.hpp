// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "bench/scene.hpp"

namespace bch::bench {

/// collide/<workload>/<implementation>/<boundary|solid>/threads:<n>
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

/// build/<stage>: skinning, outline, hierarchy and interior of a pose, and its share of a shape set; build/<kind>: a
/// structure over it. An iteration builds one pose; they take turns. build/outline/subdivided/<n>: outlines with
/// every triangle cut into four, n times over; the counter `triangles` says into how many.
void register_build_benchmarks(Scene& scene);

/// load/map and load/read: a baked file of the scene's poses, in the file cache, by either way. load/<part>_alone: what
/// that consists of; mapping includes its end.
void register_load_benchmarks(Scene& scene);

}  // namespace bch::bench
