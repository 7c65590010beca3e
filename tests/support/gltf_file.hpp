// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/standard.hpp"

namespace bch {

/// A glTF 2 file put together by hand, so that it can be wrong in any way a test wants.
class GltfFile {
 public:
  /// Adds an accessor of numbers; `type` is "SCALAR", "VEC3", "MAT4" ...
  /// Returns: its index as text, to stand in the JSON.
  template <class Number>
  std::string add(const std::vector<Number>& values, const std::string& type, bool normalised = false) {
    constexpr int component = std::is_same_v<Number, float>           ? 5126
                              : std::is_same_v<Number, std::uint16_t> ? 5123
                              : std::is_same_v<Number, std::int16_t>  ? 5122
                                                                      : 5121;
    static_assert(component != 5121 || sizeof(Number) == 1);
    return add(values.data(), values.size() * sizeof(Number), values.size(), component, type, normalised);
  }

  /// Adds an accessor by its JSON.
  std::string add_accessor(const std::string& json);
  /// Adds a buffer view alone. Returns: its index.
  std::string add_view(const void* data, std::size_t bytes);

  /// Adds members of the top-level object, such as "'nodes':[{}]"; single quotes become double ones.
  void add_json(const std::string& members) { members_.push_back(members); }

  std::string text() const;                               ///< .gltf with the buffer inside
  std::string binary() const;                             ///< .glb
  std::string text(const std::string& buffer_uri) const;  ///< .gltf with the buffer in another file
  const std::string& buffer() const { return buffer_; }

 private:
  std::string buffer_;
  std::vector<std::string> views_, accessors_, members_;

  std::string add(const void* data, std::size_t bytes, std::size_t values, int component,
                  const std::string& type, bool normalised);
  std::string json(const std::string& uri) const;
};

/// A strip of two triangles, `height` tall along y, on two joints: "hips" (1 m up) and "head" (0.5 m above)
/// with one clip "walk" of 2 s that takes the hips 3 m along x and turns the head by 90 degrees about y.
/// Change what a test needs before text().
struct SkinnedStrip {
  std::vector<float> positions = {0, 0, 0, 0.5f, 0, 0, 0, 1.8f, 0, 0.5f, 1.8f, 0};
  std::vector<std::uint16_t> indices = {0, 1, 3, 0, 3, 2};
  std::vector<std::uint16_t> joints = {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
  std::vector<float> weights = {1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
  std::vector<float> inverse_binds = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1,    0, 1,  //
                                      1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1.5f, 0, 1};
  std::vector<float> times = {0, 1, 2};
  std::vector<float> way = {0, 1, 0, 1, 1, 0, 3, 1, 0};
  std::vector<float> turns = {0, 0, 0, 1, 0, 0.38268343f, 0, 0.92387953f, 0, 0.70710678f, 0, 0.70710678f};
  std::vector<float> sway;  ///< positions of the node above the hips, as many as times
  std::string hips = "hips";
  std::string head = "head";
  std::string armature;   ///< members of the node above the hips, such as "'scale':[1,1,1],"
  std::string hips_turn;  ///< members of the hips, such as "'rotation':[0,0,0,1],"
  std::string head_place = "'translation':[0,0.5,0]";
  int mode = 4;               ///< of the primitive: triangles
  std::string interpolation;  ///< member of all samplers, such as "'interpolation':'STEP',"

  GltfFile file() const;
  std::string text() const { return file().text(); }
};

}  // namespace bch
