// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <functional>
#include <string>

#include <bch/import.hpp>

namespace bch::detail {

/// Reports a file that the child process could not read to its end, or of which it handed over what is no character.
class ImportStopped : public ImportError {
 public:
  using ImportError::ImportError;
};

/// Imports a character as import_in_child() does, where the child calls `read` to read the file.
ImportedCharacter guarded_import(const std::string& file, const std::function<ImportedCharacter()>& read,
                                 const ImportLimits& limits = {});

}  // namespace bch::detail
