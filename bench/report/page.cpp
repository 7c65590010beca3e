// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>

#include "bench/base/exit_codes.hpp"
#include "bench/base/number.hpp"
#include "bench/base/output.hpp"
#include "bench/report/chart.hpp"
#include "bench/report/embedded.hpp"
#include "bench/report/paper_findings.hpp"
#include "bench/report/report.hpp"
#include "bench/report/words.hpp"

namespace bch::report {
namespace {

namespace fs = std::filesystem;

/// The tables of a folder, each read when it is first asked for.
class Folder {
 public:
  explicit Folder(fs::path path) : path_(std::move(path)) {}

  const fs::path& path() const { return path_; }
  bool has(std::string_view name) const { return fs::exists(file(name)); }
  const Table& operator()(std::string_view name) {
    const auto found = tables_.find(name);
    if (found != tables_.end()) return found->second;
    return tables_.emplace(std::string(name), read_table(file(name))).first->second;
  }

 private:
  fs::path file(std::string_view name) const { return path_ / (std::string(name) + ".csv"); }

  fs::path path_;
  std::map<std::string, Table, std::less<>> tables_;
};

bool has_numbers(const Table& table, std::size_t column) {
  return std::any_of(table.rows().begin(), table.rows().end(),
                     [&](const auto& row) { return cli::parse_number(row[column]).has_value(); });
}

std::string html_of(const Table& table, std::string_view name) {
  // What is told of a run is shown as it is, since a commit may read as a number, such as 16e6464.
  const bool measured = name != "run";
  std::string html =
      fmt::format("<div class=\"wide\"><table id=\"{0}\"><caption>{0}.csv</caption>\n<thead><tr>", name);
  std::vector<const char*> kinds;  // of columns: numbers are on the right, with a word among them
  for (std::size_t column = 0; column < table.columns().size(); ++column) {
    kinds.push_back(measured && has_numbers(table, column) ? " class=\"number\"" : "");
    html += fmt::format("<th{}>{}</th>", kinds[column], escaped(table.columns()[column]));
  }
  html += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows()) {
    html += "<tr>";
    for (std::size_t column = 0; column < row.size(); ++column)
      html +=
          fmt::format("<td{}>{}</td>", kinds[column], measured ? shown(row[column]) : escaped(row[column]));
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

/// Returns the condition that "COLUMN=TEXT" in a tag is.
Table::Where where_of(std::string_view part) {
  const std::size_t equals = part.find('=');
  return {part.substr(0, equals), part.substr(equals + 1)};
}

/// The cell that a tag names: see Page.
std::string cell(const Results& results, std::string_view tag) {
  std::vector<std::string_view> parts(1, tag);
  for (std::size_t at; (at = parts.back().find(" | ")) != std::string_view::npos;) {
    parts.push_back(parts.back().substr(at + 3));
    parts[parts.size() - 2].remove_suffix(parts.back().size() + 3);
  }
  const Table& table = results(parts.front());
  std::vector<Table::Where> where;
  for (std::size_t i = 1; i + 1 < parts.size(); ++i) {
    const auto [column, text] = where_of(parts[i]);
    where.push_back({column, text == "first"  ? table.text(0, column)
                             : text == "last" ? table.text(table.rows().size() - 1, column)
                                              : text});
  }
  return table.text(table.row(where), parts.back());
}

/// What a tag says of a cell, or of two that differ in "A / B".
std::string shown_cell(const Results& results, std::string_view tag) {
  const std::size_t slash = tag.find(" / ");
  if (slash == std::string_view::npos) {
    const std::string text = cell(results, tag);
    return text.empty() ? "–" : shown(text);
  }
  const std::size_t before = tag.find_last_of("=|", slash), begin = before + (tag[before] == '=' ? 1 : 2);
  const std::size_t end = std::min(tag.find(" | ", slash), tag.size());
  const auto number = [&](const std::string& one) {
    return cli::parse_number(cell(results, one)).value_or(std::numeric_limits<double>::quiet_NaN());
  };
  return brief(number(fmt::format("{}{}", tag.substr(0, slash), tag.substr(end))) /
               number(fmt::format("{}{}", tag.substr(0, begin), tag.substr(slash + 3))));
}

/// Fills a template in, whose tags mean:
///   {{TABLE | COLUMN=TEXT | ... | COLUMN}}  the cell of the first row with these texts, `first` and `last`
///                                           being those at the column's ends; with "A / B" in a part, the
///                                           quotient of two cells
///   {{table: NAME}}, {{chart: NAME}}        a whole table; the picture that NAME.gp draws
///   {{title: EXPERIMENT}}                   its title
///   {{NAME}}, {{NAME: OF}}                  what is Computed
///   {{#NAME}} ... {{/NAME}}                 shown where there is a table, or gnuplot, of this name; with
///                                           " | COLUMN=TEXT", where it has such a row
///   {{^NAME}} ... {{/NAME}}                 shown where there is none
class Page {
 public:
  explicit Page(Folder& folder) : folder_(folder) {}

  std::string filled(std::string_view text) {
    std::string html;
    std::vector<bool> visible{true};  // the sections around the place
    for (;;) {
      const std::size_t begin = text.find("{{");
      if (visible.back()) html += text.substr(0, begin);
      if (begin == std::string_view::npos) return html;
      const std::size_t end = text.find("}}", begin);
      const std::string_view tag = text.substr(begin + 2, end - begin - 2);
      text.remove_prefix(end + 2);
      if (tag[0] == '#' || tag[0] == '^')
        visible.push_back(visible.back() && has(tag.substr(1)) == (tag[0] == '#'));
      else if (tag[0] == '/')
        visible.pop_back();
      else if (visible.back())
        html += value(tag);
    }
  }

 private:
  bool has(std::string_view name) const {
    const std::size_t bar = name.find(" | ");
    if (bar == std::string_view::npos) return name == "gnuplot" ? pictures_ : folder_.has(name);
    const Table& table = folder_(name.substr(0, bar));
    const Table::Where where = where_of(name.substr(bar + 3));
    return table.find({&where, 1}) < table.rows().size();
  }

  std::string value(std::string_view tag) {
    const Results results = [this](std::string_view name) -> const Table& { return folder_(name); };
    if (tag.find(" | ") != std::string_view::npos) return shown_cell(results, tag);
    const std::size_t colon = std::min(tag.find(": "), tag.size());
    const std::string_view name = tag.substr(0, colon), of = tag.substr(std::min(colon + 2, tag.size()));
    if (name == "table") return html_of(folder_(of), of);
    if (name == "chart") return chart(std::string(of));
    for (const Experiment& experiment : experiments()) {
      if (name == "title" && experiment.name == of) return escaped(experiment.title);
      for (const Computed& one : experiment.computed)
        if (one.name == name) return one.text(results, of);
    }
    for (const Computed& one : paper_findings())
      if (one.name == name) return one.text(results, of);
    throw std::logic_error("the page's template asks for " + std::string(tag));
  }

  std::string chart(const std::string& name) const {
    const std::string svg = draw(folder_.path(), name) ? embedded_picture(folder_.path(), name) : "";
    return svg.empty() ? "<p>gnuplot could not draw this.</p>" : svg;
  }

  Folder& folder_;
  const bool pictures_ = can_draw();
};

}  // namespace

void make_page(const fs::path& path) try {
  Folder folder(path);
  folder("run");
  cli::write_file(path / "report.html", Page(folder).filled(page_template()));
} catch (const std::out_of_range& error) {
  throw cli::InputError(path.string() + ": tables of another version: " + error.what());
}

}  // namespace bch::report
