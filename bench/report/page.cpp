// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bench/base/exit_codes.hpp"
#include "bench/base/number.hpp"
#include "bench/base/output.hpp"
#include "bench/report/chart.hpp"
#include "bench/report/page_style.hpp"
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
  const Table& table(std::string_view name) {
    const auto found = tables_.find(name);
    if (found != tables_.end()) return found->second;
    return tables_.emplace(std::string(name), read_table(file(name))).first->second;
  }

 private:
  fs::path file(std::string_view name) const { return path_ / (std::string(name) + ".csv"); }

  fs::path path_;
  std::map<std::string, Table, std::less<>> tables_;
};

bool is_number(std::string_view cell) {
  return cli::parse_number(cell).has_value();
}

bool has_numbers(const Table& table, std::size_t column) {
  return std::any_of(table.rows().begin(), table.rows().end(),
                     [&](const auto& row) { return is_number(row[column]); });
}

/// The content of cells: measurements, or words, which are shown as they are, since a commit may read as a
/// number, such as 16e6464.
enum class Cells { measured, words };

std::string html_of(const Table& table, std::string_view name, Cells cells = Cells::measured) {
  const bool measured = cells == Cells::measured;
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

std::string figure(Folder& folder, const Chart& chart) {
  const auto svg = draw(folder.path(), chart.name);
  return fmt::format("<figure id=\"figure-{}\">\n{}<figcaption>{}</figcaption></figure>\n", chart.name,
                     svg ? *svg : std::string("<p>gnuplot could not draw this.</p>"), escaped(chart.shows));
}

std::string section(Folder& folder, const Experiment& experiment, bool pictures) {
  std::string html = fmt::format("<section id=\"experiment-{}\">\n<h2>{}</h2>\n<p class=\"method\">{}</p>\n",
                                 experiment.name, escaped(experiment.title), experiment.method);
  if (!folder.has(experiment.tables.front()))
    return html +
           (!experiment.needs.empty()
                ? fmt::format("<p>Not in this run: {}, or was not asked for.</p>", experiment.needs)
            : experiment.needs_distances ? "<p>Not in this run: it needs distances of meshes, which FCL "
                                           "measures, or was not asked for.</p>"
                                         : std::string("<p>Not in this run.</p>")) +
           "</section>\n";
  html += experiment.findings([&](std::string_view name) -> const Table& { return folder.table(name); });
  if (pictures) {
    html += "<div class=\"figures\">\n";
    for (const Chart& chart : experiment.charts) html += figure(folder, chart);
    html += "</div>\n";
  }
  for (const std::string_view name : experiment.tables) html += html_of(folder.table(name), name);
  return html + "</section>\n";
}

std::string contents() {
  std::string html = "<nav><ol>\n<li><a href=\"#findings\">The paper's findings</a></li>\n";
  for (const Experiment& experiment : experiments())
    html += fmt::format("<li><a href=\"#experiment-{}\">{}</a></li>\n", experiment.name,
                        escaped(experiment.title));
  return html + "</ol></nav>\n";
}

std::string page_of(Folder& folder) {
  const Table& facts = folder.table("run");
  const bool pictures = can_draw();
  if (pictures) write_chart_scripts(folder.path());
  std::string html = std::string(page_head) + page_introduction;
  html += fmt::format("<pre>{}</pre>\n", escaped(facts.text(facts.row({{"what", "command"}}), "value")));
  if (!pictures) html += "<p>There is no gnuplot here, so that this page has tables and no charts.</p>\n";
  html += contents();
  html += paper_findings([&](std::string_view name) { return folder.has(name); },
                         [&](std::string_view name) -> const Table& { return folder.table(name); });
  for (const Experiment& experiment : experiments()) html += section(folder, experiment, pictures);
  return html + "<section id=\"run\">\n<h2>Run</h2>\n" + html_of(facts, "run", Cells::words) +
         "</section>\n</main></body></html>\n";
}

}  // namespace

void make_page(const fs::path& path) try {
  Folder folder(path);
  cli::write_file(path / "report.html", page_of(folder));
} catch (const std::out_of_range& error) {
  throw cli::InputError(path.string() + ": tables of another version: " + error.what());
}

}  // namespace bch::report
