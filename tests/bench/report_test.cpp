// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "bench/base/exit_codes.hpp"
#include "bench/report/subject.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/program_run.hpp"
#include "tests/support/temporary_folder.hpp"

// The experiments at their smallest: the page has what the tables have, and what is not a time is the same again.

namespace bch::report {
namespace {

constexpr Sizes smallest{2, 60, 80, 6, 1, 10, 1, 4, 0.1};

void run_into(const TemporaryFolder& folder) {
  Options options;
  options.folder = folder.path();
  options.sizes = smallest;
  options.command = "bch report --out \"here\" & there";
  run_report(options);
}

/// The cells of the rows of a page's table, markup taken away.
std::vector<std::vector<std::string>> rows_of(const std::string& page, const std::string& name) {
  const auto between = [](const std::string& text, std::size_t& at, const std::string& open,
                          const std::string& close) {
    const std::size_t begin = text.find(open, at);
    if (begin == std::string::npos) return at = begin, std::string();
    const std::size_t inside = text.find('>', begin) + 1, end = text.find(close, inside);
    at = end + close.size();
    return text.substr(inside, end - inside);
  };
  std::size_t at = page.find("<table id=\"" + name + "\">");
  EXPECT_NE(at, std::string::npos) << name;
  if (at == std::string::npos) return {};
  const std::string table = page.substr(at, page.find("</table>", at) - at);
  std::vector<std::vector<std::string>> rows;
  at = table.find("<tbody>");
  for (std::string row = between(table, at, "<tr", "</tr>"); at != std::string::npos;
       row = between(table, at, "<tr", "</tr>")) {
    auto& cells = rows.emplace_back();
    std::size_t in_row = 0;
    for (std::string cell = between(row, in_row, "<td", "</td>"); in_row != std::string::npos;
         cell = between(row, in_row, "<td", "</td>"))
      cells.push_back(cell);
  }
  return rows;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

void expect_shows_words(const std::string& shown, const std::string& cell) {
  EXPECT_EQ(replaced(replaced(shown, "&amp;", "&"), "&quot;", "\""), cell);
}

/// A number of the page stands for that of the table in three digits.
void expect_shows(const std::string& shown, const std::string& cell) {
  char* end = nullptr;
  const double number = std::strtod(cell.c_str(), &end);
  if (cell.empty() || *end != '\0') return expect_shows_words(shown, cell);
  EXPECT_NEAR(std::stod(replaced(shown, " ", "")), number, 0.0051 * std::abs(number) + 1e-300) << shown;
}

void expect_shows_table(const std::string& page, const TemporaryFolder& folder, const std::string& name) {
  SCOPED_TRACE(name);
  const auto expect = name == "run" ? expect_shows_words : expect_shows;
  const Table table = read_table(folder.file(name + ".csv"));
  const auto rows = rows_of(page, name);
  ASSERT_EQ(rows.size(), table.rows().size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), table.columns().size());
    for (std::size_t k = 0; k < rows[i].size(); ++k) expect(rows[i][k], table.rows()[i][k]);
  }
}

void expect_page_shows_tables(const TemporaryFolder& folder) {
  const std::string page = test::read_text(folder.file("report.html")), id = "<table id=\"";
  std::size_t tables = 0;
  for (std::size_t at = 0; (at = page.find(id, at)) != std::string::npos; ++tables) {
    at += id.size();
    expect_shows_table(page, folder, page.substr(at, page.find('"', at) - at));
  }
  EXPECT_EQ(tables, 26u);  // all but that of real characters, which are not there for all who run this
}

/// Whether a column holds times, which differ from run to run, or what was chosen by them.
bool is_time(const std::string& column) {
  for (const char* word : {"(ns", "ns/pair", "(us)", "(25 %)", "(75 %)"})
    if (column.find(word) != std::string::npos) return true;
  return false;
}

void expect_same_but_times(const TemporaryFolder& a, const TemporaryFolder& b) {
  std::size_t compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(a.path())) {
    const std::string file = entry.path().filename();
    const bool front = file == "error_time_distance.csv" || file == "error_time_false.csv" ||
                       file == "error_time_excess.csv";
    if (entry.path().extension() != ".csv" || file == "run.csv" || front) continue;
    SCOPED_TRACE(file);
    const Table one = read_table(a.file(file)), other = read_table(b.file(file));
    ASSERT_EQ(one.columns(), other.columns());
    ASSERT_EQ(one.rows().size(), other.rows().size());
    for (std::size_t i = 0; i < one.rows().size(); ++i)
      for (const std::string& column : one.columns()) {
        if (is_time(column)) continue;
        EXPECT_EQ(one.text(i, column), other.text(i, column)) << column;
        ++compared;
      }
  }
  EXPECT_GT(compared, 1000u);
}

