// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/fbx_record.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>

#include "layout/base/decimal.hpp"
#include "layout/import/scene.hpp"

namespace bch::detail::importing {
namespace {

constexpr std::string_view binary_start("Kaydara FBX Binary  \0", 21);
constexpr std::size_t binary_header = 27;  // with two further bytes and the version
constexpr int deepest = 64;                // of real files, about 8

std::int64_t whole_part(double number) {
  constexpr double most = 9.2e18;
  return std::isfinite(number) ? static_cast<std::int64_t>(std::clamp(number, -most, most)) : 0;
}

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
    if (depth > deepest) file_.reject("FBX records nest deeper than " + count(deepest, "level"));
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

/// Returns NaN for what is no number, which is refused where it is used.
double number_from(std::string_view word) {
  double number = 0;
  const auto [end, error] = double_from_chars(word.data(), word.data() + word.size(), number);
  if (end != word.data() + word.size()) return std::nan("");
  const bool tiny = word.find("e-") != word.npos || word.find("E-") != word.npos;
  return error == std::errc::result_out_of_range ? (tiny ? 0 : HUGE_VAL) : number;
}

/// Reads the records of a text file: a name and a colon, values between commas, records in braces.
class TextReader {
 public:
  TextReader(const FbxFile& file, std::string_view bytes) : file_(file), bytes_(bytes) {
    if (bytes_.starts_with("\xEF\xBB\xBF")) bytes_.remove_prefix(3);
  }

  std::vector<FbxRecord> read() { return records(0); }

 private:
  const FbxFile& file_;
  std::string_view bytes_;
  std::size_t at_ = 0;

  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

  /// Returns the next character that is neither blank nor in a comment; 0 at the end.
  char next() {
    while (at_ < bytes_.size() && (is_blank(bytes_[at_]) || bytes_[at_] == ';')) {
      if (bytes_[at_] == ';') at_ = std::min(bytes_.find('\n', at_), bytes_.size() - 1);
      ++at_;
    }
    return at_ < bytes_.size() ? bytes_[at_] : '\0';
  }

  std::string_view up_to(std::string_view ends) {
    const std::size_t begin = at_;
    at_ = std::min(bytes_.find_first_of(ends, at_), bytes_.size());
    return bytes_.substr(begin, at_ - begin);
  }

  /// Returns the name of the record that begins here; nothing if a value does, or a brace.
  std::optional<std::string_view> name() {
    next();
    const std::size_t begin = at_;
    const std::string_view word = up_to(" \t\r\n;,:{}\"");
    if (!word.empty() && at_ < bytes_.size() && bytes_[at_] == ':') {
      ++at_;
      return word;
    }
    at_ = begin;
    return std::nullopt;
  }

  std::vector<FbxRecord> records(int depth) {
    if (depth > deepest) file_.reject("FBX records nest deeper than " + count(deepest, "level"));
    std::vector<FbxRecord> list;
    while (const std::optional<std::string_view> record_name = name()) {
      FbxRecord record;
      record.name = *record_name;
      read_values(record);
      if (next() == '{') {
        ++at_;
        record.children = records(depth + 1);
        if (next() != '}') file_.reject("an FBX record has no end");
        ++at_;
      }
      list.push_back(std::move(record));
    }
    if (depth == 0 && next() != '\0')
      file_.reject("the FBX text has a value where a record's name is expected");
    return list;
  }

  void read_values(FbxRecord& record) {
    for (bool more = true; more;) {
      const char c = next();
      if (c == '*')
        record.values.push_back(array());
      else if (c == '"')
        record.values.push_back(text());
      else if (const std::size_t begin = at_; name()) {
        at_ = begin;
        return;
      } else if (const std::string_view word = up_to(" \t\r\n;,{}\""); !word.empty())
        record.values.push_back(word_value(word));
      more = next() == ',';
      if (more) ++at_;
    }
  }

  FbxValue text() {
    FbxValue value;
    value.type = 'S';
    ++at_;
    value.bytes = up_to("\"");
    if (at_ == bytes_.size()) file_.reject("an FBX text has no end");
    ++at_;
    return value;
  }

  FbxValue word_value(std::string_view word) {
    FbxValue value;
    value.number = number_from(word);
    value.type = std::isnan(value.number) ? 'S' : 'n';
    value.bytes = word;
    const char* const end = word.data() + word.size();
    if (std::from_chars(word.data(), end, value.whole).ptr != end) value.whole = whole_part(value.number);
    return value;
  }

  /// Reads "*SIZE { a: NUMBER,NUMBER }".
  FbxValue array() {
    FbxValue value;
    value.type = 't';
    up_to("{");
    value.bytes = up_to("}");
    if (at_ == bytes_.size()) file_.reject("an FBX array has no end");
    ++at_;
    return value;
  }
};

std::vector<double> numbers_in_text(std::string_view text) {
  std::vector<double> numbers;
  constexpr std::string_view between = " \t\r\n,";
  std::size_t at = text.find(':');
  at = at == std::string_view::npos ? text.size() : at + 1;
  while ((at = text.find_first_not_of(between, at)) != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(between, at), text.size());
    numbers.push_back(number_from(text.substr(at, end - at)));
    at = end;
  }
  return numbers;
}

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
  root_.children = binary ? BinaryReader(*this, bytes_).read() : TextReader(*this, bytes_).read();
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
