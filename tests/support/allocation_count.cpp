// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/allocation_count.hpp"

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace {

using bch::test::Failing;

std::atomic<std::size_t> count = 0;
std::atomic<std::size_t> live = 0;
std::atomic<Failing> failing = Failing::none;
std::atomic<std::int64_t> until_failure = 0;
std::atomic<std::size_t> failures = 0;

/// Counts a call. Returns: whether it has to fail.
bool fails() {
  ++count;
  const Failing mode = failing;
  if (mode == Failing::none) return false;
  const std::int64_t left = until_failure--;
  const bool now = mode == Failing::one ? left == 0 : left <= 0;
  failures += now ? 1 : 0;
  return now;
}

#if defined(_WIN32)
void* take(std::size_t alignment, std::size_t size) {
  return _aligned_malloc(size, alignment);
}
void give_back(void* memory) {
  _aligned_free(memory);
}
#else
void* take(std::size_t alignment, std::size_t size) {
  return std::aligned_alloc(alignment, size);
}
void give_back(void* memory) {
  std::free(memory);
}
#endif

void* try_allocate(std::size_t size, std::size_t alignment) {
  if (fails()) return nullptr;
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;
  void* const memory = take(alignment, whole > 0 ? whole : alignment);
  live += memory != nullptr ? 1 : 0;
  return memory;
}

void* allocate(std::size_t size, std::size_t alignment) {
  if (void* memory = try_allocate(size, alignment)) return memory;
  throw std::bad_alloc();
}

void release(void* memory) {
  live -= memory != nullptr ? 1 : 0;
  give_back(memory);
}

}  // namespace

void* operator new(std::size_t size) {
  return allocate(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return try_allocate(size, alignof(std::max_align_t));
}
void operator delete(void* memory) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  release(memory);
}

namespace bch::test {

std::size_t allocation_count() {
  return count;
}

std::size_t live_allocations() {
  return live;
}

void fail_allocations(Failing mode, std::size_t after) {
  failing = Failing::none;
  until_failure = static_cast<std::int64_t>(after);
  failures = 0;
  failing = mode;
}

std::size_t stop_failing_allocations() {
  failing = Failing::none;
  return failures;
}

}  // namespace bch::test
