// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/gltf_file.hpp"

#include <algorithm>
#include <array>
#include <assimp/IOStream.hpp>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "layout/base/base64.hpp"
#include "layout/import/scene.hpp"

namespace bch::detail::importing {
namespace {

constexpr std::size_t glb_header = 12, chunk_header = 8;

/// Extensions that say nothing about where vertices are, by the beginnings of their names, and those that are read.
constexpr std::string_view known_extensions[] = {"KHR_materials_",
                                                 "KHR_texture_",
                                                 "KHR_lights_",
                                                 "KHR_xmp",
                                                 "KHR_technique",
                                                 "EXT_texture_",
                                                 "EXT_lights_",
                                                 "MSFT_texture_",
                                                 "MSFT_packing_",
                                                 "ADOBE_materials_",
                                                 "MSFT_lod",
                                                 "KHR_mesh_quantization",
                                                 "KHR_draco_mesh_compression"};

bool is_known(const std::string& extension) {
  return std::any_of(std::begin(known_extensions), std::end(known_extensions),
                     [&](std::string_view start) { return extension.starts_with(start); });
}

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t b = 4; b-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[at + b]);
  return number;
}

std::string from_base64(std::string_view text, const JsonValue& place) {
  try {
    return detail::from_base64(text);
  } catch (const std::invalid_argument& error) {
    place.reject(std::string("is ") + error.what());
  }
}

/// "%20" becomes a blank.
std::string without_escapes(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned byte = 0;
    if (uri[i] == '%' && i + 2 < uri.size() && std::sscanf(uri.c_str() + i + 1, "%2x", &byte) == 1) {
      text += static_cast<char>(byte);
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

}  // namespace

bool is_gltf(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (extension == ".gltf" || extension == ".glb") return true;
  char start[4] = {};
  std::ifstream(file, std::ios::binary).read(start, sizeof start);
  return std::string_view(start, sizeof start) == "glTF";
}

GltfFile::GltfFile(const std::filesystem::path& file)
    : path_(file), files_(file), bytes_(files_.read(file)), values_left_(max_values) {
  std::string_view text = bytes_.starts_with("glTF") ? split_binary() : std::string_view(bytes_);
  while (!text.empty() && text.back() == '\0') text.remove_suffix(1);
  try {
    json_ = std::make_unique<nlohmann::json>(nlohmann::json::parse(text));
  } catch (const nlohmann::json::exception& error) {
    const std::string reason = error.what();
    reject(path_, "no glTF: " + reason.substr(reason.find(']') + 1));
  }
  check_version_and_extensions();
}

GltfFile::~GltfFile() = default;

/// Returns: the JSON of a .glb file.
std::string_view GltfFile::split_binary() {
  const std::string_view all = bytes_;
  if (all.size() < glb_header + chunk_header) reject(path_, "binary glTF of " + count(all.size(), "byte"));
  if (little_endian(all, 4) != 2)
    reject(path_, "binary glTF of version " + std::to_string(little_endian(all, 4)) + ", not 2");
  if (little_endian(all, 8) > all.size())
    reject(path_, "binary glTF of " + count(little_endian(all, 8), "byte") + " is cut at " +
                      std::to_string(all.size()));
  std::string_view left = all.substr(0, little_endian(all, 8));
  left.remove_prefix(std::min(left.size(), glb_header));
  std::string_view json;
  for (std::size_t chunk = 0; left.size() >= chunk_header && chunk < 2; ++chunk) {
    const std::size_t size = little_endian(left, 0);
    const std::string_view type = left.substr(4, 4);
    if (size > left.size() - chunk_header) reject(path_, "chunk " + std::to_string(chunk) + " is cut");
    if (chunk == 0 && type == "JSON") json = left.substr(chunk_header, size);
    if (chunk == 1 && type == std::string_view("BIN\0", 4)) binary_chunk_ = left.substr(chunk_header, size);
    left.remove_prefix(chunk_header + size);
  }
  return json;
}

void GltfFile::check_version_and_extensions() const {
  const JsonValue version = root()["asset"]["version"];
  if (!version.text().starts_with("2.")) version.reject("is '" + version.text() + "', not 2.x");
  const JsonValue required = root()["extensionsRequired"];
  for (std::size_t e = 0; e < required.size(); ++e) {
    const std::string name = required[e].text();
    if (!is_known(name)) reject(path_, "requires the glTF extension '" + name + "', which is not read");
  }
}

std::vector<std::string> GltfFile::unread_extensions() const {
  const JsonValue used = root()["extensionsUsed"];
  std::vector<std::string> names;
  for (std::size_t e = 0; e < used.size(); ++e)
    if (!is_known(used[e].text())) names.push_back(used[e].text());
  return names;
}

JsonValue GltfFile::named_by(const JsonValue& index, const char* array) const {
  const std::size_t number = index.integer(largest_index);
  const JsonValue list = root()[array];
  if (number >= list.size())
    index.reject("is " + std::to_string(number) + " of " + count(list.size(), "element") + " of " + array);
  return list[number];
}

std::string_view GltfFile::buffer(const JsonValue& json, std::size_t index) {
  const std::size_t size = json["byteLength"].integer(largest_offset);
  const std::string uri = json["uri"].text();
  std::string_view bytes = binary_chunk_;
  if (!uri.empty()) {
    const auto [place, added] = buffers_.try_emplace(index);
    if (added && uri.starts_with("data:")) {
      const std::size_t comma = uri.find(";base64,");
      if (comma == std::string::npos) json["uri"].reject("is data that is not in base64");
      place->second = from_base64(std::string_view(uri).substr(comma + 8), json["uri"]);
    } else if (added) {
      place->second = files_.read(path_.parent_path() / without_escapes(uri));
      if (place->second.empty())
        json["uri"].reject("is '" + uri + "', which is no file in this folder, is empty, or cannot be read");
    }
    bytes = place->second;
  } else if (index != 0 || binary_chunk_.data() == nullptr) {
    json.reject("has no data");
  }
  if (bytes.size() < size)
    json.reject("holds " + count(bytes.size(), "byte") + ", not " + std::to_string(size));
  return bytes.substr(0, size);
}

std::string_view GltfFile::bytes_of(const JsonValue& view) {
  const std::size_t index = view["buffer"].integer(largest_index);
  const std::string_view bytes = buffer(named_by(view["buffer"], "buffers"), index);
  const std::size_t offset = view["byteOffset"].integer(largest_offset, 0);
  const std::size_t size = view["byteLength"].integer(largest_offset);
  if (offset > bytes.size() || size > bytes.size() - offset)
    view.reject("reaches beyond the " + count(bytes.size(), "byte") + " of its buffer");
  return bytes.substr(offset, size);
}

}  // namespace bch::detail::importing
