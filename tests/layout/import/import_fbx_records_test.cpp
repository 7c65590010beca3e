// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <zlib.h>

#include "layout/base/random.hpp"
#include "layout/import/fbx_document.hpp"
#include "tests/support/fbx_text.hpp"
#include "tests/support/import_test.hpp"
#include "tests/support/test.hpp"

// Records of FBX files, binary and text, sound and damaged.

namespace bch {
namespace {

using detail::importing::FbxFile;
using detail::importing::FbxRecord;
using detail::importing::FbxValue;

template <class Number>
std::string bytes_of(Number number) {
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

/// Returns a number as one of a type of FBX's.
std::string number_as(char type, double number) {
  switch (type | 0x20) {
    case 'l':
      return bytes_of(static_cast<std::int64_t>(number));
    case 'i':
      return bytes_of(static_cast<std::int32_t>(number));
    default:
      return bytes_of(number);
  }
}

/// Returns the type that a binary file has for a number.
char type_of(const FbxRecord& record) {
  if (record.name == "C" || record.values.size() == 3) return 'L';  // ids
  if (record.name != "P") return 'I';
  const std::string_view kind = record.text(1);
  return kind == "KTime" ? 'L' : kind == "enum" || kind == "int" ? 'I' : 'D';
}

std::string packed_array(const FbxFile& file, const FbxRecord& record) {
  FbxRecord holder;
  holder.children = {record};
  const bool whole =
      record.name.ends_with("Index") || record.name == "Indexes" || record.name.starts_with("KeyAttr");
  const char type = record.name == "KeyTime" ? 'l' : whole ? 'i' : 'd';
  std::string plain;
  const std::vector<double> numbers = file.numbers(holder, record.name);
  for (const double number : numbers) plain += number_as(type, number);
  std::string packed(compressBound(plain.size()), '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(plain.data()),
           plain.size());
  // Floats have the bits of the whole numbers in the text.
  const char stated = record.name == "KeyAttrDataFloat" ? 'f' : type;
  return stated + bytes_of(static_cast<std::uint32_t>(numbers.size())) + bytes_of(std::uint32_t{1}) +
         bytes_of(static_cast<std::uint32_t>(size)) + packed.substr(0, size);
}

std::string text_value(std::string text) {
  if (const std::size_t end = text.find("::"); end != text.npos)
    text = text.substr(end + 2) + std::string("\0\1", 2) + text.substr(0, end);
  return "S" + bytes_of(static_cast<std::uint32_t>(text.size())) + text;
}

/// Writes a record as in a binary file, where it begins so many bytes behind the start.
std::string binary(const FbxFile& file, const FbxRecord& record, std::size_t begin) {
  std::string values;
  for (const FbxValue& value : record.values)
    values += value.type == 't'   ? packed_array(file, record)
              : value.type == 'n' ? type_of(record) + number_as(type_of(record), value.number)
                                  : text_value(std::string(value.bytes));
  const std::size_t head = 13 + record.name.size() + values.size();
  std::string below;
  for (const FbxRecord& child : record.children) below += binary(file, child, begin + head + below.size());
  if (!record.children.empty()) below += std::string(13, '\0');
  const auto word = [](std::size_t number) { return bytes_of(static_cast<std::uint32_t>(number)); };
  return word(begin + head + below.size()) + word(record.values.size()) + word(values.size()) +
         static_cast<char>(record.name.size()) + std::string(record.name) + values + below;
}

std::string binary(const FbxFile& file) {
  std::string bytes("Kaydara FBX Binary  \0\x1a\0", 23);
  bytes += std::string("\xe8\x1c\0\0", 4);  // version 7400
  for (const FbxRecord& record : file.root().children) bytes += binary(file, record, bytes.size());
  return bytes + std::string(13 + 160, '\0');
}

FbxText moving_man() {
  FbxText fbx = man();
  move_spine(fbx);
  fbx.curves[0].flags = 0x408;
  fbx.curves[0].slope = 90;
  fbx.nodes[2].vectors["PostRotation"] = {30, -50, 90};
  fbx.nodes[3].vectors["GeometricRotation"] = {30, -50, 90};
  return fbx;
}

TEST(FbxRecords, ABinaryFileIsReadAsItsText) {
  TemporaryFolder folder;
  const std::filesystem::path path = folder.write("man.fbx", moving_man().text());
  const Character text = import_character(path).character;
  const Character read_again = import_character(folder.write("man.fbx", binary(FbxFile(path)))).character;
  ASSERT_EQ(read_again.clips.size(), 1u);
  EXPECT_LT(test::farthest_apart(text, PoseTime{}, read_again, PoseTime{}), 1e-6f);
  EXPECT_LT(test::farthest_in_clips(text, 0, read_again, 0), 1e-6f);
}

/// Decodes all that the importer does.
/// Returns: whether the file is read; otherwise it is refused.
bool decode(const std::filesystem::path& path) {
  try {
    const detail::importing::FbxDocument document(path);
    for (const auto id : document.all("AnimationCurve")) read_curve(document, *document.object(id));
    for (const auto id : document.all("Deformer", "Cluster"))
      document.file().numbers(*document.object(id), "Transform");
    return true;
  } catch (const ImportError&) {
    return false;
  }
}

TEST(FbxRecords, DamageIsRefusedOrRead) {
  TemporaryFolder folder;
  const std::filesystem::path path = folder.write("man.fbx", moving_man().text());
  const std::string texts[] = {moving_man().text(), binary(FbxFile(path))};
  detail::Random random(51);
  for (const std::string& text : texts) {
    std::uint32_t refused = 0;
    EXPECT_TRUE(decode(folder.write("whole.fbx", text)));
    for (std::uint32_t i = 0; i < test::samples(120); ++i) {
      std::string damaged = text;
      const auto place = [&] { return random.below(static_cast<std::uint32_t>(damaged.size())); };
      for (int change = 0; change < 3; ++change) damaged[place()] = static_cast<char>(random.below(256));
      if (i % 4 == 0) damaged.resize(place());
      refused += !decode(folder.write("damaged.fbx", damaged));
    }
    EXPECT_GT(refused, 0u);
  }
}

TEST(FbxRecords, DeepRecordsAreRefused) {
  TemporaryFolder folder;
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "A: {";
  EXPECT_THROW(FbxFile(folder.write("deep.fbx", deep)), ImportError);
}

}  // namespace
}  // namespace bch
