// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/cli/query.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <type_traits>
#include <vector>

#include <bch/crowd.hpp>
#include <bch/pairs.hpp>

#include "bench/cli/crowd.hpp"
#include "kernel/runtime/all_options.hpp"

namespace bch::cli {
namespace {

/// The ids that begin each line: two, or one of an agent against obstacles.
std::string ids(const QueryInput& input, std::size_t i) {
  if (input.obstacles != nullptr) return csv_field(input.table.id[i]);
  const auto [first, second] = input.pairs[i];
  return csv_field(input.table.id[first]) + "," + csv_field(input.table.id[second]);
}

/// Without the sign of a zero.
float plain(float value) {
  return value + 0.0f;
}

/// A part of a unit vector: zero without its sign and without what rounding leaves of it.
double plain_part(double value) {
  return std::abs(value) < 1e-15 ? 0 : value;
}

std::string hit_rows(const QueryInput& input, const std::vector<std::uint8_t>& hits) {
  std::string out;
  for (std::size_t i = 0; i < hits.size(); ++i) out += fmt::format("{},{:d}\n", ids(input, i), hits[i]);
  return out;
}

/// Asks query(set, about) about obstacles, where there are some, or pairs.
template <class Query>
void run_query(const QueryInput& input, const Query& query) {
  std::visit(
      [&](const auto* set) {
        if (input.obstacles != nullptr) return query(*set, *input.obstacles);
        query(*set, input.pairs);
      },
      input.set);
}

std::string collide_rows(const QueryInput& input) {
  std::vector<std::uint8_t> hits(input.size());
  run_query(input, [&](const auto& set, const auto& about) {
    collide(set, input.table.agents(), about, hits, input.options);
  });
  return hit_rows(input, hits);
}

std::string columns(const Vec2& v) {
  return fmt::format(",{},{}", plain(v.x), plain(v.y));
}

std::string columns(const Vec3& v) {
  return fmt::format(",{},{},{}", plain(v.x), plain(v.y), plain(v.z));
}

std::string columns(const DiscPair& discs) {
  return fmt::format(",{},{}", discs.first, discs.second);
}

std::string columns(const bch::Crowd::SphereContact& contact) {
  return columns(contact.spheres) + fmt::format(",{}", contact.depth) + columns(contact.point) +
         columns(contact.normal);
}

std::string contact_rows(const QueryInput& input) {
  std::string out;
  bch::Crowd crowd;
  const auto list = [&](const auto& rows) {
    for (std::size_t i = 0; i < input.pairs.size(); ++i)
      for (const auto& contact : rows[i]) out += ids(input, i) + columns(contact) + "\n";
  };
  std::visit(
      [&](const auto* set) { list(crowd.contacts(*set, input.table.agents(), input.pairs, input.options)); },
      input.set);
  return out;
}

/// Bodies of spheres cannot be asked about obstacles; see require_fitting().
template <class Set, class About>
constexpr bool of_pairs_alone = std::is_same_v<Set, BodySet>&& std::is_same_v<About, ObstacleSet>;

std::string penetration_rows(const QueryInput& input) {
  std::vector<Penetration> depths(input.size());
  const Agents agents = input.table.agents();
  run_query(input, [&]<class Set, class About>(const Set& set, const About& about) {
    if constexpr (std::is_same_v<About, ObstacleSet>) {
      if constexpr (!of_pairs_alone<Set, About>) penetration(set, agents, about, depths, input.options);
    } else if (input.direction) {
      const std::vector<Vec2> along(input.pairs.size(), *input.direction);
      penetration_along(set, agents, about, along, depths, input.options);
    } else {
      penetration(set, agents, about, input.directions, depths, input.options);
    }
  });
  std::string out;
  for (std::size_t i = 0; i < depths.size(); ++i)
    out += fmt::format("{},{},{},{}\n", ids(input, i), plain(depths[i].depth), plain_part(depths[i].x),
                       plain_part(depths[i].y));
  return out;
}

/// `measure` fills the three arrays.
template <class Vector, class Points, class Measure>
std::string clearance_lines(const QueryInput& input, const Measure& measure) {
  std::vector<float> distance(input.size());
  std::vector<Vector> direction(input.size());
  std::vector<Points> points(input.points ? input.size() : 0);
  measure(distance, direction, points);
  std::string out;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    out += fmt::format("{},{}{}", ids(input, i), plain(distance[i]), columns(direction[i]));
    if (input.points) out += columns(points[i].first) + columns(points[i].second);
    out += "\n";
  }
  return out;
}

std::string clearance_rows(const QueryInput& input) {
  const auto lines = [&]<class Set, class Vector, class Points, class Answers>() {
    return clearance_lines<Vector, Points>(input, [&](auto& distance, auto& direction, auto& points) {
      run_query(input, [&](const auto& set, const auto& about) {
        if constexpr (std::is_same_v<decltype(set), const Set&>)
          clearance(set, input.table.agents(), about,
                    Answers{.distance = distance, .direction = direction, .points = points}, input.options);
      });
    });
  };
  return std::holds_alternative<const BodySet*>(input.set)
             ? lines.template operator()<BodySet, Vec3, BodyClearanceAnswers::Points, BodyClearanceAnswers>()
             : lines.template operator()<ShapeSet, Vec2, NearestPoints, ClearanceAnswers>();
}

std::string within_rows(const QueryInput& input) {
  std::vector<std::uint8_t> hits(input.size());
  const Agents agents = input.table.agents();
  const std::span<const double> distance(&input.options.max_distance, 1);
  run_query(input, [&]<class Set, class About>(const Set& set, const About& about) {
    if constexpr (std::is_same_v<Set, ShapeSet> && std::is_same_v<About, ObstacleSet>)
      within(set, agents, about, distance, hits, input.options.distance_leaves, input.options);
    else
      within(set, agents, about, distance, hits, input.options);
  });
  return hit_rows(input, hits);
}

std::string time_of_impact_rows(const QueryInput& input) {
  const AgentTable& table = input.table;
  std::vector<float> time(input.size());
  std::vector<double> x, y;
  for (const auto [first, second] : input.pairs)
    x.push_back(table.dx[first] - table.dx[second]), y.push_back(table.dy[first] - table.dy[second]);
  run_query(input, [&]<class Set, class About>(const Set& set, const About& about) {
    if constexpr (!std::is_same_v<About, ObstacleSet>)
      time_of_impact(set, table.agents(), about, {x, y}, time, input.options);
    else if constexpr (!of_pairs_alone<Set, About>)
      time_of_impact(set, table.agents(), {table.dx, table.dy}, about, time, input.options);
  });
  std::string out;
  for (std::size_t i = 0; i < time.size(); ++i) out += fmt::format("{},{}\n", ids(input, i), time[i]);
  return out;
}

constexpr QueryKind kinds[] = {
    {"collide", "hit", "1 if the agents collide, else 0", collide_rows, "hit", false, true, true},
    {"clearance", "distance,x,y",
     R"(the least gap between their discs or, with --leaves segments,
                 their outlines, in metres, and the unit vector from the first to the second; 0,0,0 where
                 they overlap, unless --overlap deepest is given; inf,0,0 beyond --max-distance.
                 --points adds first_x,first_y,second_x,second_y)",
     clearance_rows, "distance,x,y,z", false, true, true},
    {"within", "hit", "1 if the agents are within --max-distance of each other, else 0", within_rows, "hit",
     false, true, true},
    {"time-of-impact", "time",
     R"(when the agents first touch while each moves by its dx,dy, from 0 at
                 the start to 1 at the end; inf if they do not touch)",
     time_of_impact_rows, "time", true},
    {"contacts", "first_disc,second_disc",
     R"(one line for each two discs that overlap: their indices
                 among the discs of the agents' levels, from 0, in depth-first order)",
     contact_rows, "first_sphere,second_sphere,depth,x,y,z,normal_x,normal_y,normal_z", false, false},
    {"penetration", "depth,x,y",
     R"(how far (metres) and in which direction (unit vector) the first agent
                 has to move until a line separates the two; 0 where a line already does. With --direction:
                 until all of it lies beyond the second, which may be far where the two are apart)",
     penetration_rows, "depth,x,y"},
};

