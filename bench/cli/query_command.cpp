// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>

#include <bch/pairs.hpp>

#include "bench/base/options.hpp"
#include "bench/base/output.hpp"
#include "bench/base/text.hpp"
#include "bench/characters/cost_guard.hpp"
#include "bench/characters/shape_table.hpp"
#include "bench/cli/commands.hpp"
#include "bench/cli/inspection.hpp"
#include "bench/cli/query.hpp"
#include "kernel/runtime/all_options.hpp"
#include "layout/base/mixed_hash.hpp"
#include "layout/base/rounding.hpp"

namespace bch::cli {

std::vector<PoseId> keep_used(std::span<const PoseId> sources, AgentTable& table) {
  std::vector<PoseId> used;
  std::unordered_map<std::uint32_t, std::uint32_t, detail::MixedHash> index_of;
  for (std::uint32_t& shape : table.shape) {
    const auto [entry, added] = index_of.emplace(shape, static_cast<std::uint32_t>(used.size()));
    if (added) used.push_back(sources[shape]);
    shape = entry->second;
  }
  return used;
}

namespace {

/// What there is to answer.
struct Question {
  AgentTable table;
  std::vector<Pair> pairs;
  std::optional<ObstacleSet> obstacles = {};
};

/// Files first, so that a wrong value does not wait for shapes to be built.
Question read_question(const QueryCommandOptions& options, std::size_t shapes, std::size_t levels) {
  Question question{read_agents(options.agents, static_cast<std::uint32_t>(shapes),
                                static_cast<std::uint32_t>(levels), query_kind(options.what).moving),
                    {},
                    options.obstacles.read()};
  if (!options.pairs.empty()) question.pairs = read_pairs(options.pairs, question.table);
  if (options.guard_ids) guard_ids(question.table);
  return question;
}

/// Writes the table of answers, piece by piece.
void answer(const QueryCommandOptions& options, const AnySet& set, Question& question) {
  constexpr std::size_t at_once = 65'536;  // pairs, of which each may have many contacts
  auto& [table, pairs, obstacle_set] = question;
  const ObstacleSet* const obstacles = obstacle_set ? &*obstacle_set : nullptr;
  detail::AllOptions how = options.answer.query_options();
  how.max_distance = options.max_distance;
  how.overlap = options.overlap == "zero" ? Overlap::zero : Overlap::deepest;
  how.distance_leaves = options.answer.leaves == "segments" ? Leaves::segments : Leaves::discs;
  if (options.all_pairs)
    pairs = within_limit(options.max_pairs, options.agents, question.table, [&](std::size_t most) {
      return all_pairs(set, question.table, options.what, how, most);
    });
  const QueryKind& kind = query_kind(options.what);
  const bool spheres = std::holds_alternative<const BodySet*>(set);
  std::string lines =
      fmt::format("{},{}{}\n", subject_columns(obstacles), spheres ? kind.sphere_columns : kind.columns,
                  !options.points ? ""
                  : spheres       ? sphere_point_columns
                                  : point_columns);
  const std::span<const Pair> all = pairs;
  std::size_t begin = 0;
  do {
    const std::span<const Pair> some = all.subspan(begin, std::min(at_once, all.size() - begin));
    lines += kind.rows(
        {set, table, some, how, options.directions, options.only_direction(), options.points, obstacles});
    write_standard_data(lines);
    lines.clear();
    begin += some.size();
  } while (begin < all.size());
}

void query_character(const QueryCommandOptions& options) {
  std::vector<std::uint32_t> depths = options.answer.cut_depths();
  const CostLimits& limits = options.shapes.limits;
  const LoadedCharacter from = load_character(options.character, options.shapes.import_options());
  const auto sources = list_shapes({&from, 1}, options.shapes.poses);
  Question question = read_question(options, sources.size(), depths.size());
  // Agents without a level use the last one: the others need not be there.
  if (question.table.level.empty()) depths.erase(depths.begin(), depths.end() - 1);

  const Threads threads(options.answer.threads);
  const auto used = keep_used(sources, question.table);
  std::optional<CostGuard> guard(std::in_place, limits, std::span(&from, 1), used.size());
  const ShapeSetPlan plan{.depths = depths, .heights = options.compares_heights(question.table)};
  const BuiltShapes built = build_shapes({&from, 1}, used, options.shapes.threshold, plan, limits);
  const ShapeSet set(built.shapes, plan);
  guard.reset();
  answer(options, &set, question);
  std::fputs(notes_text({&from, 1}).c_str(), stderr);  // standard output is for data
}

/// Bodies of spheres are posed, not built.
void query_spheres(const QueryCommandOptions& options) {
  const std::vector<LoadedCharacter> from{load_character(options.character, options.shapes.import_options())};
  const auto sources = list_shapes(from, options.shapes.poses);
  Question question = read_question(options, sources.size(), 1);
  const Threads threads(options.answer.threads);
  const auto used = keep_used(sources, question.table);
  const BodySet bodies = posed_bodies(make_models(from, options.kind.spheres), used);
  answer(options, &bodies, question);
  std::fputs(notes_text(from).c_str(), stderr);  // standard output is for data
}

void query_baked(const QueryCommandOptions& options) {
  const BakedShapes baked = load_baked_for(options.character, options.answer);
  Question question = read_question(options, baked.set.shape_count(), baked.set.level_count());
  if (options.compares_heights(question.table) && !baked.set.has_heights())
    throw InputError(options.character + ": was baked without heights, which agents with a z and " +
                     "--obstacle-heights need; bake it with --heights");
  const Threads threads(options.answer.threads);
  answer(options, &baked.set, question);
}

void run_query(const CLI::App& command, const QueryCommandOptions& options) {
  require_fitting(command, options);
  if (options.kind.bodies == "spheres") return query_spheres(options);
  if (!is_baked(options.character)) return query_character(options);
  require_unsettled(command, options.character);
  query_baked(options);
}

}  // namespace

std::function<void()> add_query_command(CLI::App& program) {
  const auto options = std::make_shared<QueryCommandOptions>();
  CLI::App& command =
      *program.add_subcommand("query", "Answer queries about pairs of agents from CSV files, as CSV");
  command.footer(
      R"(Columns of AGENTS.csv:
  id             any text
  shape          the number that bch inspect prints with the same --poses
  x,y            position, metres
  heading        radians. At 0 a built-in character faces +x, and a character from a file stands as in the file;
                 +z of a y-up file becomes -y. For people who face +z in a y-up file (as in glTF), or -y in
                 a z-up file, the heading is the direction in which they walk plus pi/2
  level          index into --depths [the last]
  z              height of the ground, metres; a baked file has to keep heights (bake --heights)
  dx,dy          displacement of the agent, metres, without turning; for time-of-impact
Output of --what: one line per line of PAIRS.csv, in the same order, unless stated otherwise:
)" + query_help() +
      R"(collide and contacts test what --leaves names. within, time-of-impact and penetration use the discs of the
cuts, and so does clearance unless --leaves segments is given. Discs cover more than outlines, so agents
at a distance of 0 m need not collide. With --obstacles, --leaves segments applies to within, too.
With --bodies spheres, all queries are in space: directions and points have a z as well, and contacts are spheres
that overlap, each with its depth (metres), the point of the first that is deepest in the second, relative to the
first agent, and the normal. Agents stand at their z, or all on one ground, and move on the ground. --obstacles
then takes collide, clearance and within.
With --obstacles, each line is about one agent and the obstacles: id,... instead of first,second,...;
contacts is not available. FILE.wkt may have POLYGON, MULTIPOLYGON, LINESTRING, MULTILINESTRING and
GEOMETRYCOLLECTION; Z and M are ignored.
Notes on how a character's file was read go to standard error.
Example: bch query default:female agents.csv pairs.csv > answers.csv)");
  const OptionAdder add(command);
  add("SHAPES", options->character, "", character_or_baked_help)->required();
  add("AGENTS.csv", options->agents, "", "Columns id,shape,x,y,heading[,z][,level][,dx,dy]")->required();
  add("PAIRS.csv", options->pairs, "", "Columns first,second: ids of agents");
  command.add_flag("--all-pairs", options->all_pairs,
                   "Instead of PAIRS.csv: all pairs that collide or, with --max-distance, are within it");
  command.add_flag(
      "--guard-ids", options->guard_ids,
      "Put ' before ids that begin with =, +, - or @, unless they are numbers, for spreadsheets");
  add_max_pairs_option(command, options->max_pairs, "agents near each other, for --all-pairs", "agent");
  options->obstacles.add_to(
      command, "Instead of PAIRS.csv: test all agents against these walls and polygons, in well-known text");
  std::vector<std::string> names;
  for (const QueryKind& kind : query_kinds()) names.emplace_back(kind.name);
  add("--what", options->what, "NAME", fmt::format("Query: {} [{}]", fmt::join(names, ", "), names.front()),
      one_of(names, {{"separation", "penetration"}, {"contact-time", "time-of-impact"}}));
  add("--directions", options->directions, "N",
      "For penetration: try N evenly spread directions, N even, and take the best [16]",
      whole_between(2, 256));
  add("--direction", options->direction, "X,Y",
      "For penetration: move along this vector, of any length, instead");
  add("--max-distance", options->max_distance, "M",
      "Metres; for within: the distance; for clearance: the limit beyond which it is inf [no limit]",
      number_between(0, 2 * detail::rounding::largest_position));
  add("--overlap", options->overlap, "NAME",
      "Clearance of overlapping discs: zero, or deepest: the deepest overlap of two, negative [zero]",
      one_of({"zero", "deepest"}));
  command.add_flag(
      "--points", options->points,
      "For clearance: also write the nearest points, relative to the positions of their agents, metres");
  options->kind.add_to(command);
  options->shapes.add_to(command);
  options->answer.add_to(command);
  command.get_option("--leaves")
      ->description(
          "At depth all: outline segments, or discs, up to 2 cm larger [segments; clearance, within: discs]");
  return [options, &command] { run_query(command, *options); };
}

}  // namespace bch::cli
