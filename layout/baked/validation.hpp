// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "layout/baked/format.hpp"

namespace bch::detail::baked {

/// Says what is wrong at a place of a section.
/// Errors:  throws std::invalid_argument.
[[noreturn]] void reject(const char* section, std::size_t place, const std::string& what);

/// Checks the content of all sections: validate(ShapeArrays), and that every shape's origin has its names.
/// `before_nodes`: as there.
/// Errors:  throws std::invalid_argument naming the section, the place in it and the value.
void validate(const Arrays& arrays, const std::function<void(std::size_t)>& before_nodes = {});

}  // namespace bch::detail::baked
