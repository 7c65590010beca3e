// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/base/csv_input.hpp"
#include "bench/base/exit_codes.hpp"
#include "bench/base/number.hpp"

namespace bch::report {
namespace {

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += ',';
    line += cli::csv_field(cells[i]);
  }
  line += '\n';
  return line;
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
      cells.back() += line[++i];
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += line[i];
  }
  return cells;
}

}  // namespace

Cell::Cell(double number) : text(std::isnan(number) ? std::string() : fmt::format("{}", number)) {}

void Table::add(const std::vector<Cell>& cells) {
  if (cells.size() != columns_.size())
    throw std::logic_error(fmt::format("{} cells for {} columns", cells.size(), columns_.size()));
  auto& row = rows_.emplace_back();
  for (const Cell& cell : cells) row.push_back(cell.text);
}

std::size_t Table::column(std::string_view name) const {
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (columns_[i] == name) return i;
  throw std::out_of_range(name_ + " has no column '" + std::string(name) + "'");
}

const std::string& Table::text(std::size_t row, std::string_view name) const {
  if (row >= rows_.size()) throw std::out_of_range(fmt::format("{} has no row {}", name_, row));
  return rows_[row][column(name)];
}

double Table::number(std::size_t row, std::string_view name) const {
  const std::string& cell = text(row, name);
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto value = cli::parse_number(cell);
  if (!value) throw std::out_of_range(fmt::format("{}: {} '{}' is not a number", name_, name, cell));
  return *value;
}

std::size_t Table::find(std::span<const Where> where) const {
  std::size_t i = 0;
  for (; i < rows_.size(); ++i) {
    bool all = true;
    for (const Where& one : where) all = all && text(i, one.column) == one.text;
    if (all) break;
  }
  return i;
}

std::size_t Table::row(std::span<const Where> where) const {
  const std::size_t found = find(where);
  if (found < rows_.size()) return found;
  std::string wanted;
  for (const Where& one : where) wanted += fmt::format(" {} '{}'", one.column, one.text);
  throw std::out_of_range(name_ + " has no row with" + wanted);
}

std::string csv_of(const Table& table) {
  std::string text = csv_line(table.columns());
  for (const auto& row : table.rows()) text += csv_line(row);
  return text;
}

nlohmann::ordered_json json_of(const Table& table) {
  using Json = nlohmann::ordered_json;
  Json rows = Json::array();
  for (const auto& cells : table.rows()) {
    Json& row = rows.emplace_back(Json::object());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Json number = Json::parse(cells[i], nullptr, false);
      row[table.columns()[i]] = number.is_number() ? number : cells[i].empty() ? Json() : Json(cells[i]);
    }
  }
  return rows;
}

Table read_table(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  if (!std::getline(stream, line)) throw cli::InputError(file.string() + ": cannot be read");
  Table table(split(line), file.filename().string());
  for (std::size_t number = 2; std::getline(stream, line); ++number) {
    const std::vector<std::string> cells = split(line);
    if (cells.size() != table.columns().size())
      throw cli::InputError(fmt::format("{}:{}: {} values for {} columns", file.string(), number,
                                        cells.size(), table.columns().size()));
    table.add(std::vector<Cell>(cells.begin(), cells.end()));
  }
  return table;
}

}  // namespace bch::report
