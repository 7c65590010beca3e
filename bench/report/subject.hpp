// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <bch/collide.hpp>

#include "bench/report/slide.hpp"
#include "bench/report/statistics.hpp"
#include "bench/workload/scene.hpp"

namespace bch::report {

constexpr std::string_view kernel_name = "BCH outline in the batch kernel";
/// The name of the batch kernel with exact leaves.
constexpr std::string_view exact_leaves_name = "BCH outline with exact leaves";
/// Returns the name of the kernel over bodies in so many slabs, with exact leaves or discs: "BCH in 3 slabs", "BCH in 3 slabs with discs".
std::string slabs_name(std::uint32_t slabs, Leaves leaves);
/// The numbers of slabs that are compared.
constexpr std::uint32_t compared_slabs[] = {2, 3, 4, 8};
constexpr std::string_view leaf_discs_name =
    "BCH projected leaf discs";  ///< without the exact tests of its triangles

/// Returns the name of a cut of the outline's hierarchy: "single cylinder", "BCH outline to depth 3".
std::string cut_name(std::uint32_t depth);

/// Holds the mean number of tests that a traversal makes of a pair; NaN where it is not counted.
struct MeanTests {
  double nodes = std::numeric_limits<double>::quiet_NaN();   ///< of two discs or boxes
  double leaves = std::numeric_limits<double>::quiet_NaN();  ///< of two triangles or segments
};

/// Represents anything that answers pairs: a structure down to some depth, or a kernel over a set.
struct Subject {
  std::function<void(const bench::Workload&, bench::Hits&)> answer;
  std::function<std::vector<double>(const SlideCases&)> contacts;
  std::function<MeanTests(const bench::Workload&)> tests;  ///< over its first pairs
};

/// Makes a subject, which refers to the arguments: they must outlive it.
Subject subject_of(const baselines::Structure& structure, std::uint32_t max_depth = all_depths);
Subject subject_of(const ShapeSet& set, const QueryOptions& query = bench::disc_query);

bench::Hits answers(const Subject& subject, const bench::Workload& workload);
std::size_t count_hits(const Subject& subject, const bench::Workload& workload);

/// Returns the nanoseconds a pair of each subject. All of them are timed in turn, `runs` times over, so that
/// what slows the machine down for a while slows all of them, and ratios stay. A run takes 10 ms at least.
/// Threads: each call runs in an arena of that many, whose time Stopwatch takes.
std::vector<Quartiles> times(std::span<const Subject> subjects, const bench::Workload& workload,
                             std::uint32_t runs, int threads = 1);

/// Checks that two subjects give the same answers.
/// Errors:  throws std::logic_error naming the workload where the two answer some pair differently.
void require_same(const Subject& a, const Subject& b, const bench::Workload& workload);

}  // namespace bch::report
