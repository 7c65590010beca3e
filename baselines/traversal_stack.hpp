// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bch::baselines {

/// A pair of nodes to visit.
struct NodePair {
  std::uint32_t a, b;
  std::uint32_t depth_a, depth_b;
};

/// A depth-first traversal of two trees leaves one pair on the stack for each edge of the two ways down, so
/// the sum of the trees' heights is enough. That much lies on the caller's own stack, except for trees of
/// absurd heights.
class TraversalStack {
 public:
  explicit TraversalStack(std::size_t capacity) {
    if (capacity <= most_inside) return;
    heap_.resize(capacity);
    top_ = bottom_ = heap_.data();
  }
  TraversalStack(const TraversalStack&) = delete;
  TraversalStack& operator=(const TraversalStack&) = delete;

  bool empty() const noexcept { return top_ == bottom_; }
  void push(const NodePair& pair) noexcept {
    assert(top_ - bottom_ < static_cast<std::ptrdiff_t>(heap_.empty() ? most_inside : heap_.size()));
    *top_++ = pair;
  }
  NodePair pop() noexcept { return *--top_; }

 private:
  static constexpr std::size_t most_inside = 128;
  NodePair inside_[most_inside];
  std::vector<NodePair> heap_;
  NodePair* bottom_ = inside_;
  NodePair* top_ = inside_;
};

}  // namespace bch::baselines
