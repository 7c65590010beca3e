// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/isa/kernel_table.hpp"

namespace bch::detail {
namespace {

struct Simd128Lanes : Lanes<PortableArch, Simd128Lanes> {};

}  // namespace

extern const Kernels simd128_kernels;
constinit const Kernels simd128_kernels = kernel_table<Simd128Lanes>;

}  // namespace bch::detail
