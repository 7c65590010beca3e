// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <vector>

#include "layout/base/aligned_memory.hpp"

namespace bch::detail {

/// Allocates on cache lines, which are as wide as the widest SIMD registers, and large arrays on large pages.
template <class Value>
struct CacheLineAllocator {
  using value_type = Value;

  CacheLineAllocator() = default;
  template <class Other>
  CacheLineAllocator(const CacheLineAllocator<Other>&) noexcept {}

  Value* allocate(std::size_t count) { return static_cast<Value*>(allocate_aligned(count * sizeof(Value))); }
  void deallocate(Value* values, std::size_t count) noexcept { free_aligned(values, count * sizeof(Value)); }
  friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

template <class Value>
using AlignedVector = std::vector<Value, CacheLineAllocator<Value>>;

}  // namespace bch::detail
