// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/isa/kernel_table.hpp"

namespace bch::detail {
namespace {

struct NeonLanes : Lanes<NeonArch, NeonLanes> {};

}  // namespace

extern const Kernels neon_kernels;
constinit const Kernels neon_kernels = kernel_table<NeonLanes>;

}  // namespace bch::detail
