// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/obstacles/box_tree.hpp"

#include <algorithm>
#include <limits>

namespace bch::detail {
namespace {

/// Twice the middle of a box, along x or y.
struct Middle {
  std::span<const Box> boxes;
  bool along_y;
  double operator()(std::uint32_t i) const noexcept {
    const Box& box = boxes[i];
    return along_y ? box.low_y + box.high_y : box.low_x + box.high_x;
  }
};

/// Halves what nodes of a level hold where their middles are, again and again, so that every eight that follow each other are
/// neighbours. Halves are whole nodes of the level below, all full but the last.
void sort(std::span<const Box> boxes, std::span<std::uint32_t> order) {
  if (order.size() <= 8) return;
  std::size_t node = 8;
  while (node * 8 < order.size()) node *= 8;
  const std::size_t nodes = (order.size() + node - 1) / node, half = (nodes + 1) / 2 * node;
  const auto extent = [&](bool along_y) {
    const Middle middle{boxes, along_y};
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const std::uint32_t i : order) low = std::min(low, middle(i)), high = std::max(high, middle(i));
    return high - low;
  };
  const Middle middle{boxes, extent(true) > extent(false)};
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return middle(a) != middle(b) ? middle(a) < middle(b) : a < b;
                   });
  sort(boxes, order.first(half));
  sort(boxes, order.subspan(half));
}

BoxBlock empty_block() {
  BoxBlock block;
  constexpr double far = std::numeric_limits<double>::infinity();
  for (unsigned i = 0; i < 8; ++i)
    block.low_x[i] = block.low_y[i] = far, block.high_x[i] = block.high_y[i] = -far;
  return block;
}

void store(BoxBlock& block, std::size_t i, const Box& box) {
  block.low_x[i] = box.low_x, block.low_y[i] = box.low_y;
  block.high_x[i] = box.high_x, block.high_y[i] = box.high_y;
}

Box box_of(const BoxBlock& block) {
  return {*std::min_element(block.low_x, block.low_x + 8), *std::min_element(block.low_y, block.low_y + 8),
          *std::max_element(block.high_x, block.high_x + 8),
          *std::max_element(block.high_y, block.high_y + 8)};
}

}  // namespace

BoxTreeMemory::BoxTreeMemory(std::span<const Box> boxes) : order(boxes.size()) {
  for (std::uint32_t i = 0; i < boxes.size(); ++i) order[i] = i;
  sort(boxes, order);
  view.levels = 0;
  std::vector<Box> level;
  for (const std::uint32_t i : order) level.push_back(boxes[i]);
  while (!level.empty() && (level.size() > 1 || view.levels == 0)) {
    view.level_begin[view.levels++] = static_cast<std::uint32_t>(blocks.size());
    std::vector<Box> above;
    for (std::size_t i = 0; i < level.size(); i += 8) {
      BoxBlock& block = blocks.emplace_back(empty_block());
      for (std::size_t k = i; k < std::min(i + 8, level.size()); ++k) store(block, k - i, level[k]);
      above.push_back(box_of(block));
    }
    level = std::move(above);
  }
  view.blocks = blocks.data();
}

}  // namespace bch::detail
