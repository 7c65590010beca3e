// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/gltf_draco.hpp"

#include <draco/compression/decode.h>

namespace bch::detail::importing {
namespace {

std::unique_ptr<draco::Mesh> decode(GltfFile& file, const JsonValue& extension) {
  const std::string_view bytes = file.bytes_of(file.named_by(extension["bufferView"], "bufferViews"));
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
  if (!mesh.ok()) extension.reject("is no Draco mesh: " + mesh.status().error_msg_string());
  return std::move(mesh).value();
}

}  // namespace

DracoMesh::DracoMesh(GltfFile& file, const JsonValue& extension)
    : attributes_(extension["attributes"]), mesh_(decode(file, extension)) {}

DracoMesh::~DracoMesh() = default;

std::vector<std::uint32_t> DracoMesh::corners() const {
  std::vector<std::uint32_t> corners;
  corners.reserve(std::size_t{3} * mesh_->num_faces());
  for (draco::FaceIndex f(0); f < mesh_->num_faces(); ++f)
    for (const draco::PointIndex& corner : mesh_->face(f)) corners.push_back(corner.value());
  return corners;
}

template <class Number>
std::vector<Number> DracoMesh::attribute(const char* name, std::size_t components, bool normalised) const {
  constexpr std::size_t largest_id = 0xffffffff;
  const JsonValue id = attributes_[name];
  const int index = mesh_->GetAttributeIdByUniqueId(static_cast<std::uint32_t>(id.integer(largest_id)));
  if (index < 0) id.reject("is no attribute of its Draco mesh");
  draco::PointAttribute& attribute = *mesh_->attribute(index);
  attribute.set_normalized(normalised);
  std::vector<Number> numbers(mesh_->num_points() * components);
  for (draco::PointIndex point(0); point < mesh_->num_points(); ++point)
    if (!attribute.ConvertValue(attribute.mapped_index(point), static_cast<std::int8_t>(components),
                                &numbers[point.value() * components]))
      id.reject("has values that do not fit");
  return numbers;
}

template std::vector<float> DracoMesh::attribute(const char*, std::size_t, bool) const;
template std::vector<std::uint32_t> DracoMesh::attribute(const char*, std::size_t, bool) const;

}  // namespace bch::detail::importing
