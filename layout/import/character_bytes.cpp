// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/character_bytes.hpp"

#include "layout/character/character_archive.hpp"

namespace bch::detail {
namespace {

template <class Archive>
void pass(Archive& archive, ImportedCharacter& imported) {
  CharacterFields fields(archive);
  ImportReport& r = imported.report;
  std::uint64_t clips = r.clips.size();
  fields.all(imported.character, r.format, r.meshes, r.vertices, r.triangles, r.dropped_faces,
             r.dropped_vertices, r.bones, r.height, r.notes, clips);
  for (std::uint64_t i = 0; i < clips; ++i) {
    auto& [name, seconds, channels, channels_in_file] = archive.element(r.clips, i);
    fields.all(name, seconds, channels, channels_in_file);
  }
}

}  // namespace

std::string to_bytes(ImportedCharacter imported) {
  ByteWriter writer;
  pass(writer, imported);
  return writer.take();
}

ImportedCharacter imported_from(std::span<const char> bytes) {
  ByteReader reader(bytes);
  ImportedCharacter imported;
  pass(reader, imported);
  reader.end();
  validate(imported.character);
  return imported;
}

}  // namespace bch::detail
