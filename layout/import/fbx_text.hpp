// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string_view>
#include <vector>

#include "layout/import/fbx_record.hpp"

// Private to the importer: the records of an FBX file in text.

namespace bch::detail::importing {

/// How deep records may nest; those of real files do about 8 levels.
constexpr int deepest_fbx_record = 64;

/// Returns a number of a file as a whole one, towards zero and as near as an int64 comes.
std::int64_t whole_part(double number);

/// Errors:  throws ImportError on records that do not end within the file or nest too deeply.
std::vector<FbxRecord> read_fbx_text(const FbxFile& file, std::string_view bytes);

/// Returns the numbers of an array as it stands in the text, "a: NUMBER,NUMBER". What is no number becomes NaN.
std::vector<double> numbers_in_text(std::string_view text);

}  // namespace bch::detail::importing
