// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "layout/import/gltf_file.hpp"

namespace draco {
class Mesh;
}

// Private to the importer: meshes that KHR_draco_mesh_compression compresses. The only user of Draco.

namespace bch::detail::importing {

class DracoMesh {
 public:
  /// Decodes a mesh. `extension` is the primitive's KHR_draco_mesh_compression.
  /// Errors:  throws ImportError on bytes that are no mesh.
  DracoMesh(GltfFile& file, const JsonValue& extension);
  ~DracoMesh();

  /// Returns the three corners of every triangle.
  std::vector<std::uint32_t> corners() const;

  /// Returns the numbers of an attribute, vertex by vertex; integers are normalised where the accessor says so.
  /// Errors:  throws ImportError if there is no such attribute, or its values are no such numbers.
  template <class Number>
  std::vector<Number> attribute(const char* name, std::size_t components, bool normalised) const;

 private:
  JsonValue attributes_;
  std::unique_ptr<draco::Mesh> mesh_;
};

extern template std::vector<float> DracoMesh::attribute(const char*, std::size_t, bool) const;
extern template std::vector<std::uint32_t> DracoMesh::attribute(const char*, std::size_t, bool) const;

}  // namespace bch::detail::importing
