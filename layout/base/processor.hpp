// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

// The processor for which the code is compiled: exactly one of these is 1. BCH_SCALAR (from CMake's BCH_ISA) selects
// code that every processor runs.
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

// Entries of a table for this processor only: the argument, or nothing.
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
