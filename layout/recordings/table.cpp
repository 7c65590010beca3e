// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/table.hpp"

#include "layout/recordings/fields.hpp"
#include "layout/recordings/row_values.hpp"
#include "layout/recordings/table_layout.hpp"

namespace bch::detail::trajectory {
namespace {

class Table final : public RowSource {
 public:
  Table(const std::filesystem::path& file, const TrajectoryOptions& options)
      : places_{file, true},
        lines_(places_),
        layout_(table_layout(places_, lines_, options)),
        values_(places_, layout_) {
    rewind();
  }

  const Places& places() const override { return places_; }

  Recording recording() const override {
    Recording all = layout_.recording;
    values_.describe(all);
    if (unended_ > 0)
      all.assumptions.push_back(
          "The last row, " + places_.row(unended_) +
          ", has no line end and is read as it stands; a file that was cut off looks so.");
    return all;
  }

  std::size_t read(std::span<Row> rows) override {
    std::size_t count = 0;
    for (std::string_view line; count < rows.size() && lines_.next(line);) {
      if (lines_.number() < layout_.first_line || line.empty() || is_comment(line)) continue;
      if (is_blank(line.front()) && trimmed(line).empty()) continue;
      values_.begin(rows[count], lines_.number());
      parse(line, rows[count]);
      if (!lines_.has_end()) unended_ = lines_.number();
      ++count;
    }
    return count;
  }

  void rewind() override { lines_.rewind(); }

 private:
  Places places_;
  LineReader lines_;
  TableLayout layout_;
  RowValues values_;
  std::uint64_t unended_ = 0;  ///< the number of the last row where no line end follows it

  [[noreturn]] void reject(const std::string& reason) const { places_.reject(lines_.number(), reason); }
  void parse(std::string_view line, Row& row) {
    Fields fields(line, layout_.separator);
    const std::size_t columns = layout_.columns.roles.size();
    const std::size_t wanted = layout_.has_all_columns ? columns : layout_.columns.needed;
    std::size_t column = 0;
    for (std::string_view field; column < wanted && fields.next(field); ++column)
      values_.take(row, column, field);
    std::string_view more;
    const bool has_more = layout_.has_all_columns && column == wanted && fields.next(more);
    if (fields.is_broken()) reject("a quote is not closed, or something follows it");
    if (column < wanted)
      reject("has " + std::to_string(column) + " values, not " + std::to_string(wanted) + ": " + shown(line));
    if (has_more) reject("has more values than the header has columns, the next is " + shown(more));
    values_.end(row);
  }
};

}  // namespace

std::unique_ptr<RowSource> open_table(const std::filesystem::path& file, const TrajectoryOptions& options) {
  return std::make_unique<Table>(file, options);
}

}  // namespace bch::detail::trajectory
