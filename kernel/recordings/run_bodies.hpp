// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <bch/body_set.hpp>
#include <bch/obstacles.hpp>
#include <bch/pairs.hpp>

#include "kernel/recordings/walker_bodies.hpp"
#include "kernel/runtime/all_options.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Describes the overlap of a person and a wall.
struct WallDepth {
  std::uint32_t segment;  ///< the nearest segment, or DiscPair::none.second
  float depth;            ///< metres
  float x, y;             ///< unit vector of the separating displacement
};

/// Answers queries about the bodies of the people of a run, and of the frame after it.
class RunBodies {
 public:
  virtual ~RunBodies() = default;

  /// Returns the number of each person's body, which is the `shape` of the agents below.
  virtual std::span<const std::uint32_t> numbers() const noexcept = 0;
  /// Returns the bodies' roots, for the broad phase.
  virtual const ShapeSetView& roots() const noexcept = 0;

  /// Finds the pairs that overlap.
  virtual void collide(const Agents& agents, std::span<const Pair> pairs,
                       std::span<std::uint8_t> hits) const = 0;
  /// Finds the pairs that touch, by the criterion of times_of_impact().
  virtual void touch(const Agents& agents, std::span<const Pair> pairs,
                     std::span<std::uint8_t> hits) const = 0;
  /// Measures the depths of pairs that overlap.
  virtual std::vector<Penetration> depths(const Agents& agents, std::span<const Pair> pairs) const = 0;
  /// Measures the gaps of pairs that do not overlap, between the features that decide about overlaps;
  /// infinite beyond `max_distance`.
  virtual std::vector<float> gaps(const Agents& agents, std::span<const Pair> pairs,
                                  double max_distance) const = 0;
  /// Finds the times at which moving people touch, as fractions of the displacements.
  virtual std::vector<float> times_of_impact(const Agents& agents, std::span<const Pair> pairs,
                                             const Displacements& displacements) const = 0;

  /// Finds the people who are in a wall.
  virtual void collide(const Agents& agents, const ObstacleSet& walls,
                       std::span<std::uint8_t> hits) const = 0;
  /// Measures the depths of people who are in walls.
  virtual std::vector<WallDepth> wall_depths(const Agents& agents, const ObstacleSet& walls) const = 0;
};

/// Answers the queries that are the same for shapes and for bodies of spheres. `Set` is a set, or a reference
/// to one that lives longer.
template <class Set>
class RunOf : public RunBodies {
 public:
  void collide(const Agents& agents, std::span<const Pair> pairs,
               std::span<std::uint8_t> hits) const override {
    bch::collide(set_, agents, pairs, hits, options_);
  }
  std::vector<Penetration> depths(const Agents& agents, std::span<const Pair> pairs) const override {
    std::vector<Penetration> depths(pairs.size());
    penetration(set_, agents, pairs, directions, depths);
    return depths;
  }
  std::vector<float> gaps(const Agents& agents, std::span<const Pair> pairs,
                          double max_distance) const override {
    std::vector<float> gaps(pairs.size());
    clearance(set_, agents, pairs, {gaps}, options_.within(max_distance));
    return gaps;
  }
  std::vector<float> times_of_impact(const Agents& agents, std::span<const Pair> pairs,
                                     const Displacements& displacements) const override {
    std::vector<float> times(pairs.size());
    time_of_impact(set_, agents, pairs, displacements, times);
    return times;
  }
  void collide(const Agents& agents, const ObstacleSet& walls, std::span<std::uint8_t> hits) const override {
    bch::collide(set_, agents, walls, hits, options_);
  }

 protected:
  RunOf(Set set, const AllOptions& options) : set_(std::forward<Set>(set)), options_(options) {}
  const std::remove_reference_t<Set>& set() const noexcept { return set_; }

 private:
  static constexpr std::uint32_t directions = 32;  ///< for penetration(): the depth is that of the best one

  Set set_;
  const AllOptions options_;
};

/// Answers queries by outlines, seen from above.
class RunOutlines : public RunOf<const ShapeSet&> {
 public:
  /// Keeps references to a set, and to the shape of each person.
  RunOutlines(const ShapeSet& set, Leaves leaves, std::span<const std::uint32_t> numbers)
      : RunOf(set, {.leaves = leaves, .distance_leaves = leaves}), numbers_(numbers) {}

  std::span<const std::uint32_t> numbers() const noexcept override { return numbers_; }
  const ShapeSetView& roots() const noexcept override { return set().view(); }
  void touch(const Agents& agents, std::span<const Pair> pairs, std::span<std::uint8_t> hits) const override;
  std::vector<WallDepth> wall_depths(const Agents& agents, const ObstacleSet& walls) const override;

 private:
  const std::span<const std::uint32_t> numbers_;
};

/// Answers queries by bodies of spheres, in 3D. The depth in a wall is that of the deepest sphere.
class RunSpheres : public RunOf<BodySet> {
 public:
  /// Poses the bodies of the first `people` poses, those of the run. touch() poses bodies of the next frame
  /// as needed. Keeps references to its arguments.
  RunSpheres(const WalkerBodies& bodies, std::span<const WalkerPose> poses, std::size_t people);

  std::span<const std::uint32_t> numbers() const noexcept override { return numbers_; }
  const ShapeSetView& roots() const noexcept override;
  void touch(const Agents& agents, std::span<const Pair> pairs, std::span<std::uint8_t> hits) const override;
  std::vector<WallDepth> wall_depths(const Agents& agents, const ObstacleSet& walls) const override;

 private:
  const WalkerBodies& walkers_;
  const std::span<const WalkerPose> poses_;
  std::vector<std::uint32_t> numbers_;
};

}  // namespace bch::detail
