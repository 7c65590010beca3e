// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/aligned_memory.hpp"

#include <new>

#include "layout/base/system_memory.hpp"

namespace bch::detail {
namespace {

constexpr std::size_t cache_line = 64, large_page = std::size_t{2} << 20;

std::align_val_t alignment_of(std::size_t bytes) {
  return std::align_val_t{bytes < large_page ? cache_line : large_page};
}

}  // namespace

void* allocate_aligned(std::size_t bytes) {
  void* const memory = ::operator new(bytes, alignment_of(bytes));
  if (bytes >= large_page) advise_large_pages(memory, bytes);
  return memory;
}

void free_aligned(void* memory, std::size_t bytes) noexcept {
  ::operator delete(memory, alignment_of(bytes));
}

}  // namespace bch::detail
