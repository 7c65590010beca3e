// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/fbx_record.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <iterator>

#include "layout/import/fbx_text.hpp"
#include "layout/import/scene.hpp"

namespace bch::detail::importing {
namespace {

constexpr std::string_view binary_start("Kaydara FBX Binary  \0", 21);
constexpr std::size_t binary_header = 27;  // with two further bytes and the version

template <class Number>
Number number_at(const char* bytes) {
  static_assert(std::endian::native == std::endian::little);  // as the file
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

/// The bytes of one element of an array, 0 for what is none. Numbers alone have capitals for the same types.
std::size_t size_of(char type) {
  switch (type) {
    case 'd':
    case 'l':
      return 8;
    case 'f':
    case 'i':
      return 4;
    case 'y':
      return 2;
    case 'b':
    case 'c':
      return 1;
    default:
      return 0;
  }
}

double element(char type, const char* bytes) {
  switch (type) {
    case 'd':
      return number_at<double>(bytes);
    case 'l':
      return static_cast<double>(number_at<std::int64_t>(bytes));
    case 'f':
      return static_cast<double>(number_at<float>(bytes));
    case 'i':
      return number_at<std::int32_t>(bytes);
    case 'y':
      return number_at<std::int16_t>(bytes);
    default:
      return number_at<std::uint8_t>(bytes);
  }
}

/// Reads the records of a binary file.
class BinaryReader {
 public:
  BinaryReader(const FbxFile& file, std::string_view bytes)
      : file_(file), bytes_(bytes), wide_(number_at<std::uint32_t>(bytes.data() + 23) >= 7500) {}

  std::vector<FbxRecord> read() {
    at_ = binary_header;
    return records(bytes_.size(), 0);
  }

 private:
  const FbxFile& file_;
  std::string_view bytes_;
  bool wide_;  // ends and sizes have 64 bits
  std::size_t at_ = 0;

  std::string_view take(std::size_t size) {
    if (size > bytes_.size() - at_) file_.reject("the FBX records end within a record");
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  template <class Number>
  Number take() {
    return number_at<Number>(take(sizeof(Number)).data());
  }
  std::uint64_t take_size() { return wide_ ? take<std::uint64_t>() : take<std::uint32_t>(); }

  /// Reads up to a record without a name, which ends a list, or to the end given.
  std::vector<FbxRecord> records(std::size_t end, int depth) {
    if (depth > deepest_fbx_record)
      file_.reject("FBX records nest deeper than " + count(deepest_fbx_record, "level"));
    std::vector<FbxRecord> list;
    while (at_ < end) {
      const std::uint64_t record_end = take_size(), values = take_size();
      take_size();  // of the values in bytes
      FbxRecord record;
      record.name = take(take<std::uint8_t>());
      if (record_end == 0) break;
      if (record_end < at_ || record_end > end) file_.reject("an FBX record ends outside of its list");
      for (std::uint64_t v = 0; v < values; ++v) record.values.push_back(value());
      record.children = records(static_cast<std::size_t>(record_end), depth + 1);
      at_ = static_cast<std::size_t>(record_end);
      list.push_back(std::move(record));
    }
    return list;
  }

  FbxValue value() {
    FbxValue value;
    value.type = take<char>();
    if (value.is_text()) {
      value.bytes = take(take<std::uint32_t>());
    } else if (size_of(value.type) > 0) {
      value.size = take<std::uint32_t>();
      value.packed = take<std::uint32_t>() != 0;
      value.bytes = take(take<std::uint32_t>());
    } else {
      const char type = static_cast<char>(value.type | 0x20);
      const std::size_t size = size_of(type);
      if (size == 0 || type == value.type) file_.reject("an FBX record has a value of an unknown type");
      const char* const bytes = take(size).data();
      value.number = element(type, bytes);
      value.whole = type == 'l' ? number_at<std::int64_t>(bytes) : whole_part(value.number);
    }
    return value;
  }
};

std::string unpacked(const FbxFile& file, const FbxValue& array) {
  constexpr std::size_t largest_ratio = 1100;  // zlib's is 1032
  const std::size_t size = array.size * size_of(array.type);
  if (size / largest_ratio > array.bytes.size()) file.reject("an FBX array is shorter than it says");
  std::string bytes(size, '\0');
  uLongf got = size;
  const int result = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &got,
                                reinterpret_cast<const Bytef*>(array.bytes.data()), array.bytes.size());
  if (result != Z_OK || got != size) file.reject("an FBX array cannot be uncompressed");
  return bytes;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

const FbxRecord* FbxRecord::child(std::string_view child_name) const {
  for (const FbxRecord& record : children)
    if (record.name == child_name) return &record;
  return nullptr;
}

std::string_view FbxRecord::text(std::size_t index) const {
  return index < values.size() && values[index].is_text() ? values[index].bytes : std::string_view();
}
double FbxRecord::number(std::size_t index) const {
  return index < values.size() ? values[index].number : 0;
}
std::int64_t FbxRecord::whole(std::size_t index) const {
  return index < values.size() ? values[index].whole : 0;
}

FbxFile::FbxFile(const std::filesystem::path& path) : path_(path), bytes_(bytes_of(path)) {
  const bool binary = bytes_.size() >= binary_header && bytes_.starts_with(binary_start);
  root_.children = binary ? BinaryReader(*this, bytes_).read() : read_fbx_text(*this, bytes_);
}

std::vector<double> FbxFile::numbers(const FbxRecord& object, std::string_view name) const {
  const FbxRecord* const record = object.child(name);
  if (record == nullptr || record->values.empty()) return {};
  const FbxValue& array = record->values.front();
  if (array.type == 't') return numbers_in_text(array.bytes);
  const std::size_t step = size_of(array.type);
  if (step == 0) reject("'" + std::string(name) + "' of an FBX object is no array");
  std::string storage;
  std::string_view bytes = array.bytes;
  if (array.packed) bytes = storage = unpacked(*this, array);
  if (bytes.size() / step < array.size) reject("an FBX array is shorter than it says");
  std::vector<double> numbers(array.size);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = element(array.type, bytes.data() + i * step);
  return numbers;
}

std::vector<double> FbxFile::float_bits(const FbxRecord& object, std::string_view name) const {
  std::vector<double> result = numbers(object, name);
  const FbxRecord* const record = object.child(name);
  if (record == nullptr || record->values.empty() || record->values.front().type == 'f') return result;
  for (double& number : result)
    number = static_cast<double>(std::bit_cast<float>(static_cast<std::int32_t>(whole_part(number))));
  return result;
}

void FbxFile::reject(const std::string& reason) const {
  importing::reject(path_, reason);
}

}  // namespace bch::detail::importing
