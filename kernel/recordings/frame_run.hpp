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

/// Holds some frames of a block, one behind the other, which one task checks: enough people for the batches of the kernel, few enough for a
/// cache. Indices are of the people of these frames. Keeps its memory for the next ones.
class FrameRun {
 public:
  static constexpr double near_distance = 1.2;  ///< metres
  /// Metres, of one or of two people together, from a frame to the next; beyond, it is a jump and no way.
  static constexpr double farthest_step = 6;

  /// Takes `options`, `motions`, those that rows name, and `borders`, those of the walls, which have to live as long as this.
  FrameRun(const CheckOptions& options, std::span<const CastMotion> motions,
           std::span<const std::uint8_t> borders)
      : options_(options), motions_(motions), borders_(borders) {}

  /// Takes frames first .. last of a block, which has to live as long as the next calls; finds who is near whom and which poses people
  /// are in.
  void look(const FrameBlock& block, std::size_t first, std::size_t last);
  std::span<const WalkerPose> poses() const noexcept { return poses_; }
  /// Returns about how many pairs of neighbours run_query() will hold, or more.
  double expected_pairs() const;
  /// Finds who overlaps or passes whom, and counts. `bodies` are those of with_next(); `shapes` show people, and `given_up` is what
  /// WalkerShapes says of them.
  void run_query(const RunBodies& bodies, std::span<const std::uint32_t> shapes, std::uint32_t given_up);

  std::size_t first() const noexcept { return first_; }
  std::size_t last() const noexcept { return last_; }
  /// Returns the number of people.
  std::size_t size() const noexcept { return end_ - begin_; }
  /// Returns, of an array with an entry for each person of the block, those of these frames and of the one behind them.
  template <class Value>
  std::span<const Value> with_next(const std::vector<Value>& of_block) const noexcept {
    const std::size_t end = block_->begin(std::min(last_ + 1, block_->frames()));
    return std::span(of_block).subspan(begin_, end - begin_);
  }
  std::span<const CheckedPerson> people() const noexcept { return checked_people_; }
  /// Gives the memory for pairs back where it is more than usual, because there are many runs.
  void let_go();
  /// Returns who overlaps or passes whom, by frame, then ids.
  std::span<const CheckedPair> pairs() const noexcept { return checked_; }
  /// Returns what is measured of people and pairs, where that is asked for; these by frame, then ids, and so many of a frame.
  std::span<MeasuredPerson> measured_people() noexcept { return measured_people_; }
  std::span<const MeasuredPair> measured_pairs() const noexcept { return measured_pairs_; }
  std::size_t measured_pairs_of(std::size_t frame) const noexcept {
    return measured_pairs_of_[frame - first_];
  }
  const OverlapCounts& counts() const noexcept { return counts_; }

 private:
  /// Returns for how many pairs memory is kept.
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
  void measure_clearance(Pair pair, float clearance);
  void sum_intrusions();
  void measure_times(const RunBodies& bodies, const Agents& all);
  std::span<const Pair> find_sweeps(const RunBodies& bodies, const Agents& all);
  void measure_pair(Pair people, float clearance, MeasuredPair& pair);
  void measure_pairs(const RunBodies& bodies, const Agents& all, std::span<const Pair> pairs,
                     std::span<const float> times);
  void report_people(std::span<const std::uint32_t> shapes, std::uint32_t given_up);
  std::uint8_t class_of(Pair pair) const;
  void count_near();
  void count_overlaps();

  const CheckOptions& options_;
  const std::span<const CastMotion> motions_;
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
  double margin_ = 0;  ///< metres: how far from each other people may be who are asked about
  std::vector<Pair> near_, hits_;
  std::vector<std::uint8_t> near_in_discs_;
  std::vector<Pair> apart_;  ///< may touch before the next frame, but do not in this one
  std::vector<std::uint8_t> answers_, in_wall_;
  std::vector<std::uint8_t> overlaps_,
      in_discs_;  ///< by person; that and near_in_discs_ have a bit for each of compared_discs
  std::vector<CheckedPair> checked_;
  std::vector<CheckedPerson> checked_people_;
  OverlapCounts counts_;
  NeighbourMeasures neighbour_measures_;
  BroadPhase sweep_phase_;
  std::vector<double> reach_;         ///< metres, by person: nothing of his body is farther from his place
  std::vector<float> hit_clearance_;  ///< of hits_
  std::vector<std::uint64_t> intrusion_;  ///< of bodies, by person, in whole parts
  std::vector<MeasuredPerson> measured_people_;
  std::vector<MeasuredPair> measured_pairs_;
  std::vector<std::size_t> measured_pairs_of_;  ///< by frame
};

}  // namespace bch::detail
