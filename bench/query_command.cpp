// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <tuple>
#include <unordered_map>

#include "bench/commands.hpp"
#include "bench/csv_input.hpp"
#include "bench/exit_codes.hpp"
#include "bench/options.hpp"
#include "bench/output.hpp"
#include "bench/shape_table.hpp"
#include "bench/threads.hpp"
#include "kernel/broad_phase.hpp"

namespace bch::cli {
namespace {

struct QueryCommandOptions {
  std::string character, agents, pairs;
  bool all_pairs = false;
  ShapeOptions shapes;
  AnswerOptions answer;
};

/// Renumbers the agents' shapes to those in use. Returns: where these come from; no other is built.
std::vector<ShapeSource> keep_used(std::span<const ShapeSource> sources, AgentTable& table) {
  std::vector<ShapeSource> used;
  std::unordered_map<std::uint32_t, std::uint32_t> index_of;
  for (std::uint32_t& shape : table.shape) {
    const auto [entry, added] = index_of.emplace(shape, static_cast<std::uint32_t>(used.size()));
    if (added) used.push_back(sources[shape]);
    shape = entry->second;
  }
  return used;
}

/// All pairs that can collide, in the order of the agents' lines.
std::vector<Pair> pairs_in_order(const ShapeSet& set, const Agents& agents) {
  std::vector<Pair> pairs = candidate_pairs(set, agents);
  std::sort(pairs.begin(), pairs.end(),
            [](Pair a, Pair b) { return std::tie(a.first, a.second) < std::tie(b.first, b.second); });
  return pairs;
}

std::string answers_csv(const AgentTable& table, std::span<const Pair> pairs,
                        std::span<const std::uint8_t> hits, bool hits_only) {
  std::string out = "first,second,hit\n";
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (hits_only && hits[i] == 0) continue;
    fmt::format_to(std::back_inserter(out), "{},{},{:d}\n", csv_field(table.id[pairs[i].first]),
                   csv_field(table.id[pairs[i].second]), hits[i]);
  }
  return out;
}

void run_query(const QueryCommandOptions& options) {
  if (options.all_pairs == !options.pairs.empty())
    throw UsageError(options.all_pairs ? "PAIRS.csv and --all-pairs: name one of them"
                                       : "PAIRS.csv or --all-pairs is missing");
  std::vector<std::uint32_t> depths = options.answer.cut_depths();
  const QueryOptions query = options.answer.query_options();

  // Files first, so that a wrong value does not wait for shapes to be built.
  const LoadedCharacter from = load_character(options.character, options.shapes.import_options());
  const auto sources = list_shapes({&from, 1}, options.shapes.poses);
  AgentTable table = read_agents(options.agents, static_cast<std::uint32_t>(sources.size()),
                                 static_cast<std::uint32_t>(depths.size()));
  std::vector<Pair> pairs;
  if (!options.all_pairs) pairs = read_pairs(options.pairs, table);
  // Agents without a level use the last one: the others need not be there.
  if (table.level.empty()) depths.erase(depths.begin(), depths.end() - 1);

  const Threads threads(options.answer.threads);
  const auto used = keep_used(sources, table);
  const BuiltShapes built = build_shapes({&from, 1}, used, options.shapes.threshold);
  const ShapeSet set(built.shapes, {depths, query.semantics == Semantics::solid});
  if (options.all_pairs) pairs = pairs_in_order(set, table.agents());
  std::vector<std::uint8_t> hits(pairs.size());
  collide(set, table.agents(), pairs, hits, query);
  write_standard_output(answers_csv(table, pairs, hits, options.all_pairs));
}

}  // namespace

std::function<void()> add_query_command(CLI::App& program) {
  const auto options = std::make_shared<QueryCommandOptions>();
  CLI::App& command = *program.add_subcommand("query", "Answer pairs of agents from CSV files, as CSV");
  command.footer(
      "In AGENTS.csv an id is any text, shape the number that bch inspect gives it with the same --poses, x "
      "and y are\n"
      "metres, heading is in radians, level an index into --depths (without that column: the last).\n"
      "Writes first,second,hit: a line for each line of PAIRS.csv, in that order; hit is 0 or 1.\n"
      "Example: bch query default:female agents.csv pairs.csv > answers.csv");
  command.add_option("SHAPES", options->character, character_help)->type_name("")->required();
  command.add_option("AGENTS.csv", options->agents, "Columns id,shape,x,y,heading[,level]")
      ->type_name("")
      ->required();
  command.add_option("PAIRS.csv", options->pairs, "Columns first,second: ids of agents")->type_name("");
  command.add_flag("--all-pairs", options->all_pairs,
                   "Instead of PAIRS.csv: find and write all pairs that collide");
  options->shapes.add_to(command);
  options->answer.add_to(command);
  return [options] { run_query(*options); };
}

}  // namespace bch::cli
