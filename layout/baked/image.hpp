// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <bch/files.hpp>
#include <bch/shapes.hpp>

#include "layout/baked/clips.hpp"
#include "layout/baked/format.hpp"
#include "layout/base/aligned_vector.hpp"

namespace bch::detail {

/// Represents a set as the bytes of a baked file (format.hpp), without a copy of its arrays.
class BakedImage {
 public:
  /// Takes a set, which has to outlive this.
  /// Errors:  throws std::invalid_argument where load_baked() would refuse the file: a set out of the domain of
  ///          validate(ShapeArrays), origins of another number of shapes, names that are not there, bad clips.
  BakedImage(const ShapeSet& set, const ShapeOrigins& origins, std::span<const BakedClip> clips = {},
             std::span<const BakedBody> bodies = {});
  BakedImage(const BakedImage&) = delete;
  BakedImage& operator=(const BakedImage&) = delete;

  /// Returns the file's parts, to be written one after the other: the preamble, then the sections, and after each of
  /// them its zeros.
  std::span<const std::span<const std::byte>> parts() const noexcept { return parts_; }

 private:
  void add_names(const std::vector<std::string>& names);
  void add_bodies(std::span<const BakedBody> bodies);
  void lay_out();

  baked::Preamble preamble_{};
  baked::Settings settings_;
  std::vector<ShapeOrigin> origins_;
  std::vector<std::uint32_t> name_begin_;
  std::vector<char> names_;
  baked::PackedClips clips_;
  std::vector<std::uint64_t> body_ends_;
  std::vector<std::byte> body_bytes_;
  baked::Arrays arrays_;
  std::vector<std::span<const std::byte>> parts_;
};

}  // namespace bch::detail
