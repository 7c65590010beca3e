// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/files.hpp>

#include <cstring>
#include <string_view>
#include <type_traits>
#include <utility>

#include "layout/baked/checksum.hpp"
#include "layout/baked/clips.hpp"
#include "layout/baked/file_bytes.hpp"
#include "layout/baked/format.hpp"
#include "layout/baked/validation.hpp"

namespace bch {

using namespace detail;

namespace {

using baked::Preamble;
using baked::SectionEntry;

[[noreturn]] void reject(const std::string& name, const std::string& what) {
  throw BakedFileError(name + ": " + what);
}

void check_header(const Preamble& preamble, std::uint64_t size, const std::string& name) {
  const auto& header = preamble.header;
  if (header.magic != baked::magic) reject(name, "not a baked file: it begins differently");
  if (header.byte_order == baked::other_byte_order)
    reject(name, "was baked on a machine of the other byte order; bake it on this one");
  if (header.byte_order != baked::byte_order)
    reject(name, "header: expected a byte order of this or the other kind, found " +
                     std::to_string(header.byte_order));
  if (header.version != baked::version)
    reject(name, "header: version " + std::to_string(header.version) + ", and only " +
                     std::to_string(baked::version) + " is known; bake it anew");
  if (header.file_size != size)
    reject(name, "header: expected a file of " + std::to_string(header.file_size) + " bytes, found " +
                     std::to_string(size));
  if (header.checksum != baked::checksum(preamble)) reject(name, "header: wrong checksum");
  if (header.section_count != baked::section_count)
    reject(name, "header: expected " + std::to_string(baked::section_count) + " sections, found " +
                     std::to_string(header.section_count));
  for (const std::uint32_t zero : header.zero)
    if (zero != 0) reject(name, "header: expected 0, found " + std::to_string(zero));
}

/// Returns: where the next section begins.
std::uint64_t check_entry(const SectionEntry& entry, std::uint32_t number, std::size_t element_size,
                          std::uint64_t offset, std::uint64_t file_size, const std::string& where) {
  if (entry.section != number)
    reject(where, "expected number " + std::to_string(number) + ", found " + std::to_string(entry.section));
  if (entry.element_size != element_size)
    reject(where, "expected elements of " + std::to_string(element_size) + " bytes, found " +
                      std::to_string(entry.element_size));
  if (entry.offset != offset)
    reject(where,
           "expected a beginning at " + std::to_string(offset) + ", found " + std::to_string(entry.offset));
  const std::uint64_t left = file_size - offset;
  if (entry.count > left / element_size)
    reject(where, std::to_string(entry.count) + " elements do not fit into the file");
  const std::uint64_t bytes = entry.count * element_size, zeros = baked::zeros_after(bytes);
  if (zeros > left - bytes) reject(where, "the file ends before its zeros do");
  return offset + bytes + zeros;
}

/// Reads what stands before the sections of a file of so many bytes, and checks all that it says by itself: that this is
/// a baked file, and that the sections fill it.
Preamble read_preamble(std::span<const std::byte> first, std::uint64_t size, const std::string& name) {
  if (size < baked::sections_offset)
    reject(name, std::to_string(size) + " bytes are too few for a baked file");
  Preamble preamble;
  std::memcpy(&preamble, first.data(), sizeof preamble);
  check_header(preamble, size, name);
  for (const std::byte byte : first.subspan(sizeof preamble, baked::sections_offset - sizeof preamble))
    if (byte != std::byte{0}) reject(name, "header: no zeros after it");
  std::uint64_t offset = baked::sections_offset;
  baked::Arrays arrays{};
  baked::for_each_section(arrays, [&](baked::Section section, const char* what, const auto& span) {
    const auto number = static_cast<std::uint32_t>(section);
    offset = check_entry(preamble.entries[number], number, sizeof(span[0]), offset, size,
                         name + ": section " + what);
  });
  if (offset != size) reject(name, std::to_string(size - offset) + " bytes follow the last section");
  return preamble;
}

/// Reads a file's bytes from the front to the back; every number is checked before it is used.
class Reader {
 public:
  Reader(std::span<const std::byte> bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  baked::Arrays read() {
    if (reinterpret_cast<std::uintptr_t>(bytes_.data()) % baked::alignment != 0)
      reject("does not begin on a cache line of memory");
    preamble_ = read_preamble(bytes_, bytes_.size(), name_);
    baked::Arrays arrays{};
    baked::for_each_section(arrays, [&](baked::Section section, const char* what, auto& span) {
      using Element = std::remove_reference_t<decltype(span[0])>;
      const SectionEntry& entry = preamble_.entries[static_cast<std::uint32_t>(section)];
      check_bytes(section, what, entry);
      span = {reinterpret_cast<Element*>(bytes_.data() + entry.offset),
              static_cast<std::size_t>(entry.count)};
    });
    check_content(arrays);
    return arrays;
  }

 private:
  [[noreturn]] void reject(const std::string& what) const { bch::reject(name_, what); }

  void check_bytes(baked::Section number, const char* name, const SectionEntry& entry) const {
    const std::string where = std::string("section ") + name + ": ";
    // Nodes' checksum is check_content()'s.
    if (number != baked::Section::nodes && entry.checksum != baked::checksum(section(entry)))
      reject(where + "wrong checksum");
    for (const std::byte byte : section(entry).subspan(entry.count * entry.element_size))
      if (byte != std::byte{0}) reject(where + "no zeros after it");
  }

  /// Checks the content and the nodes' checksum in one pass, because nodes are most of a file. Wrong nodes
  /// may come from damage; then the checksum's error is reported.
  void check_content(const baked::Arrays& arrays) const {
    const SectionEntry& nodes = preamble_.entries[static_cast<std::uint32_t>(baked::Section::nodes)];
    baked::SectionChecksum checksum(section(nodes));
    std::string wrong;
    try {
      baked::validate(arrays, [&](std::size_t place) { checksum.max_extent(place * sizeof(float)); });
    } catch (const std::invalid_argument& error) {
      wrong = error.what();
    }
    if (nodes.checksum != checksum.finish()) reject("section nodes: wrong checksum");
    if (!wrong.empty()) reject(wrong);
  }

  /// Returns a section's bytes and the zeros after it.
  std::span<const std::byte> section(const SectionEntry& entry) const {
    const std::uint64_t size = entry.count * entry.element_size;
    return bytes_.subspan(entry.offset, baked::padded(size));
  }

  std::span<const std::byte> bytes_;
  const std::string& name_;
  Preamble preamble_;
};

ShapeOrigins origins_of(const baked::Arrays& arrays) {
  ShapeOrigins origins{arrays.settings[0].threshold, {}, {arrays.origins.begin(), arrays.origins.end()}};
  const std::string_view names(arrays.names.data(), arrays.names.size());
  for (std::size_t i = 0; i + 1 < arrays.name_begin.size(); ++i)
    origins.names.emplace_back(
        names.substr(arrays.name_begin[i], arrays.name_begin[i + 1] - arrays.name_begin[i]));
  return origins;
}

std::vector<BakedBody> bodies_of(const baked::BodyArrays& arrays) {
  std::vector<BakedBody> bodies;
  std::uint64_t begin = 0;
  for (const std::uint64_t end : arrays.ends) {
    const auto bytes = arrays.bytes.subspan(begin, end - begin);
    bodies.emplace_back(bytes.begin(), bytes.end());
    begin = end;
  }
  return bodies;
}

}  // namespace

BakedShapes load_baked(const std::filesystem::path& file, FileAccess access) {
  const std::string name = file.string();
  const HeaderCheck check{baked::sections_offset, [&](std::span<const std::byte> first, std::uint64_t size) {
                            read_preamble(first, size, name);
                          }};
  FileBytes from;
  try {
    from = access == FileAccess::map ? map_file(file, check) : read_file(file, check);
  } catch (const BakedFileError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw BakedFileError(error.what());
  }
  return load_baked(from.bytes, name, std::move(from.memory));
}

BakedShapes load_baked(std::span<const std::byte> bytes, const std::string& name,
                       std::shared_ptr<const void> memory) {
  const baked::Arrays arrays = Reader(bytes, name).read();
  ShapeOrigins origins = origins_of(arrays);
  std::vector<BakedClip> clips;
  try {
    clips = baked::unpack(arrays.clips, origins.names.size());
  } catch (const std::invalid_argument& error) {
    reject(name, error.what());
  }
  return {ShapeSet(arrays.shapes, std::move(memory)), std::move(origins), std::move(clips),
          bodies_of(arrays.bodies)};
}

}  // namespace bch
