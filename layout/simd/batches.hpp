// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/base/processor.hpp"

// xsimd with the processors that it lacks. It looks its functions up where its batches are defined, so that ours stand before.
#include <xsimd/config/xsimd_config.hpp>
#undef XSIMD_NO_SUPPORTED_ARCHITECTURE
#if BCH_NEON
#include "layout/simd/neon_arch.hpp"
#elif BCH_PORTABLE
#include "layout/simd/portable_arch.hpp"
#endif
#include <xsimd/xsimd.hpp>

namespace bch::detail {

/// Selects what every processor of this kind has.
#if BCH_X86
using BaseArch = xsimd::sse2;
#elif BCH_NEON
using BaseArch = NeonArch;
#else
using BaseArch = PortableArch;
#endif

}  // namespace bch::detail
