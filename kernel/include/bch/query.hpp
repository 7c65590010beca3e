// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include <bch/agents.hpp>
#include <bch/shapes.hpp>

namespace bch::detail {
struct Kernels;
}

namespace bch {

// What a collision is. A shape is a binary tree of discs over its outline. The cut of an agent's shape at the
// agent's level (0 is the coarsest) is the nodes at one depth of the tree, and the leaves above. Two agents
// collide if a disc a of one cut overlaps a disc b of the other, and each of a and its ancestors overlaps
// each of b and its ancestors. They also collide if a contour of one lies inside a contour of the other.
// Touching is overlap. With exact leaves (Leaves::segments, at depth all_depths), segments in the two leaves
// also have to come within the rounding margin. See "The answer" in kernel/README.md.

// The rules that all queries share. A query over pairs writes one result per pair into spans of the caller,
// and allocates nothing unless its header says so. Any number of queries may read one ShapeSet at once;
// nothing may replace its shapes meanwhile. The work runs in the caller's TBB arena (call from
// tbb::task_arena(n).execute() for n threads) or by an Executor. Each thread needs 320 KiB of stack. While a
// query waits for its tasks, TBB may run other tasks on the calling thread, so call with no lock held.
// Results have the same bits on every processor, for any number of threads and any split of the batch.

/// Describes one compilation of the queries for an instruction set. All implementations give the same bits.
struct Implementation {
  const char* name;              ///< "avx512", "avx2", "sse2", "neon", "simd128" or "scalar"
  bool (*supported)() noexcept;  ///< returns whether this processor and its operating system run it
  const detail::Kernels* kernels;
};

/// Returns all implementations that were compiled, the best first; the last one runs everywhere.
std::span<const Implementation> implementations() noexcept;

/// Returns the best implementation that this processor supports, or the one that BCH_ISA names.
/// The environment variable BCH_ISA is read once.
/// Errors:  throws std::invalid_argument if BCH_ISA names an unknown or unsupported one.
const Implementation& best_implementation();

/// Returns an implementation by its name.
/// Errors:  throws std::invalid_argument on an unknown name, naming the known ones, or on one that this
///          processor does not run.
const Implementation& implementation(std::string_view name);

/// Runs the tasks of queries: a caller's own task system in place of TBB. Answers are the same bits.
struct Executor {
  /// Calls task(data, i) once for each i in [0, count), on any threads, and returns when all have ended.
  /// Tasks may run in any order and throw nothing; a task may call run() again. While run() waits, it may run
  /// other tasks on its thread, but none that query the same Crowd.
  void (*run)(void* context, std::size_t count, void (*task)(void* data, std::size_t i),
              void* data) = nullptr;
  void* context = nullptr;    ///< given to run()
  std::uint32_t threads = 1;  ///< tasks that run at once; a query is divided into at most 8 tasks per thread

  /// Sets the executor that runs the tasks of all queries from now on.
  /// An executor without run() restores the task system that the library was built with.
  /// Errors:  throws std::invalid_argument on other than 1 to 1024 threads.
  /// Threads: no query may run meanwhile.
  static void set(const Executor& executor);
};

/// Selects what clearance() returns for pairs whose discs overlap.
enum class Overlap {
  zero,  ///< a distance of 0, without a direction or discs: such pairs cost hardly more than in collide()
  /// The deepest overlap of two discs, as a negative distance, and its direction: a depth for contact forces
  /// between agents at coarse levels.
  deepest,
};

/// Holds the options of collide() and of other queries that find collisions.
struct CollideOptions {
  /// Selects one of implementations().
  /// Null selects best_implementation(), which may throw where BCH_ISA is set.
  const Implementation* implementation = nullptr;
  Leaves leaves = Leaves::segments;
};

/// Holds the options of clearance().
struct ClearanceOptions {
  const Implementation* implementation = nullptr;  ///< as in CollideOptions
  /// Limits the distances of interest, metres, not negative; may be infinite.
  /// Pairs farther apart get an infinite distance and nothing else. The smaller the limit, the sooner they
  /// are rejected.
  double max_distance = std::numeric_limits<double>::infinity();
  Overlap overlap = Overlap::zero;
  /// Selects what the distance is measured between: discs, or segments if both shapes have exact leaves.
  /// Segments give the distance of the outlines. Distances between discs are up to 3 cm less, and take about
  /// a quarter of the time. Overlap::deepest always measures discs.
  Leaves leaves = Leaves::discs;
};

/// Holds the options of clearance() of bodies of spheres.
struct BodyClearanceOptions {
  const Implementation* implementation = nullptr;                 ///< as in CollideOptions
  double max_distance = std::numeric_limits<double>::infinity();  ///< as in ClearanceOptions
  Overlap overlap = Overlap::zero;
};

/// Names two discs by their numbers in the cuts of a pair's agents.
/// The discs of a cut are numbered in the order of ShapeSet::discs() and cut().
struct DiscPair {
  std::uint32_t first;   ///< a disc of the pair's first agent
  std::uint32_t second;  ///< a disc of its second agent
  friend bool operator==(const DiscPair&, const DiscPair&) = default;

  /// Stands for the discs of a pair that has none in clearance().
  /// Such a pair is beyond max_distance, or overlaps with Overlap::zero.
  static const DiscPair none;
};
inline constexpr DiscPair DiscPair::none{0xffffffff, 0xffffffff};

/// Views rows of different lengths in one array (CSR): row i is values[offsets[i]] .. values[offsets[i + 1]].
/// The memory belongs to the object that returned the rows.
template <class Value>
struct Rows {
  std::span<const std::uint64_t> offsets;  ///< one more than rows
  std::span<const Value> values;

  std::size_t size() const noexcept { return offsets.empty() ? 0 : offsets.size() - 1; }
  std::span<const Value> operator[](std::size_t row) const noexcept {
    return values.subspan(offsets[row], offsets[row + 1] - offsets[row]);
  }
};

/// Checks the agents of a query.
/// Errors:  throws those of collide() on bad sizes, shapes, levels, positions or headings.
void validate(const ShapeSet& shapes, const Agents& agents);

}  // namespace bch
