// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

// The standard library, as far as most tests need it, and what they test.

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
#include <optional>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#if __has_include(<bch/bch.hpp>)
#include <bch/bch.hpp>
#else  // a program that links shapes alone
#include <bch/agents.hpp>
#include <bch/shapes.hpp>
#endif
