// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

// What most tests need, beside what they test.

#include <gtest/gtest.h>

#include "tests/support/complaint.hpp"
#include "tests/support/implementations.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/standard.hpp"
#include "tests/support/temporary_folder.hpp"
