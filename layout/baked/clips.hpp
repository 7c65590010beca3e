// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/files.hpp>

#include "layout/baked/format.hpp"

namespace bch::detail::baked {

/// Represents clips as the sections of a baked file.
class PackedClips {
 public:
  /// Packs clips, which name some of so many names.
  /// Errors:  throws std::invalid_argument, naming the clip, as validate(AnimatedDiscs) does and on a name that is not there;
  ///          std::length_error beyond 2^32 keys or chunks.
  PackedClips(std::span<const BakedClip> clips, std::size_t names);

  /// Returns the sections, as long as this lives.
  ClipArrays arrays() const noexcept { return {clips_, chunks_, key_times_, disc_steps_, disc_floats_}; }

 private:
  void add(const AnimatedChunk& chunk);

  std::vector<ClipRecord> clips_;
  std::vector<ChunkRecord> chunks_;
  std::vector<double> key_times_;
  std::vector<std::int16_t> disc_steps_;
  std::vector<float> disc_floats_;
};

/// Makes clips of the sections of a file.
/// Errors:  throws std::invalid_argument, naming the section, the place in it and the value, where PackedClips makes no such sections.
std::vector<BakedClip> unpack(const ClipArrays& arrays, std::size_t names);

}  // namespace bch::detail::baked