/// The paper leaves cases that are repeated one by one out of its results.
void expect_paper_times_beside_its_protocol_alone(const Table& times) {
  std::size_t told = 0;
  for (std::size_t i = 0; i < times.rows().size(); ++i) {
    if (times.text(i, "paper (ns/pair)").empty()) continue;
    EXPECT_EQ(times.text(i, "pairs"), "paper500");
    ++told;
  }
  EXPECT_EQ(told, 3u);
}

/// Each slab has a hierarchy of its own, so that more slabs have more nodes and take longer.
void expect_slabs_are_built_for_their_price(const Table& construction) {
  const auto of = [&](const std::string& structure, const char* column) {
    return construction.number({{"structure", structure}}, column);
  };
  const std::string whole = "BCH whole body";
  EXPECT_EQ(of(whole, "nodes a shape"), of("BCH outline", "nodes a shape"));
  EXPECT_GT(of(whole, "median (us)"), of("BCH outline", "median (us)"));  // the outline is made, too
  double nodes = of(whole, "nodes a shape");
  for (const std::uint32_t slabs : compared_slabs) {
    const std::string name = slabs_name(slabs, Leaves::segments);
    EXPECT_GT(of(name, "nodes a shape"), nodes) << name;
    EXPECT_EQ(construction.text(construction.row({{"structure", name}}), "made from"), "vertices");
    nodes = of(name, "nodes a shape");
  }
  EXPECT_GT(of(slabs_name(8, Leaves::segments), "median (us)"), of(whole, "median (us)"));
}

TEST(Report, PageShowsTablesAndTablesAreTheSameAgain) {
  const TemporaryFolder first, second;
  run_into(first);
  run_into(second);
  expect_page_shows_tables(first);
  expect_same_but_times(first, second);
  expect_paper_times_beside_its_protocol_alone(read_table(first.file("query_time.csv")));
  expect_slabs_are_built_for_their_price(read_table(first.file("construction.csv")));
  const auto json = nlohmann::json::parse(test::read_text(first.file("volume.json")));
  EXPECT_EQ(json["run"]["seed"], "1");
  EXPECT_EQ(json["run"]["command"], "bch report --out \"here\" & there");
  EXPECT_EQ(json["tables"]["volume_paper"].size(), 12u);  // four rows of each of three people

  // Sentences come from the tables as well.
  const Table volumes = read_table(first.file("volume_paper.csv"));
  Table changed(volumes.columns());
  for (const auto& row : volumes.rows()) {
    std::vector<Cell> cells(row.begin(), row.end());
    cells[volumes.column("mean")] = 7.654;
    changed.add(cells);
  }
  first.write("volume_paper.csv", csv_of(changed));
  make_page(first.path());
  expect_page_shows_tables(first);
  EXPECT_NE(test::read_text(first.file("report.html")).find("radius is\n7.65\n(0.42) m on average"),
            std::string::npos);
}