/// Tells which pairs have a clearance.
template <class Bodies>
std::vector<std::uint8_t> have_clearance(const Bodies& set, const Agents& agents, std::span<const Pair> pairs,
                                         const detail::AllOptions& options) {
  std::vector<float> distance(pairs.size());
  clearance(set, agents, pairs, {distance}, options);
  std::vector<std::uint8_t> have(pairs.size());
  std::transform(distance.begin(), distance.end(), have.begin(), [](float d) { return std::isfinite(d); });
  return have;
}

template <class Bodies>
std::vector<Pair> all_pairs_of(const Bodies& set, const AgentTable& table, const std::string& what,
                               const detail::AllOptions& options, std::size_t most) {
  const Agents agents = table.agents();
  const bool of_distance = std::isfinite(options.max_distance);
  bch::Crowd crowd({.max_pairs = most});
  std::vector<Pair> pairs = sorted(crowd.candidates(set, agents, of_distance ? options.max_distance : 0));
  std::vector<std::uint8_t> kept(pairs.size());
  if (!of_distance)
    collide(set, agents, pairs, kept, options);
  else if (what == "within")
    within(set, agents, pairs, {&options.max_distance, 1}, kept, options);
  else
    kept = have_clearance(set, agents, pairs, options);
  std::size_t count = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[count] = pairs[i];
    count += kept[i];
  }
  pairs.resize(count);
  return pairs;
}

}  // namespace

std::span<const QueryKind> query_kinds() {
  return kinds;
}

const QueryKind& query_kind(const std::string& name) {
  return *std::find_if(std::begin(kinds), std::end(kinds),
                       [&](const QueryKind& kind) { return kind.name == name; });
}

const char* subject_columns(const ObstacleSet* obstacles) {
  return obstacles == nullptr ? "first,second" : "id";
}

std::string query_help() {
  std::string text;
  for (const QueryKind& kind : kinds)
    text += fmt::format("  {:<14} first,second,{}: {}\n", kind.name, kind.columns, kind.help);
  return text;
}

std::vector<Pair> all_pairs(const AnySet& set, const AgentTable& table, const std::string& what,
                            const detail::AllOptions& options, std::size_t most) {
  return std::visit([&](const auto* of) { return all_pairs_of(*of, table, what, options, most); }, set);
}

}  // namespace bch::cli
