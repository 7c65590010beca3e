// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/gltf_file.hpp"

#include "layout/base/base64.hpp"
#include "tests/support/quoted.hpp"

namespace bch {

using test::quoted;

namespace {

std::string join(const std::vector<std::string>& parts) {
  std::string all;
  for (const std::string& part : parts) all += (all.empty() ? "" : ",") + part;
  return all;
}

std::string little_endian(std::size_t number) {
  std::string bytes;
  for (int b = 0; b < 4; ++b) bytes += static_cast<char>(number >> (8 * b) & 0xff);
  return bytes;
}

}  // namespace

std::string GltfFile::add_view(const void* data, std::size_t bytes) {
  views_.push_back(quoted("{'buffer':0,'byteOffset':" + std::to_string(buffer_.size()) +
                          ",'byteLength':" + std::to_string(bytes) + "}"));
  buffer_.append(static_cast<const char*>(data), bytes);
  buffer_.resize((buffer_.size() + 3) / 4 * 4);
  return std::to_string(views_.size() - 1);
}

std::string GltfFile::add_accessor(const std::string& json) {
  accessors_.push_back(json);
  return std::to_string(accessors_.size() - 1);
}

std::string GltfFile::add(const void* data, std::size_t bytes, std::size_t values, int component,
                          const std::string& type, bool normalised) {
  const std::size_t elements = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : type == "VEC4" ? 4 : 3;
  return add_accessor(quoted("{'bufferView':" + add_view(data, bytes) +
                             (normalised ? ",'normalized':true" : "") +
                             ",'componentType':" + std::to_string(component) +
                             ",'count':" + std::to_string(values / elements) + ",'type':'" + type + "'}"));
}

std::string GltfFile::json(const std::string& uri) const {
  return quoted("{'asset':{'version':'2.0'},'buffers':[{" + uri +
                "'byteLength':" + std::to_string(buffer_.size()) + "}],'bufferViews':[" + join(views_) +
                "],'accessors':[" + join(accessors_) + "]," + join(members_) + "}");
}

std::string GltfFile::text() const {
  return json("'uri':'data:application/octet-stream;base64," + detail::to_base64(buffer_) + "',");
}

std::string GltfFile::text(const std::string& buffer_uri) const {
  return json("'uri':'" + buffer_uri + "',");
}

std::string GltfFile::binary() const {
  std::string text = json("");
  text.resize((text.size() + 3) / 4 * 4, ' ');
  return "glTF" + little_endian(2) + little_endian(28 + text.size() + buffer_.size()) +
         little_endian(text.size()) + "JSON" + text + little_endian(buffer_.size()) +
         std::string("BIN\0", 4) + buffer_;
}

GltfFile SkinnedStrip::file() const {
  GltfFile gltf;
  std::string attributes = "'POSITION':" + gltf.add(positions, "VEC3");
  if (!joints.empty())
    attributes += ",'JOINTS_0':" + gltf.add(joints, "VEC4") + ",'WEIGHTS_0':" + gltf.add(weights, "VEC4");
  gltf.add_json("'meshes':[{'name':'strip','primitives':[{'mode':" + std::to_string(mode) +
                ",'attributes':{" + attributes + "},'indices':" + gltf.add(indices, "SCALAR") + "}]}]");
  gltf.add_json("'skins':[{'joints':[1,2],'inverseBindMatrices':" + gltf.add(inverse_binds, "MAT4") + "}]");
  gltf.add_json("'nodes':[{'name':'body','mesh':0,'skin':0},{" + hips_turn + "'name':'" + hips +
                "','children':[2],'translation':[0,1,0]},{'name':'" + head + "'," + head_place +
                "},{'name':'camera','translation':[9,9,9]},{" + armature +
                "'name':'armature','children':[1]}]");
  gltf.add_json("'scenes':[{'nodes':[0,4,3]}],'scene':0");
  const std::string input = "{" + interpolation + "'input':" + gltf.add(times, "SCALAR") + ",'output':";
  std::string samplers = input + gltf.add(way, "VEC3") + "}," + input + gltf.add(turns, "VEC4") + "}";
  std::string channels =
      "{'sampler':0,'target':{'node':1,'path':'translation'}},{'sampler':1,'target':{'node':2,'path':'"
      "rotation'}}";
  if (!sway.empty()) {
    samplers += "," + input + gltf.add(sway, "VEC3") + "}";
    channels += ",{'sampler':2,'target':{'node':4,'path':'translation'}}";
  }
  gltf.add_json("'animations':[{'name':'walk','samplers':[" + samplers + "],'channels':[" + channels + "]}]");
  return gltf;
}

}  // namespace bch
