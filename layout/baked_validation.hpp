// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/baked_format.hpp"

namespace bch::baked {

/// Checks the content of all sections: validate(ShapeArrays), and that every shape's origin has its names.
/// Errors:  throws std::invalid_argument naming the section, the place in it and the value.
void validate(const Arrays& arrays);

}  // namespace bch::baked
