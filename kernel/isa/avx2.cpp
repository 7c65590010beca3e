// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/isa/kernel_table.hpp"

namespace bch::detail {
namespace {

struct Avx2Lanes : Lanes<xsimd::avx2, Avx2Lanes> {};

}  // namespace

extern const Kernels avx2_kernels;
constinit const Kernels avx2_kernels = kernel_table<Avx2Lanes>;

}  // namespace bch::detail
