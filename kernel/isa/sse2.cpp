// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/isa/kernel_table.hpp"

namespace bch::detail {
namespace {

struct Sse2Lanes : Lanes<xsimd::sse2, Sse2Lanes> {};

}  // namespace

extern const Kernels sse2_kernels;
constinit const Kernels sse2_kernels = kernel_table<Sse2Lanes>;

}  // namespace bch::detail
