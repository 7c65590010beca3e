// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include <bch/characters.hpp>
#include <bch/shapes.hpp>

#include "kernel/recordings/walker_cast.hpp"
#include "kernel/recordings/walkers.hpp"
#include "layout/base/mixed_hash.hpp"

namespace bch::detail {

/// Says how a walker holds his shoulders.
enum class Shoulders : std::uint8_t { straight, left, right };

/// Represents a walker's pose, of the finitely many that are built: statures in steps of 4 %, and speeds and
/// phases so near each other that neither is off by what moves an outline by a centimetre.
struct WalkerPose {
  static constexpr std::uint32_t built_in = 0xffff'ffff, on_foot = 0xffff'ffff;

  std::uint32_t member = built_in;  ///< of the cast
  std::uint32_t footprint =
      on_foot;  ///< of a body that does not walk: the number of its motion, and all else is 0
  bool is_female;
  std::uint32_t stature;  ///< class
  Shoulders shoulders;
  std::uint32_t clip;  ///< of default_pedestrian(), or of the cast's character
  std::uint32_t phase;
  float seconds;        ///< of the clip, in the middle of the phase
  float exact_seconds;  ///< before it was rounded to a phase

  /// Rounds a person to a pose. `coarse`, 1 or 3, multiplies the steps of speed and phase, and the exponent of the step of stature.
  /// `cast` are the characters whose bodies people have, or the pedestrians' where it is empty; members of a cast do not turn their
  /// shoulders. `motions` are those that rows name.
  WalkerPose(const Walker& walker, Shoulders shoulders, std::uint32_t coarse = 1, CastView cast = {},
             std::span<const CastMotion> motions = {});
  std::uint64_t key() const noexcept;
  std::uint64_t body() const noexcept;  ///< the same for all that one character has
  double metres() const noexcept;       ///< of the stature
  PoseTime at() const noexcept;
  /// Returns the time that was not rounded.
  PoseTime exact() const noexcept;
  /// Returns the character in the stature.
  Character character(CastView cast) const;
};

/// Keeps the shapes of people in poses. New ones are built on all threads and kept for the next frames. Where they need too much
/// memory, all are dropped, and those that are needed again are built again.
class WalkerShapes {
 public:
  /// The most bytes that are kept from one call of find() to the next: some 23 000 shapes of whole bodies.
  static constexpr std::size_t max_bytes = std::size_t{256} << 20;

  /// Takes the plan, the cast and the motions that rows name. `baked`: the shapes of a cast that is baked, or nullptr. All of them live as
  /// long as this.
  WalkerShapes(const ShapeSetPlan& plan, CastView cast, std::span<const CastMotion> motions = {},
               const ShapeSet* baked = nullptr);
  ~WalkerShapes();

  /// Finds the shape of each pose, as its index in set(), and builds those that are new.
  /// Returns: the poses that are new, or were given up.
  std::span<const WalkerPose> find(std::span<const WalkerPose> poses, std::span<std::uint32_t> shapes);
  /// Returns the shapes, which stay until the next call of find().
  const ShapeSet& set() const noexcept { return *set_; }
  /// Returns how many shapes were given up: their number and an index in set() are a number that no other shape has.
  std::uint32_t given_up() const noexcept { return given_up_; }

 private:
  struct Body;

  void give_up();
  void build(std::span<const WalkerPose> poses);
  std::vector<Body*> bodies_of(std::span<const WalkerPose> poses);

  const ShapeSetPlan plan_;
  const CastView cast_;
  const std::span<const CastMotion> motions_;
  ShapeSetBuilder builder_;
  const ShapeSet* const baked_;
  const ShapeSet* set_;  ///< the builder's, or those that are baked
  std::vector<WalkerPose> new_;
  std::uint32_t given_up_ = 0;
  std::unordered_map<std::uint64_t, std::uint32_t, MixedHash> number_of_;
  std::unordered_map<std::uint64_t, std::unique_ptr<Body>, MixedHash> bodies_;
};

}  // namespace bch::detail
