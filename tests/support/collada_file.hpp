// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/quoted.hpp"

// Parts of Collada files, and files of them.

namespace bch::test {

/// Returns the text with each of some words replaced: "$id" by an id, say.
inline std::string filled(std::string text, const std::vector<std::pair<std::string, std::string>>& words) {
  for (const auto& [word, value] : words)
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += value.size())
      text.replace(at, word.size(), value);
  return text;
}

inline std::string collada_param(const std::string& name, const std::string& type = "float") {
  return quoted("<param name='" + name + "' type='" + type + "'/>");
}

inline const std::string xyz_params = collada_param("X") + collada_param("Y") + collada_param("Z");

/// Returns a source of so many elements, each of `stride` numbers or names.
inline std::string collada_source(const std::string& id, const std::string& kind, const std::string& numbers,
                                  int count, int stride, const std::string& params) {
  return quoted(
      filled("<source id='$id'><$kind_array id='$id-a' count='$all'>$numbers</$kind_array><technique_common>"
             "<accessor source='#$id-a' count='$count' stride='$stride'>$params</accessor>"
             "</technique_common></source>",
             {{"$id", id},
              {"$kind", kind},
              {"$all", std::to_string(count * stride)},
              {"$numbers", numbers},
              {"$count", std::to_string(count)},
              {"$stride", std::to_string(stride)},
              {"$params", params}}));
}

/// The input of faces by vertices of a geometry.
inline std::string collada_input(const std::string& geometry) {
  return quoted("<input semantic='VERTEX' source='#" + geometry + "v' offset='0'/>");
}

/// Returns a mesh of so many vertices; without faces of its own it is a tetrahedron.
inline std::string collada_geometry(const std::string& id,
                                    const std::string& positions = "0 0 0 1 0 0 0 1 0 0 0 1", int count = 4,
                                    const std::string& faces = "") {
  const std::string four =
      "<triangles count='4'>" + collada_input(id) + "<p>0 2 1 0 1 3 1 2 3 2 0 3</p></triangles>";
  return quoted("<geometry id='" + id + "'><mesh>" +
                collada_source(id + "p", "float", positions, count, 3, xyz_params) + "<vertices id='" + id +
                "v'><input semantic='POSITION' source='#" + id + "p'/></vertices>" +
                (faces.empty() ? four : faces) + "</mesh></geometry>");
}

/// Returns a file of libraries and of the nodes of its scene. The unit is given in metres.
inline std::string collada_file(const std::string& libraries, const std::string& nodes,
                                const std::string& unit = "1") {
  return quoted(
      "<?xml version='1.0' encoding='utf-8'?>\n<!-- a > b --><COLLADA "
      "xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>\n<asset><unit name='u' meter='" +
      unit + "'/><up_axis>Z_UP</up_axis></asset>" + libraries +
      "<library_visual_scenes><visual_scene id='S'>" + nodes +
      "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#S'/></scene></COLLADA>");
}

/// Returns a file of one geometry.
inline std::string collada_file_of(const std::string& geometry, const std::string& unit = "1") {
  return collada_file("<library_geometries>" + geometry + "</library_geometries>",
                      "<node id='n'><instance_geometry url='#g'/></node>", unit);
}

}  // namespace bch::test
