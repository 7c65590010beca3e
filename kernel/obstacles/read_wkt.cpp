// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <bch/obstacles.hpp>

#include "layout/base/decimal.hpp"
#include "layout/base/rounding.hpp"

namespace bch {
namespace {

/// Obstacles as they are read.
struct ReadObstacles {
  std::vector<double> x, y;
  std::vector<std::uint64_t> polyline_offsets{0}, obstacle_offsets{0};
  std::vector<std::uint8_t> is_area;

  /// Ends a polyline, or an obstacle of polylines; there is none where nothing was read for it.
  void end_path() {
    if (polyline_offsets.back() != x.size()) polyline_offsets.push_back(x.size());
  }
  void end_obstacle(bool area) {
    if (obstacle_offsets.back() == polyline_offsets.size() - 1) return;
    obstacle_offsets.push_back(polyline_offsets.size() - 1);
    is_area.push_back(area);
  }
};

/// Returns text in which every byte that is no printable character of ASCII is escaped, as \xe2: what() ends at a zero byte.
std::string with_escapes(std::string_view text) {
  constexpr const char* hex = "0123456789abcdef";
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c >= ' ' && c <= '~')
      out += c;
    else
      out.append("\\x").append({hex[byte / 16], hex[byte % 16]});
  }
  return out;
}

/// Reads geometries by recursive descent. The grammar is that of OGC's simple features, and what programs add: Z, M and ZM at the end of a
/// name or behind it or, as PostGIS writes extended WKT, not named at all; SRID=4326; before a geometry, and a byte order mark of UTF-8
/// before all.
class WktReader {
 public:
  WktReader(std::string_view text, bool walkable) : text_(text), walkable_(walkable) {
    constexpr std::string_view mark = "\xef\xbb\xbf";
    if (text_.starts_with(mark)) text_.remove_prefix(mark.size());
  }

  ReadObstacles read() {
    for (skip_space(); at_ < text_.size(); skip_space()) {
      skip_reference_system();
      geometry(0);
    }
    return std::move(read_);
  }

 private:
  /// More than anybody nests; a call of geometry() takes a hundred bytes of stack.
  static constexpr int max_nested = 100;
  static constexpr const char* known =
      "POLYGON, MULTIPOLYGON, LINESTRING, MULTILINESTRING or GEOMETRYCOLLECTION";

  [[noreturn]] void reject(const std::string& expected) const { reject_at(at_, expected); }
  [[noreturn]] void reject_at(std::size_t at, const std::string& expected) const {
    const std::string_view before = text_.substr(0, at);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t column = at - (before.rfind('\n') + 1) + 1;  // npos + 1 is 0
    std::size_t end = at;
    while (end < text_.size() && end < at + 20 && is_of_token(text_[end])) ++end;
    if (end == at && at < text_.size()) do
        ++end;
      while (end < text_.size() && continues_character(text_[end]));
    const std::string found =
        end == at ? "the end of the text" : "'" + with_escapes(text_.substr(at, end - at)) + "'";
    throw std::invalid_argument("WKT: line " + std::to_string(line) + ", column " + std::to_string(column) +
                                ": expected " + expected + ", found " + found);
  }

  /// Returns whether a byte is one of a character of UTF-8, but not its first.
  static bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