TEST(Report, RealCharactersAreSaidToBeMissing) {
  const TemporaryFolder folder;
  Options options;
  options.folder = folder.path();
  options.sizes = smallest;
  options.experiments = {"real"};
  run_report(options);
  EXPECT_FALSE(std::filesystem::exists(folder.file("real.csv")));
  EXPECT_NE(test::read_text(folder.file("report.html")).find("Not in this run: it needs real characters"),
            std::string::npos);
}

TEST(Report, RealCharactersAreMeasured) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real characters to measure";
  const TemporaryFolder folder;
  Options options;
  options.folder = folder.path();
  options.sizes = smallest;
  options.experiments = {"real"};
  options.real_characters = *data / "characters";
  run_report(options);
  expect_shows_table(test::read_text(folder.file("report.html")), folder, "real");
  const Table real = read_table(folder.file("real.csv"));
  constexpr std::size_t rows = 5 + 2 * std::size(compared_slabs);  // of a character
  ASSERT_GE(real.rows().size(), 5 * rows);
  for (std::size_t i = 0; i < real.rows().size(); i += rows) {
    SCOPED_TRACE(real.text(i, "character"));
    EXPECT_EQ(real.text(i, "structure"), "single cylinder");
    const auto mean = [&, name = real.text(i, "character")](std::string_view structure) {
      return real.number({{"character", name}, {"structure", structure}}, "mean (cm)");
    };
    const double single = mean("single cylinder"), leaves = mean("BCH outline to depth all");
    EXPECT_LT(leaves, single);
    EXPECT_LT(mean("OBB outline"), single);
    for (const std::uint32_t slabs : compared_slabs) {
      const double discs = mean(slabs_name(slabs, Leaves::discs));
      EXPECT_LE(discs, leaves) << slabs;
      EXPECT_LE(mean(slabs_name(slabs, Leaves::segments)), discs) << slabs;
    }
  }
}

/// Tighter bodies overlap less, and take longer than a disc.
TEST(Report, RecordedPeopleOverlapLessTheTighterTheirBodies) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no recordings to check";
  const TemporaryFolder folder;
  Options options;
  options.folder = folder.path();
  options.sizes = smallest;
  options.sizes.rows = 3'000;
  options.experiments = {"recordings"};
  options.recordings = *data / "trajectories";
  run_report(options);
  expect_shows_table(test::read_text(folder.file("report.html")), folder, "recordings");
  const Table table = read_table(folder.file("recordings.csv"));
  double before = 100;
  for (const char* const bodies :
       {"single cylinder of the pose", "depth 3", "depth 6", "all depths", "segments", "4 slabs"}) {
    const double share = table.number({{"structure", bodies}}, "in overlap (% of neighbours)");
    EXPECT_LE(share, before) << bodies;
    EXPECT_GT(table.number({{"structure", bodies}}, "ns/pair"), 0) << bodies;
    before = share;
  }
  EXPECT_GT(table.number({{"structure", "fixed cylinder 0.40 m"}}, "in overlap (% of neighbours)"), before);
}

/// Discs of a radius above all bodies hide nothing, those of hardly any all.
TEST(Report, SmallDiscsHideOverlapsOfBodies) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no recordings to check";
  const auto table_of = [&](double radius) {
    const TemporaryFolder folder;
    Options options;
    options.folder = folder.path();
    options.sizes = smallest;
    options.sizes.rows = 3'000;
    options.sizes.disc_radius = radius;
    options.experiments = {"simulated"};
    options.recordings = *data / "trajectories";
    run_report(options);
    expect_shows_table(test::read_text(folder.file("report.html")), folder, "simulated");
    return read_table(folder.file("simulated.csv"));
  };
  const Table small = table_of(0.001), usual = table_of(0.2), large = table_of(0.6);
  ASSERT_EQ(usual.rows().size(), 2u);  // a recording in two kinds of bodies
  for (std::size_t i = 0; i < 2; ++i) {
    SCOPED_TRACE(usual.text(i, "structure"));
    const auto share = [i](const Table& table, const char* what) {
      return table.number(i, std::string(what) + " (% of neighbours)");
    };
    const auto overlapping = [&](const Table& table) {
      return share(table, "both overlap") + share(table, "bodies alone");
    };
    EXPECT_EQ(share(small, "both overlap"), 0);
    EXPECT_EQ(share(small, "discs alone"), 0);
    EXPECT_NEAR(overlapping(small), overlapping(usual), 1e-9);
    EXPECT_NEAR(overlapping(large), overlapping(usual), 1e-9);
    EXPECT_EQ(share(large, "bodies alone"), 0);
    EXPECT_NEAR(share(large, "discs alone") + share(large, "both overlap"), 100, 1e-9);
    EXPECT_GE(small.number(i, "deepest while discs are clear (cm)"),
              usual.number(i, "deepest while discs are clear (cm)"));
    EXPECT_EQ(large.number(i, "deepest while discs are clear (cm)"), 0);
  }
}

