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

#include "kernel/recordings/character_library.hpp"
#include "kernel/recordings/walkers.hpp"
#include "layout/base/mixed_hash.hpp"

namespace bch::detail {

/// The rotation of a walker's shoulders.
enum class Shoulders : std::uint8_t { straight, left, right };

/// Represents a walker's pose, rounded to one of finitely many that are built: statures in steps of 4 %, and
/// speeds and phases in steps so small that rounding either moves an outline by less than 1 cm.
struct WalkerPose {
  static constexpr std::uint32_t built_in = 0xffff'ffff, on_foot = 0xffff'ffff;

  std::uint32_t member = built_in;  ///< index in the library
  std::uint32_t footprint =
      on_foot;  ///< for a body that does not walk: the index of its motion; all other members are then 0
  bool is_female;
  std::uint32_t stature;  ///< class
  Shoulders shoulders;
  std::uint32_t clip;  ///< of default_pedestrian(), or of the library's character
  std::uint32_t phase;
  float seconds;        ///< time in the clip, in the middle of the phase
  float exact_seconds;  ///< the time before rounding to a phase

  /// Rounds a walker to a pose. `coarse`: 1 or 3, multiplies the steps of speed and phase, and the exponent
  /// of the step of stature. `library`: the characters whose bodies people have, which do not turn their
  /// shoulders; empty: built-in pedestrians. `motions`: those that rows name.
  WalkerPose(const Walker& walker, Shoulders shoulders, std::uint32_t coarse = 1,
             CharacterLibraryView library = {}, std::span<const LibraryMotion> motions = {});
  std::uint64_t key() const noexcept;
  std::uint64_t body() const noexcept;  ///< the same for all poses of a character in one size
  double metres() const noexcept;       ///< the stature
  PoseTime at() const noexcept;
  /// Returns the pose at the time before rounding.
  PoseTime exact() const noexcept;
  /// Returns the character scaled to the stature.
  Character character(CharacterLibraryView library) const;
};

/// Caches the shapes of poses. Missing shapes are built on all threads and kept for later frames. Above
/// max_bytes, all shapes are dropped, and built again when needed.
class WalkerShapes {
 public:
  /// The largest size of the cache between calls of find(): about 23 000 shapes of whole bodies.
  static constexpr std::size_t max_bytes = std::size_t{256} << 20;

  /// `motions`: those that rows name. `baked`: the shapes of a baked library, or nullptr. Keeps references to
  /// all but the plan.
  WalkerShapes(const ShapeSetPlan& plan, CharacterLibraryView library,
               std::span<const LibraryMotion> motions = {}, const ShapeSet* baked = nullptr);
  ~WalkerShapes();

  /// Finds the index in set() of the shape of each pose, and builds missing shapes.
  /// Returns: the poses that were not found before, or whose shapes were dropped.
  std::span<const WalkerPose> find(std::span<const WalkerPose> poses, std::span<std::uint32_t> shapes);
  /// Returns the shapes, valid until the next call of find().
  const ShapeSet& set() const noexcept { return *set_; }
  /// Returns the number of dropped shapes. Plus an index in set(), it identifies a shape of the whole
  /// recording.
  std::uint32_t given_up() const noexcept { return given_up_; }

 private:
  struct Body;

  void give_up();
  void build(std::span<const WalkerPose> poses);
  std::vector<Body*> bodies_of(std::span<const WalkerPose> poses);

  const ShapeSetPlan plan_;
  const CharacterLibraryView library_;
  const std::span<const LibraryMotion> motions_;
  ShapeSetBuilder builder_;
  const ShapeSet* const baked_;
  const ShapeSet* set_;  ///< the builder's set, or the baked one
  std::vector<WalkerPose> new_;
  std::uint32_t given_up_ = 0;
  std::unordered_map<std::uint64_t, std::uint32_t, MixedHash> number_of_;
  std::unordered_map<std::uint64_t, std::unique_ptr<Body>, MixedHash> bodies_;
};

}  // namespace bch::detail