  static bool is_of_token(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '+' || c == '_';
  }

  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }

  /// Takes a character, if it is next.
  bool take(char c) {
    skip_space();
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  /// Reads a word in capital letters; none leaves it empty.
  std::string word() {
    skip_space();
    std::string letters;
    while (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_])) != 0)
      letters += static_cast<char>(std::toupper(static_cast<unsigned char>(text_[at_++])));
    return letters;
  }
  bool take(std::string_view wanted) {
    const std::size_t before = at_;
    if (word() == wanted) return true;
    at_ = before;
    return false;
  }

  /// Reads "(one, one ...)" or EMPTY.
  template <class One>
  void list(const char* what, One one) {
    if (take("EMPTY")) return;
    if (!take('(')) reject(std::string("'(' before ") + what + ", or EMPTY");
    do one();
    while (take(','));
    if (!take(')')) reject("',' or ')'");
  }

  /// Skips what extended WKT begins with, as SRID=4326;.
  void skip_reference_system() {
    if (!take("SRID")) return;
    if (!take('=')) reject("'='");
    skip_space();
    const std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9') ++at_;
    if (at_ == begin) reject("a number");
    if (!take(';')) reject("';'");
  }

  /// Reads the name of a kind, and how many coordinates its points have: PolygonZM or Polygon ZM. (No kind ends with Z or M.) A name
  /// without either leaves that to the first point.
  std::string kind() {
    std::string name = word();
    coordinates_ = 0;
    for (const std::string_view more : {"ZM", "Z", "M"}) {
      const bool is_suffix = name.ends_with(more);
      if (!is_suffix && !take(more)) continue;
      if (is_suffix) name.resize(name.size() - more.size());
      coordinates_ = 2 + static_cast<int>(more.size());
      break;
    }
    return name;
  }

  void geometry(int depth) {
    skip_space();
    const std::size_t begin = at_;
    const std::string name = kind();
    if (name == "POLYGON") {
      polygon();
    } else if (name == "MULTIPOLYGON") {
      list("polygons", [&] { polygon(); });
    } else if (name == "LINESTRING") {
      line();
    } else if (name == "MULTILINESTRING") {
      list("lines", [&] { line(); });
    } else if (name == "GEOMETRYCOLLECTION") {
      if (depth == max_nested) reject_at(begin, "fewer collections in each other");
      list("geometries", [&] { geometry(depth + 1); });
    } else {
      reject_at(begin, known);
    }
  }

  void polygon() {
    list("rings", [&] {
      const std::size_t first = read_.x.size();
      points();
      if (walkable_) close(first);
      read_.end_path();
      if (walkable_) read_.end_obstacle(false);
    });
    if (!walkable_) read_.end_obstacle(true);
  }

  /// Repeats the first point of a ring at its end: a line does not close itself.
  void close(std::size_t first) {
    const std::size_t end = read_.x.size();
    if (end <= first + 1 || (read_.x[first] == read_.x[end - 1] && read_.y[first] == read_.y[end - 1]))
      return;
    const double x = read_.x[first], y = read_.y[first];
    read_.x.push_back(x), read_.y.push_back(y);
  }

  void line() {
    points();
    read_.end_path();
    read_.end_obstacle(false);
  }

  void points() {
    list("points", [&] {
      read_.x.push_back(position());
      read_.y.push_back(position());
      int count = 2;
      for (; coordinates_ == 0 ? count < 4 && has_more() : count < coordinates_; ++count) number();
      coordinates_ = count;
    });
  }

  /// Returns whether a point has another coordinate.
  bool has_more() {
    skip_space();
    return at_ < text_.size() && is_of_token(text_[at_]);
  }

  double position() {
    skip_space();
    const std::size_t begin = at_;
    const double value = number();
    if (!(std::abs(value) <= detail::rounding::largest_position)) reject_at(begin, "a number within +-1e9");
    return value;
  }

  /// Reads any number, as a height that is ignored may be: NaN, too.
  double number() {
    skip_space();
    const std::size_t begin = at_;
    if (text_.substr(at_).starts_with('+') && !text_.substr(at_).starts_with("+-")) ++at_;
    double value = 0;
    const auto [end, error] =
        detail::double_from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error == std::errc::invalid_argument || (end != text_.data() + text_.size() && is_of_token(*end)))
      reject_at(begin, "a number");
    if (error == std::errc::result_out_of_range) value = HUGE_VAL;
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }

  std::string_view text_;
  bool walkable_;
  std::size_t at_ = 0;
  int coordinates_ = 0;  ///< of a point; 0: not known yet
  ReadObstacles read_;
};

}  // namespace

ObstacleSet obstacles_from_wkt(std::string_view text, Polygons polygons, double bottom, double top) {
  if (polygons != Polygons::solid && polygons != Polygons::walkable)
    throw std::invalid_argument("obstacles: expected polygons of 0 (solid) or 1 (walkable), found " +
                                std::to_string(static_cast<int>(polygons)));
  const ReadObstacles read = WktReader(text, polygons == Polygons::walkable).read();
  ObstacleArrays arrays{read.x, read.y, read.polyline_offsets, read.obstacle_offsets, read.is_area};
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const std::vector<double> bottoms(read.is_area.size(), bottom), tops(read.is_area.size(), top);
  if (!(bottom == -infinite && top == infinite)) arrays.bottom = bottoms, arrays.top = tops;
  return ObstacleSet(arrays);
}

}  // namespace bch
