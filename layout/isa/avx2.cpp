// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/isa/build_loops.hpp"

namespace bch::detail {
namespace {

struct Avx2Lanes : Lanes<xsimd::avx2, Avx2Lanes> {};

}  // namespace

extern const BuildLoops avx2_loops;
constinit const BuildLoops avx2_loops = build_loops<Avx2Lanes>;

}  // namespace bch::detail
