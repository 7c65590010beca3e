// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/baked/format.hpp"
#include "layout/base/aligned_vector.hpp"
#include "tests/support/standard.hpp"

namespace bch::test {

/// Returns a few shapes with blocks, leaf blocks, single discs, several contours.
std::vector<Shape> few_shapes();
ShapeOrigins origins_of(std::size_t shapes);
/// Returns clips of its names: one of numbers of 16 bits, which loops, and one of other numbers and without a name.
std::vector<BakedClip> few_clips();
/// Returns bytes in the place of models, none of which a file reads: three, nothing, and one.
std::vector<BakedBody> few_bodies();

/// All that a set can keep.
inline const ShapeSetPlan full_plan{.depths = {0, 3, all_depths}, .outlines = true, .culling = true};

/// A baked file in memory, for tests that corrupt it.
class BakedBytes {
 public:
  BakedBytes(const ShapeSet& set, const ShapeOrigins& origins, std::span<const BakedClip> clips = {},
             std::span<const BakedBody> bodies = {});

  std::size_t size() const { return bytes_.size(); }
  std::byte& operator[](std::size_t i) { return bytes_[i]; }
  std::string text() const;
  detail::baked::Preamble& preamble() { return *reinterpret_cast<detail::baked::Preamble*>(bytes_.data()); }
  detail::baked::SectionEntry& entry(detail::baked::Section section) {
    return preamble().entries[static_cast<std::uint32_t>(section)];
  }
  template <class Element>
  std::span<Element> section(detail::baked::Section section) {
    return {reinterpret_cast<Element*>(bytes_.data() + entry(section).offset), entry(section).count};
  }
  /// Makes all checksums right again, or the header's alone.
  void seal();
  void seal_header();

  BakedShapes load() const;
  /// Loads the first bytes from a block of memory that ends with them.
  BakedShapes load_first(std::size_t size) const;
  /// Returns the error of load(); empty where there is none.
  std::string error() const;

 private:
  detail::AlignedVector<std::byte> bytes_;
};

}  // namespace bch::test
