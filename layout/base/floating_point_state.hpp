// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

namespace bch::detail {

/// Sets the floating-point state of its thread to the default of IEEE 754 during its lifetime: rounding to nearest,
/// denormal numbers kept, no traps. Its destructor restores the thread's own state. Callers may have set another
/// state (a program that is linked with -ffast-math begins without denormal numbers), and a task may run in a thread that was left in one.
/// So each public function that makes shapes or answers holds one of these, and each of its tasks another; that is where answers get their
/// bits, and the bounds of layout/base/rounding.hpp hold only here.
class FloatingPointStateGuard {
 public:
  FloatingPointStateGuard() noexcept;
  ~FloatingPointStateGuard();
  FloatingPointStateGuard(const FloatingPointStateGuard&) = delete;
  FloatingPointStateGuard& operator=(const FloatingPointStateGuard&) = delete;

 private:
  unsigned before_;
};

}  // namespace bch::detail
