// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

namespace bch::detail {

/// Sets the floating-point state of its thread to the default of IEEE 754 during its lifetime: rounding to nearest,
/// denormal numbers kept, no traps. The destructor restores the previous state. A caller may have set another state
/// (a program linked with -ffast-math begins without denormal numbers), and a task may run in a thread that was left
/// in another state. So each public function that makes shapes or answers has a guard, and so has each of its tasks:
/// reproducible bits and the bounds of layout/base/rounding.hpp hold only under a guard.
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
