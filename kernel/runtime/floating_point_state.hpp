// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

namespace bch::detail {

/// Sets the floating-point state of its thread to the default of IEEE 754 during its lifetime: rounding to nearest,
/// denormal numbers kept, no traps. Its destructor restores the thread's own state. Callers may have set another
/// state, and a task may run in a thread that was left in one, so a query holds one of these, and each of its tasks
/// another; that is where answers get their bits, and the bounds of layout/base/rounding.hpp hold only here.
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
