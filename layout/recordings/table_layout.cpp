// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/table_layout.hpp"

#include <algorithm>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "layout/recordings/comment_header.hpp"
#include "layout/recordings/fields.hpp"
#include "layout/recordings/first_rows.hpp"
#include "layout/recordings/numbers.hpp"

namespace bch::detail::trajectory {
namespace {

constexpr std::string_view juelich_columns = "id frame x y z", eth_columns = "frame id x y z";

/// Settles what a unit of each column is, and says what is assumed. `said`: the metres of a unit, where something else than columns says it.
void take_units_of_columns(TableLayout& layout, const TrajectoryOptions& options,
                           std::optional<double> said) {
  std::vector<std::string>& assumptions = layout.recording.assumptions;
  const Columns& columns = layout.columns;
  std::optional<double> metres = columns.metres ? columns.metres : said;
  if (options.unit) metres = options.unit;
  if (!metres) assumptions.emplace_back("Coordinates are in metres; no unit is said.");
  layout.metres = metres.value_or(1);
  layout.height_metres = options.unit ? *options.unit : columns.height_metres.value_or(layout.metres);
  layout.size_metres = options.unit ? *options.unit : columns.size_metres.value_or(layout.metres);
  layout.radians = columns.radians.value_or(columns.has_angle ? std::numbers::pi / 180 : 1);
  if (columns.has_angle && !columns.radians)
    assumptions.emplace_back("Angles are headings in degrees; no unit is said.");
  if (std::string ignored = columns.ignored(); !ignored.empty())
    layout.recording.notes.push_back(std::move(ignored));
  layout.clip_seconds = columns.clip_seconds.value_or(1);
  if (columns.has_frames_and_time)
    assumptions.emplace_back("Times are those of the clips that rows name, because there are frames.");
  if (columns.has(Role::clip_time) && !columns.clip_seconds)
    assumptions.emplace_back("Times of clips are in seconds; no unit is said.");
  if (!columns.has(Role::time)) return;
  layout.recording.clock = Clock::times;
  if (!columns.seconds) assumptions.emplace_back("Times are in seconds; no unit is said.");
  layout.seconds = columns.seconds.value_or(1);
}

class LayoutFinder {
 public:
  LayoutFinder(const Places& places, LineReader& lines, const TrajectoryOptions& options)
      : places_(places), lines_(lines), options_(options) {}

  TableLayout find() {
    skip_comments();
    layout_.separator = separator_of(line_);
    if (is_row(line_))
      without_header();
    else
      with_header();
    settle_units();
    return std::move(layout_);
  }

 private:
  const Places& places_;
  LineReader& lines_;
  const TrajectoryOptions& options_;
  CommentHeader comments_;
  TableLayout layout_;
  std::string_view line_;
  FirstRows rows_;
  bool needs_unit_ = false;

  /// Returns whether a line is a row, not a header: its first field is a number, or that of x where the columns are given.
  bool is_row(std::string_view line) const {
    std::size_t judged = 0;
    if (options_.columns) {
      const std::vector<ColumnName> names = column_names(*options_.columns, '#');
      const auto x = std::find_if(names.begin(), names.end(),
                                  [](const ColumnName& column) { return role_of(column.name) == Role::x; });
      if (x != names.end()) judged = static_cast<std::size_t>(x - names.begin());
    }
    const std::vector<std::string_view> fields = fields_of(line, layout_.separator);
    return judged < fields.size() && number_from(fields[judged]).has_value();
  }

  /// Goes to the first line that is no comment and not empty.
  void skip_comments() {
    while (lines_.next(line_)) {
      if (is_comment(line_))
        comments_.read(places_, lines_.number(), line_);
      else if (!trimmed(line_).empty())
        return;
    }
    places_.reject(lines_.number() == 0 ? "is empty" : "has no rows");
  }

  void set_columns(std::span<const ColumnName> names, std::uint64_t line) {
    layout_.columns = columns_of(places_, line, names, options_.unit.has_value());
  }

  void with_header() {
    const bool is_csv = layout_.separator != ' ';
    const std::uint64_t line = lines_.number();
    std::vector<ColumnName> names = column_names(options_.columns ? *options_.columns : std::string(line_),
                                                 options_.columns ? '#' : layout_.separator);
    if (!options_.columns && !is_csv &&
        std::none_of(names.begin(), names.end(),
                     [](const ColumnName& column) { return role_of(column.name) != Role::none; }))
      places_.reject(line, shown(line_) + " is neither a row of numbers nor a header");
    layout_.recording.format = is_csv ? "CSV" : "text with a header";
    layout_.has_all_columns = is_csv;
    const bool is_pathfinder = take_units(names);
    set_columns(names, line);
    if (!is_csv && !options_.columns) report_differing_names(line, names.size());
    if (is_pathfinder) {
      layout_.recording.format = "Pathfinder CSV";
      for (Role& role : layout_.columns.roles)  // z is the floor's
        if (role == Role::height) role = Role::none;
    }
    layout_.recording.rate = comments_.fps;
  }

