// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <bch/bodies.hpp>
#include <bch/poses.hpp>

#include "bench/base/command_line.hpp"
#include "bench/characters/characters.hpp"

namespace bch::cli {

/// Holds the options that choose what bodies are.
struct BodyKind {
  std::string bodies = "outlines";  ///< or "spheres"
  std::uint32_t spheres = 256;      ///< of a body

  void add_to(CLI::App& command);
  /// Errors:  throws UsageError on --spheres together with outlines.
  bool are_spheres(const CLI::App& command) const;
};

/// Adds the option --spheres, how many each body has.
void add_spheres_option(CLI::App& command, std::uint32_t& spheres);

/// Poses a body a source, of the models of its character.
BodySet posed_bodies(std::span<const BodyModel> models, std::span<const PoseId> sources);

/// Makes models of bodies of so many spheres, one a character, with a progress bar. Those that come with the library are taken from it,
/// and others are drafts unless they are to be kept.
/// Errors:  throws InputError naming the character that make_body() refuses.
std::vector<BodyModel> make_models(std::span<const LoadedCharacter> characters, std::uint32_t spheres,
                                   bool draft = true);

}  // namespace bch::cli
