// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/scene.hpp"

namespace bch::bench {

/// Something to be timed beside others.
struct Contender {
  std::string name;
  std::function<void()> call;
  double nanoseconds = 0;  ///< of a call: the result
};

/// Times all of them in turn, `runs` times over, and takes each one's median: what slows the machine down
/// for a while slows all of them, and ratios stay. A run of a contender takes 10 ms at least.
/// Threads: each call runs in an arena of that many, whose time Stopwatch takes.
void race(std::vector<Contender>& contenders, std::uint32_t runs, int threads);

/// "PASS", or by how much a ratio misses what it needs: "needs 20: 19 % short".
std::string verdict(double ratio, double needed);
/// The same of what must not be more: "at most 1.5: 8 % over".
std::string verdict_at_most(double value, double most);

/// A contender that asks a kernel's implementation for all pairs of a workload, by one thread; its answers
/// were compared. Errors of both: throw std::runtime_error on wrong answers.
Contender kernel_contender(Scene& scene, const Workload& workload, Semantics semantics,
                           const kernel::Implementation& implementation);
Contender structure_contender(Scene& scene, const Workload& workload, std::string_view kind);

/// Throws std::runtime_error if something is wrong.
void require_right(const std::string& name, const Workload& workload, const std::string& wrong);

/// The same for clearance(), with directions, and contact_time(), and for the scalar searches with the same pruning.
Contender clearance_contender(Scene& scene, const Workload& workload,
                              const kernel::Implementation& implementation);
Contender scalar_clearance_contender(Scene& scene, const Workload& workload);
/// FCL's distances of the outlines; none in a build without FCL.
std::optional<Contender> fcl_distance_contender(Scene& scene, const Workload& workload);
Contender contact_time_contender(Scene& scene, const Workload& workload,
                                 const kernel::Implementation& implementation);
Contender scalar_contact_time_contender(Scene& scene, const Workload& workload);

/// Whether this build has the kind.
bool has_kind(std::string_view kind);

/// The tables. Each prints to standard output.
void print_kernel_ratios(Scene& scene, std::uint32_t runs);
void print_peer_ratios(Scene& scene, std::uint32_t runs);
void print_call_ratios(Scene& scene, std::uint32_t runs);
void print_crowd_ratios(Scene& scene, std::uint32_t runs);
void print_distance_ratios(Scene& scene, std::uint32_t runs);
void print_shape_count_ratios(Scene& scene, std::uint32_t runs, std::uint32_t most_shapes);
void print_plan_table(Scene& scene, std::uint32_t runs);
/// Construction: every stage by every instruction set, beside what is asked; and how it grows with triangles.
void print_build_ratios(Scene& scene, std::uint32_t runs);
void print_build_growth(std::uint32_t poses, std::uint32_t runs);
void print_paper_table(Scene& scene, std::uint32_t runs);

}  // namespace bch::bench
