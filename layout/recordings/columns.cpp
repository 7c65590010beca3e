// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/columns.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "layout/recordings/fields.hpp"

namespace bch::detail::trajectory {
namespace {

struct NamedRole {
  std::string_view name;
  Role role;
};

/// All names that are known, without '_', '-', '.' and blanks; layout/README.md lists them.
constexpr NamedRole roles[] = {{"id", Role::id},
                               {"agent", Role::id},
                               {"agentid", Role::id},
                               {"objectid", Role::id},
                               {"ped", Role::id},
                               {"pedestrian", Role::id},
                               {"pedestrianid", Role::id},
                               {"pedid", Role::id},
                               {"persid", Role::id},
                               {"person", Role::id},
                               {"personid", Role::id},
                               {"trackid", Role::id},
                               {"frame", Role::frame},
                               {"fr", Role::frame},
                               {"frameid", Role::frame},
                               {"time", Role::time},
                               {"simtime", Role::time},
                               {"t", Role::time},
                               {"timestamp", Role::time},
                               {"x", Role::x},
                               {"centerx", Role::x},
                               {"positionx", Role::x},
                               {"posx", Role::x},
                               {"xcenter", Role::x},
                               {"y", Role::y},
                               {"centery", Role::y},
                               {"positiony", Role::y},
                               {"posy", Role::y},
                               {"ycenter", Role::y},
                               {"z", Role::height},
                               {"height", Role::height},
                               {"stature", Role::height},
                               {"heading", Role::heading},
                               {"angle", Role::heading},
                               {"orientation", Role::heading},
                               {"theta", Role::heading},
                               {"yaw", Role::heading},
                               {"character", Role::character},
                               {"clip", Role::clip},
                               {"cliptime", Role::clip_time},
                               {"body", Role::body},
                               {"length", Role::length},
                               {"width", Role::width},
                               {"radius", Role::radius}};

struct NamedUnit {
  std::string_view name;
  double factor;
};

constexpr NamedUnit lengths[] = {{"m", 1},
                                 {"metre", 1},
                                 {"metres", 1},
                                 {"meter", 1},
                                 {"meters", 1},
                                 {"cm", 0.01},
                                 {"mm", 0.001},
                                 {"centimetre", 0.01},
                                 {"centimetres", 0.01},
                                 {"centimeter", 0.01},
                                 {"centimeters", 0.01}};
constexpr NamedUnit durations[] = {{"s", 1},     {"sec", 1},   {"second", 1}, {"seconds", 1},
                                   {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}};

constexpr NamedUnit angles[] = {{"rad", 1},
                                {"radians", 1},
                                {"deg", std::numbers::pi / 180},
                                {"degree", std::numbers::pi / 180},
                                {"degrees", std::numbers::pi / 180},
                                {"\u00b0", std::numbers::pi / 180}};

std::optional<double> find(std::span<const NamedUnit> units, std::string_view name) {
  if (name.starts_with("in ")) name = trimmed(name.substr(3));
  for (const NamedUnit& unit : units)
    if (unit.name == name) return unit.factor;
  return std::nullopt;
}

/// Returns the units of what a column holds.
std::span<const NamedUnit> units_of(Role role) {
  switch (role) {
    case Role::x:
    case Role::y:
    case Role::height:
    case Role::length:
    case Role::width:
    case Role::radius:
      return lengths;
    case Role::time:
    case Role::clip_time:
      return durations;
    case Role::heading:
      return angles;
    default:
      return {};
  }
}

bool separates(char c, char separator) {
  return separator == '#'   ? is_blank(c) || c == ',' || c == ';'
         : separator == ' ' ? is_blank(c)
                            : c == separator;
}

char closing(char opening) {
  return opening == '[' ? ']' : ')';
}

/// Cuts a line at separators, but for those between brackets.
std::vector<std::string_view> words_of(std::string_view line, char separator) {
  std::vector<std::string_view> words;
  const std::size_t last_square = line.rfind(']'), last_round = line.rfind(')');
  const auto closes = [&](std::size_t at) {
    const std::size_t last = line[at] == '[' ? last_square : last_round;
    return last != std::string_view::npos && last > at;
  };
  std::size_t begin = 0;
  for (std::size_t at = 0; at <= line.size(); ++at) {
    if (at < line.size() && (line[at] == '[' || line[at] == '(')) {
      if (closes(at)) at = line.find(closing(line[at]), at);
    } else if (at == line.size() || separates(line[at], separator)) {
      const std::string_view word = trimmed(line.substr(begin, at - begin));
      const bool may_be_empty = separator != '#' && separator != ' ';
      if (may_be_empty || !word.empty()) words.push_back(word);
      begin = at + 1;
    }
  }
  return words;
}

/// The columns of a table while they are found.
class ColumnFinder {
 public:
  ColumnFinder(const Places& places, std::optional<std::uint64_t> line, bool unit_is_given)
      : places_(places), line_(line), unit_is_given_(unit_is_given) {}

