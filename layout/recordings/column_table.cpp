// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cstring>
#include <utility>

#include "layout/recordings/row_values.hpp"
#include "layout/recordings/table.hpp"
#include "layout/recordings/table_layout.hpp"

namespace bch::detail::trajectory {
namespace {

std::vector<ColumnName> names_of(std::span<const ColumnView> columns) {
  std::vector<ColumnName> names;
  for (const ColumnView& column : columns) names.push_back(column_name(column.name));
  return names;
}

template <class Value>
Value value_at(const ColumnView& column, std::size_t row) {
  Value value;
  std::memcpy(&value, static_cast<const char*>(column.values) + row * column.stride, sizeof(value));
  return value;
}

class ColumnTable final : public RowSource {
 public:
  ColumnTable(std::vector<ColumnView> columns, std::size_t rows, const TrajectoryOptions& options)
      : columns_(std::move(columns)), rows_(rows) {
    if (options.columns) places_.reject("has columns with names; --columns is for files");
    layout_ = layout_of_columns(places_, names_of(columns_), options);
    if (rows > 0) require_values();
  }

  const Places& places() const override { return places_; }

  Recording recording() const override {
    Recording all = layout_.recording;
    values_.describe(all);
    return all;
  }

  std::size_t read(std::span<Row> rows) override {
    const std::size_t count = std::min(rows.size(), rows_ - next_);
    for (Row& row : rows.first(count)) {
      values_.begin(row, next_);
      for (std::size_t i = 0; i < layout_.columns.needed; ++i)
        if (layout_.columns.roles[i] != Role::none) take(row, i);
      values_.end(row);
      ++next_;
    }
    return count;
  }

  void rewind() override { next_ = 0; }

 private:
  const Places places_{table_in_memory, false};
  const std::vector<ColumnView> columns_;
  const std::size_t rows_;
  TableLayout layout_;
  RowValues values_{places_, layout_};
  std::size_t next_ = 0;

  void require_values() const {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Role role = layout_.columns.roles[i];
      if (role == Role::none || columns_[i].values != nullptr) continue;
      const bool is_name = role == Role::character || role == Role::clip || role == Role::body;
      places_.reject("column " + shown(layout_.columns.names[i]) + " does not have a " +
                     (is_name ? "text" : "number") + " in every row");
    }
  }

  void take(Row& row, std::size_t i) {
    const ColumnView& column = columns_[i];
    switch (column.type) {
      case ColumnView::Type::float64:
        return values_.take(row, i, value_at<double>(column, next_));
      case ColumnView::Type::float32:
        return values_.take(row, i, static_cast<double>(value_at<float>(column, next_)));
      case ColumnView::Type::int64:
        return values_.take(row, i, value_at<std::int64_t>(column, next_));
      case ColumnView::Type::int32:
        return values_.take(row, i, std::int64_t{value_at<std::int32_t>(column, next_)});
      case ColumnView::Type::text: {
        const char* const text = value_at<const char*>(column, next_);
        return values_.take(row, i, text == nullptr ? std::string_view() : std::string_view(text));
      }
    }
  }
};

}  // namespace

std::unique_ptr<RowSource> open_column_table(std::vector<ColumnView> columns, std::size_t rows,
                                             const TrajectoryOptions& options) {
  return std::make_unique<ColumnTable>(std::move(columns), rows, options);
}

}  // namespace bch::detail::trajectory
