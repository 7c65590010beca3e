// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

// What most tests need, beside what they test.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <bch/bch.hpp>

#include "tests/support/complaint.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/temporary_folder.hpp"
