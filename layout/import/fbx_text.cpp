// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/fbx_text.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include "layout/base/decimal.hpp"
#include "layout/base/number_class.hpp"
#include "layout/import/scene.hpp"

namespace bch::detail::importing {
namespace {

/// Returns NaN for what is no number, which is refused where it is used.
double number_from(std::string_view word) {
  double number = 0;
  const auto [end, error] = double_from_chars(word.data(), word.data() + word.size(), number);
  if (end != word.data() + word.size()) return std::nan("");
  return error == std::errc::result_out_of_range ? HUGE_VAL : number;
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
    if (depth > deepest_fbx_record)
      file_.reject("FBX records nest deeper than " + count(deepest_fbx_record, "level"));
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
    value.type = is_nan(value.number) ? 'S' : 'n';
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

}  // namespace

std::int64_t whole_part(double number) {
  constexpr double most = 9.2e18;
  return is_finite(number) ? static_cast<std::int64_t>(std::clamp(number, -most, most)) : 0;
}

std::vector<FbxRecord> read_fbx_text(const FbxFile& file, std::string_view bytes) {
  return TextReader(file, bytes).read();
}

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

}  // namespace bch::detail::importing
