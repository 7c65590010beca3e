// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/csv_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include "bench/base/exit_codes.hpp"
#include "bench/base/text.hpp"
#include "layout/base/rounding.hpp"
#include "layout/recordings/fields.hpp"
#include "layout/recordings/line_reader.hpp"

namespace bch::cli {
namespace {

using detail::trajectory::Fields;
using detail::trajectory::LineReader;

/// The longest displacement of an agent: two such displacements apart are within the limit of time_of_impact().
constexpr double largest_displacement = detail::rounding::largest_position / 2;

/// A place in a file, for messages.
struct Place {
  const std::string& file;
  std::uint64_t line;

  [[noreturn]] void reject(const std::string& reason) const {
    throw InputError(fmt::format("{}:{}: {}", file, line, reason));
  }
  [[noreturn]] void reject(const char* column, std::string_view value, const std::string& reason) const {
    reject(fmt::format("{} '{}' {}", column, value, reason));
  }
};

double number_within(const Place& place, const char* column, std::string_view text, double limit) {
  const auto value = parse_number(text);
  if (!value) place.reject(column, text, "is not a number");
  if (!(*value >= -limit && *value <= limit))
    place.reject(column, text, fmt::format("is not within +-{:g}", limit));
  return *value;
}

std::uint32_t index_below(const Place& place, const char* column, std::string_view text,
                          std::uint32_t bound) {
  std::uint32_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::invalid_argument || stop != text.data() + text.size())
    place.reject(column, text, "is not a whole number");
  if (error != std::errc() || value >= bound)
    place.reject(column, text, fmt::format("is not one of 0 to {}", bound - 1));
  return value;
}

/// The rows of a table, whose first line names its columns in any order.
class CsvRows {
 public:
  /// Takes the columns that may be there.
  CsvRows(const std::string& file, std::vector<std::string_view> known)
      : file_(file), known_(std::move(known)), places_{file, true}, lines_(places_) {
    if (!read_fields()) throw InputError(file_ + ": is empty");
    for (std::string& name : fields_) columns_.push_back(column_of(name));
  }

  bool has(std::string_view column) const { return std::ranges::count(columns_, column) > 0; }
  void require(std::initializer_list<const char*> columns) const {
    for (const char* name : columns)
      if (!has(name)) place().reject(fmt::format("has no column '{}'", name));
  }

  /// Returns whether there was another row.
  bool next() {
    if (!read_fields()) return false;
    if (fields_.size() != columns_.size())
      place().reject(fmt::format("has {} values than the header has columns",
                                 fields_.size() < columns_.size() ? "fewer" : "more"));
    return true;
  }
  Place place() const { return {file_, lines_.number()}; }
  /// Returns a value of the row; empty without that column.
  std::string_view operator[](std::string_view column) const {
    const auto found = std::ranges::find(columns_, column);
    return found == columns_.end() ? std::string_view()
                                   : fields_[static_cast<std::size_t>(found - columns_.begin())];
  }

 private:
  std::string_view column_of(const std::string& name) const {
    // A file whose lines end with CR alone has a CR in the name of its last column.
    if (name.find('\r') != std::string::npos)
      place().reject("ends lines with CR alone, not with LF or CR LF");
    if (has(name)) place().reject(fmt::format("column '{}' is there twice", name));
    const auto found = std::ranges::find(known_, name);
    if (found == known_.end()) place().reject(fmt::format("column '{}' is not known", name));
    return *found;
  }

  /// Takes the fields of the next line that is not empty; two quotes within quotes stand for one.
  bool read_fields() {
    std::string_view line;
    do
      if (!lines_.next(line)) return false;
    while (detail::trajectory::trimmed(line).empty());
    fields_.clear();
    Fields fields(line, ',');
    for (std::string_view field; fields.next(field);) {
      std::string& kept = fields_.emplace_back(field);
      for (std::size_t at = 0; (at = kept.find("\"\"", at)) != std::string::npos; ++at) kept.erase(at, 1);
    }
    if (fields.is_broken()) place().reject("a quote is not closed");
    return true;
  }

