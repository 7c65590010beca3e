// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "layout/base/mixed_hash.hpp"
#include "layout/import/files.hpp"
#include "layout/import/json.hpp"

// Private to the importer: a glTF 2 file's JSON, its buffers, and the numbers in them.

namespace bch::detail::importing {

constexpr std::size_t largest_index = 0xfffffffe;
constexpr std::size_t largest_offset = largest_file;
/// The most numbers that all accessors of a file may hold together. Accessors may share bytes or have none, so that
/// the size of the file does not bound them.
constexpr std::size_t max_values = std::size_t{1} << 28;

/// Returns whether a file is glTF, judged by its beginning or its extension.
bool is_gltf(const std::filesystem::path& file);

/// Holds the bytes of an element's first component and the stride to the next element.
struct Elements {
  const char* bytes = nullptr;
  std::size_t stride = 0;
};

/// Returns the number of components of an accessor's element of that type, such as "VEC3".
std::size_t components_of(std::string_view type);

struct Decoder;

/// Holds the JSON of a .gltf or .glb file and the buffers that it names, which are read when they are needed.
/// Errors:  all functions throw ImportError, which names the place in the JSON.
class GltfFile {
 public:
  /// Opens a glTF file.
  /// Errors:  throws ImportError on what is no glTF 2, and on extensions that the file requires and that are not read.
  explicit GltfFile(const std::filesystem::path& file);
  ~GltfFile();
  GltfFile(const GltfFile&) = delete;
  GltfFile& operator=(const GltfFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  JsonValue root() const { return {path_, *json_}; }
  /// Returns the names of the extensions that the file uses without requiring them, and that are not read.
  std::vector<std::string> unread_extensions() const;
  /// Returns the element of a top-level array, such as "accessors", whose index stands at `index`.
  JsonValue named_by(const JsonValue& index, const char* array) const;

  /// Returns the bytes of a buffer view.
  std::string_view bytes_of(const JsonValue& view);

  /// Returns the numbers of an accessor, element by element: of any component type, integers normalised where it says so,
  /// sparse or not. `type` is what the accessor has to be, such as "VEC3".
  std::vector<float> floats(const JsonValue& accessor, const char* type);
  /// Returns the unsigned integers of an accessor, element by element.
  std::vector<std::uint32_t> indices(const JsonValue& accessor, const char* type);

 private:
  std::filesystem::path path_;
  FileAndSiblings files_;
  std::string bytes_;
  std::string_view binary_chunk_;
  std::unique_ptr<nlohmann::json> json_;
  std::unordered_map<std::size_t, std::string, MixedHash> buffers_;
  std::size_t values_left_;

  std::string_view split_binary();
  void check_version_and_extensions() const;
  std::string_view buffer(const JsonValue& buffer_json, std::size_t index);
  Elements elements(const JsonValue& place, std::size_t count, std::size_t element_bytes, bool strided);
  template <class Number>
  std::vector<Number> read(const JsonValue& accessor, const char* type);
  template <class Number>
  void replace_sparse(const JsonValue& accessor, const Decoder& decoder, std::vector<Number>& numbers);
};

}  // namespace bch::detail::importing
