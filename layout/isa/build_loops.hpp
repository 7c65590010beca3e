// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/base/build_implementation.hpp"
#include "layout/body/posing/posing_lanes.hpp"
#include "layout/character/blend_lanes.hpp"
#include "layout/culling/cut_lanes.hpp"
#include "layout/culling/interior_lanes.hpp"
#include "layout/enclosing_disc/disc_lanes.hpp"
#include "layout/outline/lanes.hpp"

namespace bch::detail {

/// Holds all loops compiled for the lanes of one instruction set. `Simd` has to be of an anonymous namespace where it needs
/// more than every processor has, so that instruction sets share no function.
template <class Simd>
constexpr BuildLoops build_loops{DiscLanes<Simd>::solve,     OutlineLanes<Simd>::loops,
                                 InteriorLanes<Simd>::loops, PosingLanes<Simd>::loops,
                                 BlendLanes<Simd>::loops,    CutLanes<Simd>::heights};

}  // namespace bch::detail
