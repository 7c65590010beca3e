// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <assimp/DefaultIOSystem.h>

#include <assimp/Importer.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

// Private to the importer: what assimp may open, and with which readers.

namespace bch::detail::importing {

/// The bytes of the largest file that is opened.
constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 30;

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// Lets assimp read the given file and those that lie beside it, in the same folder: a buffer, a clip of the
/// same name. Links that lead elsewhere, folders, pipes, devices and files beyond largest_file are not there
/// for it, and it writes nothing. Text is given without a byte order mark of UTF-8.
class FileAndSiblings : public Assimp::DefaultIOSystem {
 public:
  explicit FileAndSiblings(const std::filesystem::path& file);

  bool Exists(const char* path) const override;
  Assimp::IOStream* Open(const char* path, const char* mode) override;
  /// Returns all bytes of a file, as Open() gives them; none if it is not there.
  std::string read(const std::filesystem::path& path);
  /// Sets what is read in place of the given file.
  void replace_text(std::string text) { text_ = std::move(text); }

  bool ChangeDirectory(const std::string&) override { return false; }
  bool CreateDirectory(const std::string&) override { return false; }
  bool DeleteFile(const std::string&) override { return false; }

 private:
  std::filesystem::path file_, folder_;  ///< with links resolved
  std::optional<std::string> text_;

  bool allows(const char* path) const;
};

/// Leaves the readers of the formats that import.hpp names. The dozens of others that assimp brings are further
/// ways in for a malformed file, which need not bear the name of its format.
void keep_supported_formats(Assimp::Importer& importer);

}  // namespace bch::detail::importing
