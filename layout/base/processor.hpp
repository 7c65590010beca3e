// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

// Which processor is compiled for: one of these is 1. BCH_SCALAR, of CMake's BCH_ISA, asks for what every processor runs.
#if !defined(BCH_SCALAR) && defined(__x86_64__)
#define BCH_X86 1
#define BCH_NEON 0
#define BCH_PORTABLE 0
#elif !defined(BCH_SCALAR) && defined(__aarch64__)
#define BCH_X86 0
#define BCH_NEON 1
#define BCH_PORTABLE 0
#else
#define BCH_X86 0
#define BCH_NEON 0
#define BCH_PORTABLE 1
#endif

// Rows of a table that the processor has: what is in the parentheses, or nothing.
#if BCH_X86
#define BCH_ON_X86(...) __VA_ARGS__
#else
#define BCH_ON_X86(...)
#endif
#if BCH_NEON
#define BCH_ON_NEON(...) __VA_ARGS__
#else
#define BCH_ON_NEON(...)
#endif
