// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Adds the segments of a leaf, at least one, to the words of a tree with `leaves` leaves; see shape_set_view.hpp.
void add_leaf(std::span<const std::uint32_t> segments, std::size_t leaf, std::size_t leaves,
              std::vector<std::uint32_t>& words);

/// Returns the segments that a leaf's word names; empty if the leaf has more than max_leaf_segments.
std::vector<std::uint32_t> segments_of(std::span<const std::uint32_t> words, std::size_t leaf);

/// Returns the size of the words and lists of `leaves` leaves, which begin with `words`.
std::size_t leaf_segments_size(std::span<const std::uint32_t> words, std::size_t leaves);

}  // namespace bch::detail
