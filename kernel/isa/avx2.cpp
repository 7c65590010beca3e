// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/isa/row.hpp"

namespace bch::detail {
namespace {

struct Avx2Lanes : Lanes<xsimd::avx2, Avx2Lanes> {};

}  // namespace

extern const Kernels avx2_kernels;
constinit const Kernels avx2_kernels = Row<Avx2Lanes>::kernels;

}  // namespace bch::detail
