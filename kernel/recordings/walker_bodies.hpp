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

/// Returns models of bodies of `spheres` spheres, one per character of a library that is not baked; for an empty
/// library, of the built-in woman and man. Models of built-in characters come from the library, others are
/// drafts.
/// Errors:  throws std::invalid_argument like default_body() and make_body(), naming the character.
std::vector<BodyModel> body_models(CharacterLibraryView library, std::uint32_t spheres);

/// Poses bodies of spheres, one per person.
class WalkerBodies {
 public:
  /// Keeps references to valid models of the characters of `library`, for example from body_models().
  WalkerBodies(std::span<const BodyModel> models, CharacterLibraryView library);
  ~WalkerBodies();

  /// Builds the characters in the statures of some poses, on all threads.
  void prepare(std::span<const WalkerPose> poses);
  /// Poses one body per pose at its exact time, on all threads. Several threads may call it at once. The
  /// poses were passed to prepare().
  BodySet pose(std::span<const WalkerPose> poses) const;

 private:
  struct Body;

  const std::span<const BodyModel> models_;
  const CharacterLibraryView library_;
  std::vector<BodyLayout> layouts_;  ///< of the models
  std::unordered_map<std::uint64_t, std::unique_ptr<Body>, MixedHash> bodies_;
};

}  // namespace bch::detail
