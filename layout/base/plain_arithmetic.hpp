// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

// Answers need every operation as IEEE 754 defines it. With -ffast-math one collision in five is lost, and NaN passes
// every check. CMakeLists.txt removes such flags of a parent project; with any other build system, compilation stops
// here.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) ||             \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__) || \
    defined(_M_FP_FAST)
#error \
    "bch: compile without -ffast-math, -Ofast and the flags that they stand for: its answers need IEEE arithmetic"
#endif