  void add(const ColumnName& column) {
    const Role role = role_of(column.name);
    columns_.roles.push_back(role);
    columns_.names.push_back(column.name);
    columns_.has_angle |= role == Role::heading && column.name == "angle";
    if (column.unit.empty()) return;
    if (role == Role::x || role == Role::y) take_length(column);
    if (role == Role::height) columns_.height_metres = find(lengths, column.unit);
    if (role == Role::length || role == Role::width || role == Role::radius) take_size(column);
    if (role == Role::time) take_duration(column, columns_.seconds);
    if (role == Role::clip_time) take_duration(column, columns_.clip_seconds);
    if (role == Role::heading) take_angle(column);
  }

  Columns finish() {
    const bool has_frames = columns_.has(Role::frame);
    if (has_frames) settle_time();
    settle_sizes();
    require_different();
    require(Role::id, "'id'");
    if (!has_frames) require(Role::time, "'frame', nor one called 'time'");
    require(Role::x, "'x'");
    require(Role::y, "'y'");
    if (columns_.has(Role::clip_time)) require(Role::clip, "'clip', whose time 'clip_time' is");
    for (std::size_t i = 0; i < columns_.roles.size(); ++i)
      if (columns_.roles[i] != Role::none) columns_.needed = i + 1;
    return std::move(columns_);
  }

 private:
  const Places& places_;
  std::optional<std::uint64_t> line_;
  bool unit_is_given_;
  Columns columns_;

  [[noreturn]] void reject(const std::string& reason) const {
    if (line_) places_.reject(*line_, reason);
    places_.reject(reason);
  }

  void require(Role role, const char* name) const {
    if (columns_.has(role)) return;
    std::string all;
    for (const std::string& there : columns_.names) all += (all.empty() ? "" : ", ") + there;
    reject(std::string("has no column called ") + name + ", only " + shown(all));
  }

  void require_different() const {
    for (std::size_t i = 0; i < columns_.roles.size(); ++i)
      if (columns_.roles[i] != Role::none &&
          std::find(columns_.roles.begin(), columns_.roles.begin() + static_cast<std::ptrdiff_t>(i),
                    columns_.roles[i]) != columns_.roles.begin() + static_cast<std::ptrdiff_t>(i))
        reject("has two columns for the same, the second is " + shown(columns_.names[i]));
  }

  void take_length(const ColumnName& column) {
    const std::optional<double> metres = find(lengths, column.unit);
    if (unit_is_given_) return;
    if (!metres)
      reject("the unit " + shown(column.unit) + " of column " + shown(column.name) +
             " is not known: --unit has to give its metres");
    if (columns_.metres && *columns_.metres != *metres) reject("x and y are of different units");
    columns_.metres = metres;
  }

  void take_size(const ColumnName& column) {
    const std::optional<double> metres = find(lengths, column.unit);
    if (unit_is_given_) return;
    if (!metres) {
      columns_.roles.back() = Role::none;  // of pixels, for instance
      return;
    }
    if (columns_.size_metres && *columns_.size_metres != *metres)
      reject("length, width and radius are of different units");
    columns_.size_metres = metres;
  }

  void take_angle(const ColumnName& column) {
    columns_.radians = find(angles, column.unit);
    if (!columns_.radians)
      reject("the unit " + shown(column.unit) + " of column " + shown(column.name) + " is not known");
  }

