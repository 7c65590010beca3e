// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/files.hpp"

#include <assimp/BaseImporter.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/importerdesc.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string_view>
#include <system_error>

namespace bch::detail::importing {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view supported[] = {
    "Autodesk FBX Importer",
    "Collada Importer",
    "Doom 3 / MD5 Mesh Importer",
    "Inter-Quake Model Importer",
    "BVH Importer (MoCap)",
    "Wavefront Object Importer",
    "Stereolithography (STL) Importer",
};

bool is_supported(const Assimp::Importer& importer, std::size_t index) {
  const aiImporterDesc* const description = importer.GetImporterInfo(index);
  return description != nullptr && std::find(std::begin(supported), std::end(supported),
                                             std::string_view(description->mName)) != std::end(supported);
}

/// Returns whether a stream is UTF-8 text behind a byte order mark, which the readers of OBJ and others take
/// for a part of the first line. A stream with a zero where a binary STL file has its counts is no text.
/// Leaves the stream at its beginning.
bool begins_with_mark(Assimp::IOStream& stream) {
  char start[84];
  const std::string_view text(start, stream.Read(start, 1, sizeof start));
  stream.Seek(0, aiOrigin_SET);
  return text.starts_with(byte_order_mark) && text.find('\0') == std::string_view::npos;
}

std::string rest_of(Assimp::IOStream& stream) {
  std::string bytes(stream.FileSize() - stream.Tell(), '\0');
  bytes.resize(stream.Read(bytes.data(), 1, bytes.size()));
  return bytes;
}

Assimp::IOStream* stream_of(const std::string& bytes) {
  std::unique_ptr<std::uint8_t[]> copy(new std::uint8_t[bytes.size()]);
  std::copy(bytes.begin(), bytes.end(), copy.get());
  return new Assimp::MemoryIOStream(copy.release(), bytes.size(), true);
}

}  // namespace

FileAndSiblings::FileAndSiblings(const fs::path& file)
    : file_(fs::canonical(file)), folder_(fs::canonical(fs::absolute(file).parent_path())) {}

bool FileAndSiblings::allows(const char* path) const {
  std::error_code error;
  const fs::path target = fs::canonical(path, error);
  if (error || (target != file_ && target.parent_path() != folder_)) return false;
  return fs::is_regular_file(target, error) && fs::file_size(target, error) <= largest_file && !error;
}

bool FileAndSiblings::Exists(const char* path) const {
  return path != nullptr && allows(path) && DefaultIOSystem::Exists(path);
}

Assimp::IOStream* FileAndSiblings::Open(const char* path, const char* mode) {
  const bool reads = mode != nullptr && mode[0] == 'r' && std::strchr(mode, '+') == nullptr;
  if (!reads || path == nullptr || !allows(path)) return nullptr;
  if (text_ && fs::canonical(path) == file_) return stream_of(*text_);
  std::unique_ptr<Assimp::IOStream> stream(DefaultIOSystem::Open(path, mode));
  if (stream == nullptr || !begins_with_mark(*stream)) return stream.release();
  stream->Seek(byte_order_mark.size(), aiOrigin_SET);
  return stream_of(rest_of(*stream));
}

std::string FileAndSiblings::read(const fs::path& path) {
  const std::unique_ptr<Assimp::IOStream> stream(Open(path.string().c_str(), "rb"));
  return stream == nullptr ? "" : rest_of(*stream);
}

void keep_supported_formats(Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    if (is_supported(importer, i)) continue;
    const std::unique_ptr<Assimp::BaseImporter> reader(importer.GetImporter(i));
    importer.UnregisterLoader(reader.get());
  }
}

}  // namespace bch::detail::importing
