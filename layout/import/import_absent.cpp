// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/import.hpp>

namespace bch {

ImportedCharacter import_character(const std::filesystem::path& file, const ImportOptions&) {
  throw ImportError(file.string() +
                    ": files of characters are read by assimp and Draco, without which this was built");
}

ImportedCharacter import_in_child(const std::filesystem::path& file, const ImportOptions& options,
                                  const ImportLimits&) {
  return import_character(file, options);
}

}  // namespace bch
