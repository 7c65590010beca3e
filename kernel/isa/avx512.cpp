// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/isa/kernel_table.hpp"

namespace bch::detail {
namespace {

struct EightLanes : Lanes<xsimd::avx2, EightLanes> {};
struct Avx512Lanes : Lanes<xsimd::avx512f, Avx512Lanes> {
  using OfLeaves = EightLanes;
};

}  // namespace

extern const Kernels avx512_kernels;
constinit const Kernels avx512_kernels = kernel_table<Avx512Lanes>;

}  // namespace bch::detail
