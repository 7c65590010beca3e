// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "bench/workload/scene.hpp"
#include "kernel/runtime/all_options.hpp"

namespace bch::bench {

constexpr float leaf_threshold = 0.01f;  ///< metres, of the hierarchies that benchmarks build

/// Registers a benchmark with Google Benchmark. Its contender is made, which checks its answers, when it is first
/// run; wrong answers are an error of the benchmark, which is then not timed. Each call runs in an arena of so many
/// threads. One thread is timed by its own clock, which does not count other programs, several by the wall's. The
/// counter `per_item` is the seconds of an item. What `make` refers to must outlive all runs.
void add(const std::string& name, std::function<Contender()> make, int threads = 1);
/// Registers NAME, and NAME/threads:<n> for powers of two, and for all threads of the machine.
void add_for_threads(const std::string& name, const std::function<Contender()>& make);

/// Returns whether a benchmark's answers were wrong.
bool any_wrong();

/// Returns a function that makes a value by a pointer when it is first called, and keeps it: what several
/// benchmarks share.
template <class Make>
auto once(Make make) {
  return [ make, kept = std::make_shared<std::invoke_result_t<Make&>>() ]() -> auto& {
    if (!*kept) *kept = make();
    return **kept;
  };
}

/// Makes a contender of collide() for pairs. All but the query's options must outlive it. `wrong` returns what is
/// wrong with the answers; empty: nothing.
/// Errors:  throws std::runtime_error on wrong answers.
Contender collide_contender(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs,
                            const detail::AllOptions& query,
                            const std::function<std::string(const Hits&)>& wrong);
/// Makes one of a workload of shapes that are not the scene's, for discs as leaves.
Contender collide_contender(const ShapeSet& set, std::span<const Shape> shapes, const Workload& workload);

/// Returns the instruction sets that run here.
std::vector<const Implementation*> supported_implementations();

// The following functions register benchmarks; the scene must outlive them.

/// collide/<workload>/<leaves>/<instruction set>[/threads:<n>]: collide();
/// collide/<workload>/<kind>: structures of others.
void add_collide(Scene& scene);
/// stages/<workload>/<instruction set>: the times of the pair kernel's stages.
void add_stages(Scene& scene);
/// <query>/<workload>/<instruction set|reference>[/threads:<n>]: the queries other than collide(), and
/// clearance/near_miss/<fcl_walls|fcl_segments>.
void add_queries(Scene& scene);
/// threads/<n>, batches/<size>: one query of many pairs, and queries of a few; crowd/<agents>/<step|pairs>: pairs and
/// answers of whole crowds; shapes/<count>: a crowd of so many different shapes.
void add_crowds(Scene& scene);
/// bodies/<contacts|loop>: a crowd of bodies of discs.
void add_bodies();
/// {spheres,spheres_clearance}/<count>/<workload>/<instruction set>: collide() and clearance() of bodies of spheres.
void add_spheres(Scene& scene);
/// obstacles/<query>: a crowd on a floor plan.
void add_obstacles(Scene& scene);
/// plans/<plan>/<bake|query>: sets by different plans; load/<map|read>: a baked file of the scene's poses.
void add_sets(Scene& scene);
/// construction/<character>/<instruction set>/<stage>, construction/<character>/clipper.
void add_construction(Scene& scene);
}  // namespace bch::bench
