// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include <bch/character.hpp>
#include <bch/shape_set.hpp>

#include "kernel/check/walkers.hpp"

namespace bch::detail {

/// How a walker holds his shoulders.
enum class Shoulders : std::uint8_t { straight, left, right };

/// A walker's pose, of the finitely many that are built: statures in steps of 4 %, and speeds and
/// phases so near each other that neither is off by what moves an outline by a centimetre.
struct WalkerPose {
  bool is_female;
  std::uint32_t stature;  ///< class
  Shoulders shoulders;
  std::uint32_t clip;  ///< of default_pedestrian()
  std::uint32_t phase;

  WalkerPose(const Walker& walker, Shoulders shoulders);
  std::uint64_t key() const noexcept;
  std::uint64_t body() const noexcept;  ///< the same for all that one character has
  double metres() const noexcept;       ///< of the stature
  PoseTime at() const noexcept;
};

/// The shapes of pedestrians in all poses that were asked for so far, each built once, on all threads.
class WalkerShapes {
 public:
  explicit WalkerShapes(const ShapeSetPlan& plan);
  ~WalkerShapes();

  /// Finds the shape of each pose, and builds those that are new.
  void find(std::span<const WalkerPose> poses, std::span<std::uint32_t> shapes);
  /// Returns the shapes so far; they keep their numbers.
  const ShapeSet& set() const noexcept { return *set_; }

 private:
  struct Workshop;

  void build(std::span<const WalkerPose> poses);
  const Character& character(const WalkerPose& pose);

  const ShapeSetPlan plan_;
  std::unique_ptr<ShapeSet> set_;
  std::unordered_map<std::uint64_t, std::uint32_t> number_of_;
  std::unordered_map<std::uint64_t, std::unique_ptr<const Character>> characters_;
};

}  // namespace bch::detail
