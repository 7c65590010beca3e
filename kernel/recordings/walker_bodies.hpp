// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include <bch/bodies.hpp>

#include "kernel/recordings/walker_shapes.hpp"
#include "layout/base/mixed_hash.hpp"
#include "layout/body/body_layout.hpp"

namespace bch::detail {

/// Returns models of bodies of so many spheres: of each character of a cast that is not baked or, where it is empty, of pedestrians, women
/// and then men. Those that come with the library are taken from it, as pedestrians' are, and others are drafts.
/// Errors:  throws std::invalid_argument as default_body() does of pedestrians and make_body() of others, naming the character.
std::vector<BodyModel> body_models(CastView cast, std::uint32_t spheres);

/// Poses bodies of spheres of people, of whom nobody shares a body with anybody.
class WalkerBodies {
 public:
  /// Refers to models of body_models() or others of the same characters, which are valid.
  WalkerBodies(std::span<const BodyModel> models, CastView cast);
  ~WalkerBodies();

  /// Makes characters ready, of the statures that poses have, on all threads.
  void prepare(std::span<const WalkerPose> poses);
  /// Poses one body each, at the exact time, on all threads; several threads may call it at once. prepare() knows these poses.
  BodySet pose(std::span<const WalkerPose> poses) const;

 private:
  struct Body;

  const std::span<const BodyModel> models_;
  const CastView cast_;
  std::vector<BodyLayout> layouts_;  ///< of the models
  std::unordered_map<std::uint64_t, std::unique_ptr<Body>, MixedHash> bodies_;
};

}  // namespace bch::detail
