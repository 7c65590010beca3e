// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/isa/row.hpp"

namespace bch::detail {
namespace {

struct Sse2Lanes : Lanes<xsimd::sse2, Sse2Lanes> {};

}  // namespace

extern const Kernels sse2_kernels;
constinit const Kernels sse2_kernels = Row<Sse2Lanes>::kernels;

}  // namespace bch::detail
