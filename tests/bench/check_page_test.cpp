// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/check_page/check_page.hpp"

#include <gtest/gtest.h>
