// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/broad_phase/broad_phase.hpp"

#include "kernel/recordings/check.hpp"
#include "kernel/recordings/frame_block.hpp"
#include "kernel/recordings/run_bodies.hpp"

namespace bch::detail {

/// Checks a run: successive frames of a block, which one task handles, with enough people for the kernel's
/// batches and few enough for the cache. Indices are those of the people of the run. Keeps its memory for the
/// next run.
class FrameRun {
 public:
  static constexpr double near_distance = 1.2;  ///< metres
  /// Metres: a longer displacement of a person, or of two relative to each other, between two frames is a
  /// tracking jump.
  static constexpr double farthest_step = 6;

  /// Keeps references to its arguments. `motions`: characters and clips that rows name. `borders`:
  /// borders_of() of the walls.
  FrameRun(const CheckOptions& options, std::span<const LibraryMotion> motions,
           std::span<const std::uint8_t> borders)
      : options_(options), motions_(motions), borders_(borders) {}

  /// Begins a run of frames first .. last, inclusive, of a block that has to outlive it; finds near pairs and
  /// poses of people.
  void look(const FrameBlock& block, std::size_t first, std::size_t last);
  std::span<const WalkerPose> poses() const noexcept { return poses_; }
  /// Returns an estimate, mostly too large, of the number of pairs that run_query() will store.
  double expected_pairs() const;
  /// Finds overlaps and passes, and counts them. `bodies`: of the people of with_next(). `shapes`: people's
  /// shapes for pictures. `given_up`: how many shapes were dropped so far, WalkerShapes::given_up().
  void run_query(const RunBodies& bodies, std::span<const std::uint32_t> shapes, std::uint32_t given_up);

  std::size_t first() const noexcept { return first_; }
  std::size_t last() const noexcept { return last_; }
  /// Returns the number of people.
  std::size_t size() const noexcept { return end_ - begin_; }
  /// Returns the part of an array over the block's people that belongs to the run and the frame after it.
  template <class Value>
  std::span<const Value> with_next(const std::vector<Value>& of_block) const noexcept {
    const std::size_t end = block_->begin(std::min(last_ + 1, block_->frames()));
    return std::span(of_block).subspan(begin_, end - begin_);
  }
  std::span<const CheckedPerson> people() const noexcept { return checked_people_; }
  /// Frees memory for pairs beyond the usual amount, which each of many runs would keep.
  void let_go();
  /// Returns overlaps, passes and measured gaps, by frame, then ids.
  std::span<const CheckedPair> pairs() const noexcept { return checked_; }
  /// Return the measures of people and of pairs (by frame, then ids), and the number of pairs per frame;
  /// empty without CheckOptions::measures.
  std::span<MeasuredPerson> measured_people() noexcept { return measured_people_; }
  std::span<const MeasuredPair> measured_pairs() const noexcept { return measured_pairs_; }
  std::size_t measured_pairs_of(std::size_t frame) const noexcept {
    return measured_pairs_of_[frame - first_];
  }
  const OverlapCounts& counts() const noexcept { return counts_; }

 private:
  /// Returns the number of pairs whose memory is kept.
  std::size_t usual_pairs() const noexcept { return 65'536 + 32 * size(); }
  static constexpr double square(double value) { return value * value; }
  template <class Value>
  static void let_go(std::vector<Value>& values) {
    values = std::vector<Value>();
  }
  template <class Value>
  std::span<Value> own(std::span<Value> of_block) const noexcept {
    return of_block.subspan(begin_, size());
  }
  static bool by_place(Pair a, Pair b);
  /// Describes two people who overlap or are near each other: metres, of an overlap minus its depth.
  struct MeasuredClearance {
    Pair people;
    float clearance;
    bool overlaps;
  };
  Agents agents(std::span<const std::uint32_t> bodies) const;
  double square_step(std::size_t person) const;
  double longest_step() const;
  double square_distance(Pair pair) const;
  CheckedPair checked(Pair pair) const;

  Agents apart(Strided<std::uint32_t> shape_of) const;
  std::span<const Pair> find(BroadPhase& phase, const ShapeSetView& shapes, const Agents& agents,
                             double margin) const;
  void find_near();
  void turn_shoulders();
  void query_pairs(const RunBodies& bodies, const Agents& all);
  void query_depths(const RunBodies& bodies, const Agents& all);
  void query_between(const RunBodies& bodies, const Agents& with_next);
  void add_pass(Pair people, std::size_t next, float time, float gap);
  void query_walls(const RunBodies& bodies, const Agents& all);
  void measure_neighbours();
  void measure_clearance(Pair pair, float clearance, bool overlaps);
  void sum_intrusions();
  void measure_times(const RunBodies& bodies, const Agents& all);
  std::span<const Pair> find_sweeps(const RunBodies& bodies, const Agents& all);
  void measure_pairs(std::span<const Pair> pairs, std::span<const float> times);
  float time_to_collision(const MeasuredClearance& near, float time) const;
  void report_people(std::span<const std::uint32_t> shapes, std::uint32_t given_up);
  std::uint8_t class_of(Pair pair) const;
  void count_near();
  void count_overlaps();

  const CheckOptions& options_;
  const std::span<const LibraryMotion> motions_;
  const std::span<const std::uint8_t> borders_;
  const FrameBlock* block_ = nullptr;
  std::size_t first_ = 0, last_ = 0;  ///< frames
  std::size_t begin_ = 0, end_ = 0;   ///< people of the block
  BroadPhase near_phase_, body_phase_;
  std::vector<std::uint32_t> zeros_, near_count_;
  std::vector<double> density_;
  std::vector<std::uint8_t> density_class_;
  std::vector<Shoulders> shoulders_;
  std::vector<WalkerPose> poses_;
  std::size_t near_pairs_ = 0;
  double margin_ = 0;  ///< metres: pairs within this distance are queried
  std::vector<Pair> near_, hits_;
  std::vector<std::uint8_t> near_in_discs_;
  std::vector<Pair> apart_;  ///< pairs that do not overlap in this frame, but may touch before the next
  std::vector<std::uint8_t> answers_, in_wall_;
  std::vector<std::uint8_t> overlaps_,
      in_discs_;  ///< by person; in_discs_ and near_in_discs_ have a bit for each of compared_discs
  std::vector<CheckedPair> checked_;
  std::vector<CheckedPerson> checked_people_;
  OverlapCounts counts_;
  NeighbourMeasures neighbour_measures_;
  BroadPhase sweep_phase_;
  std::vector<double> reach_;  ///< metres, by person: the body's largest distance from the position
  std::vector<MeasuredClearance> clearances_;
  std::vector<std::uint64_t> intrusion_;  ///< of bodies, by person, in fixed-point numbers
  std::vector<MeasuredPerson> measured_people_;
  std::vector<MeasuredPair> measured_pairs_;
  std::vector<std::size_t> measured_pairs_of_;  ///< by frame
};

}  // namespace bch::detail
