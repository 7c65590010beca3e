// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/format/shape_set_view.hpp"
#include "layout/shape_set/shape_storage.hpp"
#include "tests/support/baked_bytes.hpp"

namespace bch::test {

/// Adds to a number that is kept among floats.
inline void add(float& name, std::uint32_t to) {
  name = std::bit_cast<float>(std::bit_cast<std::uint32_t>(name) + to);
}

/// The arrays of a set of few_shapes(), to be damaged, and what does not fit into them.
struct DamagedArrays {
  detail::ShapeStorage own;
  detail::AlignedVector<float> beside;
  std::function<void(detail::ShapeArrays&)> last = [](detail::ShapeArrays&) {};

  explicit DamagedArrays(const ShapeSetPlan& plan = {.depths = {0, 3, all_depths}, .outlines = true}) {
    const ShapeSet set(few_shapes(), plan);
    detail::for_each_array(
        [](const char*, auto& to, const auto& from) { to.assign(from.begin(), from.end()); }, own,
        set.arrays());
  }

  detail::ShapeArrays view() const {
    detail::ShapeArrays all = own.arrays();
    last(all);
    return all;
  }

  static constexpr std::size_t finest = 2;
  /// The first shape's finest level: a tree of several blocks.
  detail::Tree& tree() { return own.trees[finest]; }
  float* top_block() { return own.nodes.data() + tree().top; }
  float& name(float* block, std::uint32_t lane) { return block[detail::block_names + lane]; }
  void set_child(std::uint32_t name_of_first) { name(top_block(), 0) = std::bit_cast<float>(name_of_first); }
  /// The first block all of whose names are windows.
  float* lowest_block() {
    float* block = top_block();
    while (std::bit_cast<std::uint32_t>(name(block, 0)) < detail::leaf_window) block += detail::block_floats;
    return block;
  }
  /// The discs of the level: x, and from there to y and to radii.
  float* discs() { return own.nodes.data() + tree().discs; }
  float* radii() { return discs() + 2 * std::size_t{tree().stride}; }
  float& smallest_disc() { return *std::min_element(radii(), radii() + tree().stride); }
  /// The node above a disc of the level: x, y, radius and link.
  float* inner_node(std::uint32_t disc) {
    return own.nodes.data() + (tree().first_inner() + disc) * std::size_t{detail::inner_floats};
  }
  std::uint32_t link(std::uint32_t disc) { return std::bit_cast<std::uint32_t>(inner_node(disc)[3]); }
  /// The first inner node that no block has.
  std::uint32_t node_of_no_block() {
    for (std::uint32_t k = 0;; ++k) {
      bool is_in_block = false;
      for (std::size_t block = tree().top; block < tree().discs; block += detail::block_floats)
        for (std::uint32_t lane = 0; lane < detail::block_width; ++lane)
          is_in_block |= std::bit_cast<std::uint32_t>(own.nodes[block + detail::block_nodes + lane]) ==
                         tree().first_inner() + k;
      if (!is_in_block) return k;
    }
  }
};

}  // namespace bch::test
