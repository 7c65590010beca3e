// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <memory>
#include <optional>
#include <string>

#include <bch/bodies.hpp>
#include <bch/body_set.hpp>
#include <bch/characters.hpp>
#include <bch/files.hpp>
#include <bch/poses.hpp>
#include <bch/shapes.hpp>

#include "kernel/c_api/handles.hpp"

// What stands behind the handles that several files use.

struct bch_character {
  std::shared_ptr<const bch::Character> character;
  std::string name;
  float height = 0;        ///< of an imported one's rest pose, metres
  std::string notes = {};  ///< of its import, a line each
};

/// Holds a set of its own, or one that a dynamic set lends.
struct bch_shape_set {
  explicit bch_shape_set(bch::BakedShapes baked)
      : own(std::make_unique<bch::BakedShapes>(std::move(baked))), set(own->set) {}
  explicit bch_shape_set(const bch::ShapeSet& lent) : set(lent) {}

  const std::unique_ptr<bch::BakedShapes> own;
  const bch::ShapeSet& set;
};

/// Holds bodies of its own, or those that live bodies lend.
struct bch_body_set {
  explicit bch_body_set(bch::BodySet&& bodies)
      : own(std::make_unique<bch::BodySet>(std::move(bodies))), set(*own) {}
  explicit bch_body_set(const bch::BodySet& lent) : set(lent) {}

  const std::unique_ptr<bch::BodySet> own;
  const bch::BodySet& set;
};

struct bch_body_model {
  explicit bch_body_model(bch::BodyModel of) : model(std::move(of)) {}

  const bch::BodyModel model;
};

struct bch_animated_shape {
  explicit bch_animated_shape(bch::AnimatedDiscs of) : discs(std::move(of)), shape(discs) {}

  const bch::AnimatedDiscs discs;  ///< for sets that are saved with them
  const bch::AnimatedShape shape;
};

struct bch_shape_builder {
  bch_shape_builder(const bch_character& of, const bch::ShapeSetPlan& plan, float threshold)
      : character(of.character), name(of.name), shape_builder(*character, plan, threshold) {}

  const std::shared_ptr<const bch::Character> character;
  const std::string name;
  bch::ShapeBuilder shape_builder;
  const bch::Shape* made = nullptr;
  bch::PoseTime at = {};
};
