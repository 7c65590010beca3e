// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <vector>

namespace bch::detail {

/// Resizes a vector, where it has to grow with room for a sixteenth more: a rank has a few agents and pairs more in one step than in
/// another, and a vector that grew to twice its size for them would stay so.
template <class Value>
void resize_with_spare(std::vector<Value>& values, std::size_t size) {
  if (size > values.capacity()) values.reserve(size + size / 16);
  values.resize(size);
}

}  // namespace bch::detail
