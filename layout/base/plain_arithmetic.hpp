// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

// Answers need every operation as IEEE 754 has it. With -ffast-math one collision in five is lost, and NaN passes every check.
// CMakeLists.txt undoes such flags of a parent project; a build of another kind stops here.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) ||             \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__) || \
    defined(_M_FP_FAST)
#error \
    "bch: compile without -ffast-math, -Ofast and the flags that they stand for: its answers need IEEE arithmetic"
#endif
