// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <bch/bodies.hpp>

namespace bch::detail {

/// Writes a model, without its character, as bytes that are the same everywhere: one array behind the other, whole numbers as differences
/// that take seven bits a byte (LEB128).
std::string bytes_of(const BodyModel& model);

/// Reads a model of a character from bytes that are not trusted. What they say is for validate() to judge; the model takes no more than
/// a small multiple of their memory.
/// Errors:  throws std::invalid_argument on bytes that end too early or too late, and on a number of more than 32 bits.
BodyModel model_from(std::string_view bytes, std::shared_ptr<const Character> character);

}  // namespace bch::detail
