// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/character_shapes.hpp"

namespace bch::test {

inline std::vector<Character> default_characters() {
  return {default_male(), default_female()};
}

/// Returns three people of about 2 850 triangles from the folder that test_data() names.
inline std::vector<Character> real_characters(const std::filesystem::path& data) {
  return {import_character(data / "characters" / "rocketbox_male_2847_cmu.glb").character,
          import_character(data / "characters" / "rocketbox_female_2841_cmu.glb").character,
          import_character(data / "characters" / "generic_man_cmu.glb").character};
}

/// Returns the built-in people, and the real ones where there are any.
inline std::vector<Character> people() {
  std::vector<Character> all = default_characters();
  if (const auto data = test_data())
    for (const Character& character : real_characters(*data)) all.push_back(character);
  return all;
}

}  // namespace bch::test