  const std::string& file_;
  std::vector<std::string_view> known_, columns_;
  detail::trajectory::Places places_;
  LineReader lines_;
  std::vector<std::string> fields_;
};

void add_agent(const Place& place, AgentTable& table, std::string_view id, std::uint32_t shape, double x,
               double y, double heading) {
  if (id.empty()) place.reject("id", id, "is empty");
  if (!table.index_of.emplace(std::string(id), static_cast<std::uint32_t>(table.id.size())).second)
    place.reject("id", id, "is there twice");
  table.id.emplace_back(id);
  table.shape.push_back(shape);
  table.x.push_back(x);
  table.y.push_back(y);
  table.heading.push_back(heading);
}

}  // namespace

AgentTable read_agents(const std::string& file, std::uint32_t shapes, std::uint32_t levels, bool moving) {
  constexpr double largest_position = detail::rounding::largest_position;
  AgentTable table;
  CsvRows rows(file, {"id", "shape", "x", "y", "heading", "z", "level", "dx", "dy", "mobility"});
  rows.require({"id", "shape", "x", "y", "heading"});
  const bool has_z = rows.has("z"), has_level = rows.has("level"), has_mobility = rows.has("mobility");
  const bool has_displacement = moving || rows.has("dx") || rows.has("dy");
  if (has_displacement) rows.require({"dx", "dy"});
  while (rows.next()) {
    const Place place = rows.place();
    const auto number = [&](const char* column, double limit) {
      return number_within(place, column, rows[column], limit);
    };
    add_agent(place, table, rows["id"], index_below(place, "shape", rows["shape"], shapes),
              number("x", largest_position), number("y", largest_position),
              number("heading", detail::rounding::largest_heading));
    if (has_z) table.z.push_back(number("z", largest_position));
    if (has_level)
      table.level.push_back(static_cast<std::uint8_t>(index_below(place, "level", rows["level"], levels)));
    if (has_mobility) table.mobility.push_back(number("mobility", HUGE_VAL));
    if (has_mobility && !(table.mobility.back() >= 0 && table.mobility.back() <= 1))
      place.reject("mobility", rows["mobility"], "is not within 0 to 1");
    if (!has_displacement) continue;
    table.dx.push_back(number("dx", largest_displacement));
    table.dy.push_back(number("dy", largest_displacement));
  }
  return table;
}

std::vector<Pair> read_pairs(const std::string& file, const AgentTable& agents) {
  std::vector<Pair> pairs;
  CsvRows rows(file, {"first", "second"});
  rows.require({"first", "second"});
  while (rows.next()) {
    const auto index = [&](const char* column) {
      const auto found = agents.index_of.find(std::string(rows[column]));
      if (found == agents.index_of.end())
        rows.place().reject(column, rows[column], "is not the id of an agent");
      return found->second;
    };
    const std::uint32_t first = index("first");
    pairs.push_back({first, index("second")});
  }
  return pairs;
}

std::string csv_of(const AgentTable& agents) {
  const std::pair<const char*, const std::vector<double>&> more[] = {
      {"z", agents.z}, {"dx", agents.dx}, {"dy", agents.dy}, {"mobility", agents.mobility}};
  std::string lines = agents.level.empty() ? "id,shape,x,y,heading" : "id,shape,x,y,heading,level";
  for (const auto& [name, column] : more)
    if (!column.empty()) (lines += ',') += name;
  for (std::size_t i = 0; i < agents.id.size(); ++i) {
    lines += fmt::format("\n{},{},{},{},{}", csv_field(agents.id[i]), agents.shape[i], agents.x[i],
                         agents.y[i], agents.heading[i]);
    if (!agents.level.empty()) lines += fmt::format(",{}", agents.level[i]);
    for (const auto& [name, column] : more)
      if (!column.empty()) lines += fmt::format(",{}", column[i]);
  }
  return lines + "\n";
}

void guard_ids(AgentTable& table) {
  for (std::string& id : table.id) {
    if (std::string_view("=+-@\t\r\n").find(id.front()) == std::string_view::npos) continue;
    const std::optional<double> number = parse_number(id);
    if (!number || !std::isfinite(*number)) id.insert(id.begin(), '\'');
  }
}

std::string csv_field(const std::string& text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  const bool trimmed = !text.empty() && (is_blank(text.front()) || is_blank(text.back()));
  if (!trimmed && text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace bch::cli
