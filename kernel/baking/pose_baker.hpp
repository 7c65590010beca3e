// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <bch/poses.hpp>
#include <bch/scene_plan.hpp>
#include <bch/shapes.hpp>

#include "kernel/runtime/spares.hpp"

namespace bch::detail {

/// Names a character for errors; it must outlive whoever is given it.
struct BakedCharacter {
  const Character* character;
  std::string name;
};

/// Names a pose of one of several characters.
struct PoseOfCharacter {
  std::uint32_t character = 0;
  Pose pose;
};

/// Holds what happens between the steps of a baker; functions may be empty. Any thread calls them.
struct BakeSteps {
  std::function<void(std::size_t i, const Shape&)> outlined =
      {};                                         ///< before the hierarchies are made; throws to refuse
  std::function<void(std::size_t i)> added = {};  ///< in order, one call at a time
};

/// Makes shapes of characters in poses, on all threads, and adds them to a builder in the order of the poses: the same
/// bytes for any number of threads. What was learned of the meshes is kept for the next poses.
class PoseBaker {
 public:
  /// Takes characters that are valid, and what ShapeBuilder takes.
  /// Errors:  throws std::invalid_argument on a bad plan.
  PoseBaker(std::vector<BakedCharacter> characters, const ShapeSetPlan& plan, float threshold,
            std::optional<std::size_t> max_nodes = {});

  /// Adds the shapes of `count` poses. After an exception only some of them have been added.
  /// Errors:  throws what ShapeBuilder::shape() and `steps` throw, the former with the names of the character and of the clip and time or
  ///          the pose's number, and std::invalid_argument on a character that is not there.
  void add(ShapeSetBuilder& to, std::size_t count, const std::function<PoseOfCharacter(std::size_t)>& pose_of,
           const BakeSteps& steps = {});
  void add(ShapeSetBuilder& to, std::span<const PoseId> sources, const BakeSteps& steps = {});

 private:
  void prepare(BuiltShape& place, const PoseOfCharacter& source, std::size_t i, const BakeSteps& steps);
  ShapeBuilder shape_builder_of(std::uint32_t character) const;
  std::string name_of(const PoseOfCharacter& source, std::size_t i) const;

  std::vector<BakedCharacter> characters_;
  ShapeSetPlan plan_;
  float threshold_;
  std::optional<std::size_t> max_nodes_;
  std::vector<Spares<ShapeBuilder>> shape_builders_;  ///< by character
};

}  // namespace bch::detail
