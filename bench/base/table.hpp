// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "bench/base/csv_input.hpp"

namespace bch::bench {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Holds a text as CSV has it, or a number in as many digits as tell it from every other double; NaN is an empty cell.
struct Cell {
  std::string text;

  Cell(std::string_view words) : text(cli::csv_field(std::string(words))) {}
  Cell(const std::string& words) : Cell(std::string_view(words)) {}
  Cell(const char* words) : Cell(std::string_view(words)) {}
  Cell(double number) : text(std::isnan(number) ? std::string() : fmt::format("{}", number)) {}
  template <std::integral Integer>
  Cell(Integer number) : text(std::to_string(number)) {}
};

/// Builds a CSV file. Columns of numbers name their unit.
class Table {
 public:
  explicit Table(const std::vector<Cell>& columns) : columns_(columns.size()) { add(columns); }

  /// Adds a row. Shapes: as many cells as columns, else throws std::logic_error.
  void add(const std::vector<Cell>& cells) {
    if (cells.size() != columns_)
      throw std::logic_error(fmt::format("a table of {} columns got a row of {}", columns_, cells.size()));
    for (std::size_t i = 0; i < cells.size(); ++i) (csv_ += i > 0 ? "," : "") += cells[i].text;
    csv_ += '\n';
  }

  const std::string& csv() const { return csv_; }

 private:
  std::size_t columns_;
  std::string csv_;
};

}  // namespace bch::bench