  /// Reads the line below a header, of rows or of units.
  /// Returns: whether it was one of units.
  bool take_units(std::vector<ColumnName>& names) {
    std::string_view below;
    do
      if (!lines_.next(below)) places_.reject("has no rows");
    while (trimmed(below).empty() || is_comment(below));
    layout_.first_line = lines_.number();
    const std::vector<std::string_view> units = fields_of(below, layout_.separator);
    rows_.add(lines_.number(), units);
    if (units.size() != names.size() || std::any_of(units.begin(), units.end(), [](std::string_view field) {
          return number_from(field).has_value();
        }))
      return false;
    ++layout_.first_line;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i].unit.empty()) names[i].unit = lower_case(units[i]);
    return true;
  }

  void without_header() {
    layout_.first_line = lines_.number();
    layout_.recording.rate = comments_.fps;
    read_first_rows();
    layout_.recording.format = comments_.any ? "PeTrack text" : "text without a header";
    const bool are_named = options_.columns || !comments_.names.empty();
    std::vector<ColumnName> names = comments_.names;
    std::uint64_t line = comments_.names_line;
    if (options_.columns || !are_named) {
      names = column_names(options_.columns ? std::string_view(*options_.columns) : columns_of_rows(), '#');
      line = layout_.first_line;
    }
    const std::size_t named = names.size(), columns = rows_.columns();
    if (named > columns) names.resize(columns);
    set_columns(names, line);
    if (!are_named)
      layout_.recording.assumptions.push_back(
          "Columns are taken for " + listed(names) +
          ", which the file does not name: " + rows_.read_as(layout_.columns) + ".");
    else if (!options_.columns)
      report_differing_names(line, named);
    const bool is_eth =
        (!comments_.any || !are_named) && columns == 4 && layout_.columns.roles.front() == Role::frame;
    if (is_eth) layout_.recording.format = "ETH/UCY columns";
    needs_unit_ = !comments_.any && !is_eth;
  }

  void read_first_rows() {
    for (std::size_t row = 0; row < FirstRows::most; ++row) {
      if (!is_comment(line_) && !trimmed(line_).empty())
        rows_.add(lines_.number(), fields_of(line_, layout_.separator));
      if (!lines_.next(line_)) return;
    }
  }

  static std::string listed(std::span<const ColumnName> names) {
    std::string text;
    for (const ColumnName& column : names) text += (text.empty() ? "" : ", ") + column.name;
    return text;
  }

  void report_differing_names(std::uint64_t line, std::size_t named) {
    if (named == rows_.columns()) return;
    layout_.recording.assumptions.push_back(
        "Line " + std::to_string(line) + " names " + std::to_string(named) + " columns and rows have " +
        std::to_string(rows_.columns()) +
        ", which are taken in that order: " + rows_.read_as(layout_.columns) + ".");
  }

  [[noreturn]] void require_columns(const char* such_as) const {
    places_.reject(layout_.first_line,
                   "has " + std::to_string(rows_.columns()) +
                       " columns without names: --columns has to name them in order, such as " + such_as +
                       "; the first rows are " + rows_.shown());
  }

  /// Says what columns without names are, as far as rows show that. Ids are first where they do not and a comment has the frame rate:
  /// such text is Juelich's.
  std::string_view columns_of_rows() const {
    const std::size_t columns = rows_.columns();
    if (layout_.separator == ' ' && columns < 4) return juelich_columns;  // of which y lacks
    const bool are_known = layout_.separator == ' ' && columns <= 5 && rows_.have_places();
    if (!are_known) require_columns("id,frame,x,y or frame,id,x,skip,y");
    ColumnOrder order = rows_.order_by_distances();
    if (order == ColumnOrder::unclear && columns == 4 && !comments_.fps) order = rows_.order_by_steps();
    // Speeds are not known before unit and rate are, which are asked for then.
    const double speed = options_.unit.value_or(0) * options_.fps.value_or(0);
    const bool is_juelich = comments_.fps || (columns == 5 && rows_.may_be_one_person(speed));
    if (order == ColumnOrder::unclear && is_juelich) order = ColumnOrder::id_first;
    if (order == ColumnOrder::unclear || rows_.has_other_in_fifth(order))
      require_columns(columns == 4 ? "id,frame,x,y or frame,id,x,y"
                                   : "id,frame,x,y,z or frame,id,x,y,z or frame,id,x,skip,y");
    return order == ColumnOrder::id_first ? juelich_columns : eth_columns;
  }

  void settle_units() {
    const bool is_known = options_.unit || layout_.columns.metres || comments_.metres;
    if (!is_known && needs_unit_)
      places_.reject(
          options_.fps
              ? "says no unit: --unit has to give its metres, such as 0.01 for cm"
              : "says no unit and no frame rate: --unit has to give its metres, such as 0.01 for cm, and "
                "--fps the frame numbers a second");
    take_units_of_columns(layout_, options_, comments_.metres);
  }
};

}  // namespace

TableLayout layout_of_columns(const Places& places, std::span<const ColumnName> names,
                              const TrajectoryOptions& options) {
  TableLayout layout;
  layout.recording.format = "columns";
  layout.columns = columns_of(places, std::nullopt, names, options.unit.has_value());
  take_units_of_columns(layout, options, std::nullopt);
  return layout;
}

TableLayout table_layout(const Places& places, LineReader& lines, const TrajectoryOptions& options) {
  return LayoutFinder(places, lines, options).find();
}

}  // namespace bch::detail::trajectory
