// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <tuple>
#include <unordered_map>

#include "bench/baked_report.hpp"
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

/// What there is to answer.
struct Question {
  AgentTable table;
  std::vector<Pair> pairs;
};

/// Files first, so that a wrong value does not wait for shapes to be built.
Question read_question(const QueryCommandOptions& options, std::size_t shapes, std::size_t levels) {
  Question question{
      read_agents(options.agents, static_cast<std::uint32_t>(shapes), static_cast<std::uint32_t>(levels)),
      {}};
  if (!options.all_pairs) question.pairs = read_pairs(options.pairs, question.table);
  return question;
}

void answer(const QueryCommandOptions& options, const ShapeSet& set, Question& question) {
  auto& [table, pairs] = question;
  if (options.all_pairs) pairs = pairs_in_order(set, table.agents());
  std::vector<std::uint8_t> hits(pairs.size());
  collide(set, table.agents(), pairs, hits, options.answer.query_options());
  write_standard_output(answers_csv(table, pairs, hits, options.all_pairs));
}

void query_character(const QueryCommandOptions& options) {
  std::vector<std::uint32_t> depths = options.answer.cut_depths();
  const bool solid = options.answer.query_options().semantics == Semantics::solid;
  const LoadedCharacter from = load_character(options.character, options.shapes.import_options());
  const auto sources = list_shapes({&from, 1}, options.shapes.poses);
  Question question = read_question(options, sources.size(), depths.size());
  // Agents without a level use the last one: the others need not be there.
  if (question.table.level.empty()) depths.erase(depths.begin(), depths.end() - 1);

  const Threads threads(options.answer.threads);
  const auto used = keep_used(sources, question.table);
  const BuiltShapes built = build_shapes({&from, 1}, used, options.shapes.threshold);
  answer(options, ShapeSet(built.shapes, {depths, solid}), question);
}

void query_baked(const QueryCommandOptions& options) {
  const bool solid = options.answer.query_options().semantics == Semantics::solid;
  const BakedShapes baked = load_baked_for(options.character, solid);
  Question question = read_question(options, baked.set.shape_count(), baked.set.level_count());
  const Threads threads(options.answer.threads);
  answer(options, baked.set, question);
}

void run_query(const CLI::App& command, const QueryCommandOptions& options) {
  if (options.all_pairs == !options.pairs.empty())
    throw UsageError(options.all_pairs ? "PAIRS.csv and --all-pairs: name one of them"
                                       : "PAIRS.csv or --all-pairs is missing");
  if (!is_baked(options.character)) return query_character(options);
  require_unsettled(command, options.character);
  query_baked(options);
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
  command.add_option("SHAPES", options->character, character_or_baked_help)->type_name("")->required();
  command.add_option("AGENTS.csv", options->agents, "Columns id,shape,x,y,heading[,level]")
      ->type_name("")
      ->required();
  command.add_option("PAIRS.csv", options->pairs, "Columns first,second: ids of agents")->type_name("");
  command.add_flag("--all-pairs", options->all_pairs,
                   "Instead of PAIRS.csv: find and write all pairs that collide");
  options->shapes.add_to(command);
  options->answer.add_to(command);
  return [options, &command] { run_query(command, *options); };
}

}  // namespace bch::cli
