// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <functional>

namespace bch::test {

/// Calls the work so that its queries have that many threads, more than the processor has, too, where TBB has them.
void on_threads(std::uint32_t threads, const std::function<void()>& work);

}  // namespace bch::test
