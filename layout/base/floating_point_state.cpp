// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/floating_point_state.hpp"

#include "layout/base/floating_point_register.hpp"

namespace bch::detail {
namespace {

bool is_standard(unsigned state) {
  return (state & ~floating_point_register::flags) == floating_point_register::standard;
}

}  // namespace

// The function is not inline, so that no computation moves out of the guarded part. Writing the register
// takes longer than reading it.
FloatingPointStateGuard::FloatingPointStateGuard() noexcept : before_(floating_point_register::read()) {
  if (!is_standard(before_)) floating_point_register::write(floating_point_register::standard);
}

FloatingPointStateGuard::~FloatingPointStateGuard() {
  if (!is_standard(before_)) floating_point_register::write(before_);
}

}  // namespace bch::detail
