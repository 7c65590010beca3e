// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include <bch/bodies.hpp>
#include <bch/files.hpp>

#include "bench/base/options.hpp"

namespace bch::cli {

/// Loads a file that a user named.
/// Errors:  throws BakedFileError; InputError where memory does not suffice.
BakedShapes open_baked(const std::string& file);

/// Loads a file that has to answer in a certain way.
/// Errors:  throws InputError as well where the file has no shapes, or exact leaves are asked for of a set without them.
BakedShapes load_baked_for(const std::string& file, const AnswerOptions& answer);

/// Returns the models of bodies of a baked file.
/// Errors:  throws InputError naming the model that body_model() refuses.
std::vector<BodyModel> models_of(const std::string& file, const BakedShapes& baked);

/// Describes a baked file for people.
/// Errors:  as models_of() throws, here and below.
std::string text_of(const std::string& file, const BakedShapes& baked);
/// Describes what verify() checked, after it found no error.
std::string verified_text(const ShapeSet& set);
/// Lists the shapes of a baked file, one a line.
std::string table_text(const BakedShapes& baked);
/// Describes a baked file and its shapes as JSON.
nlohmann::ordered_json json_of(const std::string& file, const BakedShapes& baked);

/// Returns the name of a clip of a baked file; empty where it has none.
std::string clip_name(const ShapeOrigins& origins, const BakedClip& clip);

}  // namespace bch::cli