TEST(Report, ExperimentsHaveNamesAndSectionsOfTheirOwn) {
  std::set<std::string_view> names;
  const TemporaryFolder folder;
  folder.write("run.csv", "what,value\ncommand,none\n");
  make_page(folder.path());
  const std::string page = test::read_text(folder.file("report.html"));
  for (const Experiment& experiment : experiments()) {
    SCOPED_TRACE(experiment.name);
    EXPECT_TRUE(names.insert(experiment.name).second);
    const std::string id = "experiment-" + std::string(experiment.name);
    EXPECT_NE(page.find("<a href=\"#" + id + "\">" + std::string(experiment.title) + "</a>"),
              std::string::npos);
    EXPECT_NE(page.find("<section id=\"" + id + "\">"), std::string::npos);
  }
}

TEST(Report, FactsOfARunStandAsTheyAre) {
  // Commits that read as numbers, in as many digits as a page shows of none.
  for (const std::string commit : {"1234567", "16e6464", "12e3456", "0012e34"}) {
    const TemporaryFolder folder;
    folder.write("run.csv",
                 "what,value\ncommand,bch report --poses=10000\nposes,10000\ncommit," + commit + "\n");
    make_page(folder.path());
    expect_shows_table(test::read_text(folder.file("report.html")), folder, "run");
  }
}

TEST(Report, FindingsOfThePaperHaveAVerdictFromTables) {
  const auto page = [](const std::string& table) {
    const TemporaryFolder folder;
    folder.write("run.csv", "what,value\ncommand,none\n");
    if (!table.empty()) folder.write("depth_critical.csv", table);
    make_page(folder.path());
    return test::read_text(folder.file("report.html"));
  };
  const std::string table = "structure,critical depth\nBCH outline in the batch kernel,";
  EXPECT_EQ(page("").find("From depth 9"), std::string::npos);
  EXPECT_NE(page("").find("<b>Tried, and not kept.</b>"), std::string::npos);  // needs no table
  EXPECT_NE(page(table + "9\n").find("<b>Reproduced.</b> It is\n9."), std::string::npos);
  EXPECT_NE(page(table + "12\n").find("<b>Reversed.</b> It is\n12."), std::string::npos);
}

TEST(Report, PageOfAFolderWithoutTablesSaysSo) {
  const TemporaryFolder folder;
  EXPECT_THROW(make_page(folder.path()), cli::InputError);
  folder.write("run.csv", "what,value\ncommand,none\n");
  make_page(folder.path());
  EXPECT_NE(test::read_text(folder.file("report.html")).find("Not in this run."), std::string::npos);
  folder.write("volume_paper.csv", "character,mean\nsomebody,1\n");
  EXPECT_THROW(make_page(folder.path()), cli::InputError);
  folder.write("volume_paper.csv", "character,mean\nsomebody\n");
  EXPECT_THROW(make_page(folder.path()), cli::InputError);
}

}  // namespace
}  // namespace bch::report