  /// Beside frames a time is that of the row's clip, or does not matter.
  void settle_time() {
    columns_.has_frames_and_time =
        columns_.has(Role::time) && columns_.has(Role::clip) && !columns_.has(Role::clip_time);
    if (columns_.has_frames_and_time) columns_.clip_seconds = columns_.seconds;
    for (Role& role : columns_.roles)
      if (role == Role::time) role = columns_.has_frames_and_time ? Role::clip_time : Role::none;
  }

  /// A length or a width without the other, of nothing that is named, is no size of a body.
  void settle_sizes() {
    if (columns_.has(Role::body) || columns_.has(Role::length) == columns_.has(Role::width)) return;
    for (Role& role : columns_.roles)
      if (role == Role::length || role == Role::width) role = Role::none;
  }

  void take_duration(const ColumnName& column, std::optional<double>& seconds) {
    seconds = find(durations, column.unit);
    if (!seconds) reject("the unit " + shown(column.unit) + " of time is not known");
  }
};

}  // namespace

std::optional<double> metres_of(std::string_view unit) {
  return find(lengths, unit);
}

ColumnName column_name(std::string_view word) {
  if (word.size() >= 2 && word.starts_with('"') && word.ends_with('"'))
    word = trimmed(word.substr(1, word.size() - 2));
  const std::size_t end = std::min(word.find_first_of("/[("), word.size());
  std::string_view unit = word.substr(end);
  if (!unit.empty()) unit.remove_prefix(1);
  if (unit.ends_with(']') || unit.ends_with(')')) unit.remove_suffix(1);
  ColumnName column{lower_case(trimmed(word.substr(0, end))), lower_case(trimmed(unit))};
  const std::size_t last = column.name.rfind('_');
  if (column.unit.empty() && last != std::string::npos) {  // "heading_deg"
    const std::string suffix = column.name.substr(last + 1);
    if (find(units_of(role_of(column.name.substr(0, last))), suffix)) {
      column.unit = suffix;
      column.name.resize(last);
    }
  }
  return column;
}

std::vector<ColumnName> column_names(std::string_view line, char separator) {
  std::vector<ColumnName> names;
  for (const std::string_view word : words_of(line, separator)) {
    ColumnName name = column_name(word);
    if (name.name.empty() && !name.unit.empty() && !names.empty())  // "x [m]" where blanks separate names
      names.back().unit = std::move(name.unit);
    else
      names.push_back(std::move(name));
  }
  return names;
}

Role role_of(std::string_view name) {
  const auto divides = [](char c) { return std::string_view("_-. ").find(c) != std::string_view::npos; };
  if (name.empty() || divides(name.front()) || divides(name.back())) return Role::none;
  std::string letters(name);
  std::erase_if(letters, divides);
  for (const NamedRole& known : roles)
    if (known.name == letters) return known.role;
  return Role::none;
}

bool has_all_roles(std::span<const ColumnName> names) {
  const auto has = [&](Role role) {
    return std::any_of(names.begin(), names.end(),
                       [&](const ColumnName& column) { return role_of(column.name) == role; });
  };
  return has(Role::id) && (has(Role::frame) || has(Role::time)) && has(Role::x) && has(Role::y);
}

std::string Columns::ignored() const {
  constexpr std::size_t most = 12;
  std::string text;
  std::size_t count = 0;
  for (std::size_t i = 0; i < roles.size(); ++i) {
    if (roles[i] != Role::none || names[i].empty() || names[i] == "skip") continue;
    if (count++ < most) text += (text.empty() ? "" : ", ") + shown(names[i]);
  }
  if (count > most) text += " and " + std::to_string(count - most) + " more";
  return text.empty()
             ? text
             : (count == 1 ? "Column " : "Columns ") + text + (count == 1 ? " is" : " are") + " ignored.";
}

bool Columns::has(Role role) const {
  return std::find(roles.begin(), roles.end(), role) != roles.end();
}

Columns columns_of(const Places& places, std::optional<std::uint64_t> line, std::span<const ColumnName> names,
                   bool unit_is_given) {
  ColumnFinder finder(places, line, unit_is_given);
  for (const ColumnName& column : names) finder.add(column);
  return finder.finish();
}

}  // namespace bch::detail::trajectory
