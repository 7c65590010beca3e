// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bch::baselines {

/// Provides room that a traversal needs for a moment, on the caller's own stack except for trees of absurd
/// heights. It is not initialised, because a query of one pair would notice the time.
template <class T>
class Scratch {
 public:
  explicit Scratch(std::size_t size) {
    if (size > max_inside) heap_.resize(size);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  T* data() noexcept { return heap_.empty() ? inside_ : heap_.data(); }
  std::size_t size() const noexcept { return heap_.empty() ? max_inside : heap_.size(); }

 private:
  static constexpr std::size_t max_inside = 128;
  T inside_[max_inside];
  std::vector<T> heap_;
};

/// Represents a pair of nodes to visit.
struct NodePair {
  std::uint32_t a, b;
  std::uint32_t depth_a, depth_b;
};

/// Holds the pairs that a depth-first traversal of two trees has left to visit: one for each edge of the two
/// ways down, so the sum of the trees' heights is enough.
class TraversalStack {
 public:
  explicit TraversalStack(std::size_t capacity) : storage_(capacity) {}

  bool empty() const noexcept { return top_ == bottom_; }
  void push(const NodePair& pair) noexcept {
    assert(top_ - bottom_ < static_cast<std::ptrdiff_t>(storage_.size()));
    *top_++ = pair;
  }
  NodePair pop() noexcept { return *--top_; }

 private:
  Scratch<NodePair> storage_;
  NodePair* const bottom_ = storage_.data();
  NodePair* top_ = bottom_;
};

}  // namespace bch::baselines
