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

/// Describes how deep somebody is in a wall.
struct WallDepth {
  std::uint32_t segment;  ///< the nearest, or that of DiscPair::none
  float depth;            ///< metres
  float x, y;             ///< where he has to move
};

/// Answers about the bodies that the people of a run of frames have, and those of the frame behind it.
class RunBodies {
 public:
  virtual ~RunBodies() = default;

  /// Returns the number of each person's body, which is the shape of the agents below.
  virtual std::span<const std::uint32_t> numbers() const noexcept = 0;
  /// Returns the roots, for the broad phase.
  virtual const ShapeSetView& roots() const noexcept = 0;

  /// Finds who overlaps.
  virtual void collide(const Agents& agents, std::span<const Pair> pairs,
                       std::span<std::uint8_t> hits) const = 0;
  /// Finds who touches, in the sense of times_of_impact().
  virtual void touch(const Agents& agents, std::span<const Pair> pairs,
                     std::span<std::uint8_t> hits) const = 0;
  /// Measures how deep those overlap who do.
  virtual std::vector<Penetration> depths(const Agents& agents, std::span<const Pair> pairs) const = 0;
  /// Measures how far people are apart who do not overlap, by what decides whether they do; infinite beyond the distance.
  virtual std::vector<float> gaps(const Agents& agents, std::span<const Pair> pairs,
                                  double max_distance) const = 0;
  /// Finds when people touch who move, a share of their way.
  virtual std::vector<float> times_of_impact(const Agents& agents, std::span<const Pair> pairs,
                                             const Displacements& displacements) const = 0;

  /// Finds who is in a wall.
  virtual void collide(const Agents& agents, const ObstacleSet& walls,
                       std::span<std::uint8_t> hits) const = 0;
  /// Measures how deep those are in walls who are.
  virtual std::vector<WallDepth> wall_depths(const Agents& agents, const ObstacleSet& walls) const = 0;
};

/// Answers what shapes and bodies of spheres are asked in the same way. `Set` is a set, or a reference to one that lives longer.
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
  static constexpr std::uint32_t directions = 32;  ///< of which the best one tells the depth

  Set set_;
  const AllOptions options_;
};

/// Answers by outlines, seen from above.
class RunOutlines : public RunOf<const ShapeSet&> {
 public:
  /// Refers to a set, and to the shapes of all people.
  RunOutlines(const ShapeSet& set, Leaves leaves, std::span<const std::uint32_t> numbers)
      : RunOf(set, {.leaves = leaves, .distance_leaves = leaves}), numbers_(numbers) {}

  std::span<const std::uint32_t> numbers() const noexcept override { return numbers_; }
  const ShapeSetView& roots() const noexcept override { return set().view(); }
  void touch(const Agents& agents, std::span<const Pair> pairs, std::span<std::uint8_t> hits) const override;
  std::vector<WallDepth> wall_depths(const Agents& agents, const ObstacleSet& walls) const override;

 private:
  const std::span<const std::uint32_t> numbers_;
};

/// Answers by bodies of spheres, in space. Depths in walls are the deepest overlaps of a sphere and a wall.
class RunSpheres : public RunOf<BodySet> {
 public:
  /// Poses the bodies of `people` of the run. Of the others, who are behind them, touch() poses those that it is asked about. Refers to all
  /// arguments.
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
