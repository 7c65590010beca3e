// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <concepts>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bch::report {

/// Holds a text, or a number in as many digits as tell it from every other double; NaN is an empty cell.
struct Cell {
  std::string text;

  Cell(std::string words) : text(std::move(words)) {}
  Cell(std::string_view words) : text(words) {}
  Cell(const char* words) : text(words) {}
  Cell(double number);
  template <std::integral Integer>
  Cell(Integer number) : text(std::to_string(number)) {}
};

constexpr double empty_cell = std::numeric_limits<double>::quiet_NaN();

/// Holds the content of a CSV file: the only way from an experiment to the page. Columns of numbers name
/// their unit.
class Table {
 public:
  /// Makes an empty table. `name` is what errors call it.
  explicit Table(std::vector<std::string> columns, std::string name = "the table")
      : columns_(std::move(columns)), name_(std::move(name)) {}

  /// Adds a row. Shapes: as many cells as columns, else throws std::logic_error.
  void add(std::initializer_list<Cell> cells) { add(std::vector<Cell>(cells)); }
  void add(const std::vector<Cell>& cells);

  const std::vector<std::string>& columns() const { return columns_; }
  const std::vector<std::vector<std::string>>& rows() const { return rows_; }

  /// Errors of all: throw std::out_of_range naming the table and the row, the column or the value that there is not.
  std::size_t column(std::string_view name) const;
  const std::string& text(std::size_t row, std::string_view column) const;
  /// Returns a number; NaN for an empty cell.
  double number(std::size_t row, std::string_view column) const;
  /// Selects the first row that has these texts in these columns.
  struct Where {
    std::string_view column, text;
  };
  std::size_t row(std::span<const Where> where) const;
  /// Returns the number of that row; where there is none, how many rows there are.
  std::size_t find(std::span<const Where> where) const;
  std::size_t row(std::initializer_list<Where> where) const { return row(std::span(where)); }
  double number(std::initializer_list<Where> where, std::string_view column) const {
    return number(row(where), column);
  }

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
  std::string name_;
};

std::string csv_of(const Table& table);
/// Returns the rows as objects: numbers, texts, and null for an empty cell.
nlohmann::ordered_json json_of(const Table& table);

/// Reads a table from a CSV file.
/// Errors:  throws cli::InputError naming the file, and the line of a row that is shorter or longer than the
///          header.
Table read_table(const std::filesystem::path& file);

}  // namespace bch::report
