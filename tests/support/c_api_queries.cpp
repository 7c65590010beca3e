// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/c_api_queries.hpp"

namespace bch::test {
namespace {

std::vector<double> drawn(std::uint64_t seed, std::size_t count, double low, double high) {
  Random random(seed);
  std::vector<double> all(count);
  for (double& one : all) one = random.uniform(low, high);
  return all;
}

/// Padding has any value.
template <class Value>
void clear_padding(std::vector<Value>&) {}
void clear_padding(std::vector<bch_penetration_depth>& depths) {
  for (bch_penetration_depth& one : depths) one.unused = 0;
}

/// A query that writes into an array.
template <class Value>
CQuery into(const char* name, bool needs_memory, std::size_t count,
            std::function<bch_status(Value*)> run_query) {
  const auto values = std::make_shared<std::vector<Value>>(count);
  std::memset(static_cast<void*>(values->data()), 77, count * sizeof(Value));
  return {name, needs_memory, [values, run_query] { return run_query(values->data()); },
          [values] {
            clear_padding(*values);
            return bytes(*values);
          }};
}

template <class Rows>
std::string row_bytes(const Rows& rows) {
  if (rows.offsets == nullptr) return {};
  return bytes(std::span(rows.offsets, rows.rows + 1)) +
         bytes(std::span(rows.values, rows.offsets[rows.rows]));
}

/// A query that fills all arrays of a clearance.
CQuery clearance_into(const char* name, bool needs_memory, std::size_t count,
                      const std::function<bch_status(const bch_clearance_out*)>& run_query) {
  // One array after the other, in one: nine numbers for each pair.
  const auto values = std::make_shared<std::vector<float>>(9 * count, 77.0f);
  bch_clearance_out out = BCH_CLEARANCE_OUT_INIT;
  out.distance = values->data();
  out.direction = reinterpret_cast<bch_vec2*>(&(*values)[count]);
  out.discs = reinterpret_cast<bch_disc_pair*>(&(*values)[3 * count]);
  out.points = reinterpret_cast<bch_nearest_points*>(&(*values)[5 * count]);
  return {name, needs_memory, [values, out, run_query] { return run_query(&out); },
          [values] { return bytes(*values); }};
}

/// A query that writes depths and touches.
CQuery touches_into(const char* name, std::size_t count,
                    const std::function<bch_status(bch_penetration_depth*, bch_touch*)>& run_query) {
  const auto depths = std::make_shared<std::vector<bch_penetration_depth>>(count);
  const auto touches = std::make_shared<std::vector<bch_touch>>(count);
  return {name, true, [=] { return run_query(depths->data(), touches->data()); },
          [depths, touches] {
            clear_padding(*depths);
            return bytes(*depths) + bytes(*touches);
          }};
}

void add_queries_of_pairs(const CScene& scene, std::vector<CQuery>& to) {
  const bch_shape_set* const set = scene.set.get();
  const bch_pair* const pairs = c_pairs(scene.pairs);
  const std::size_t n = scene.pairs.size();
  const auto* const all = &scene;
  to.push_back(
      {"validate", false, [=] { return bch_validate_agents(set, &all->agents); }, [] { return ""; }});
  to.push_back(into<std::uint8_t>("collide", false, n, [=](auto* out) {
    return bch_collide(set, &all->agents, pairs, n, &all->options, out);
  }));
  to.push_back(into<std::uint8_t>("within", false, n, [=](auto* out) {
    return bch_within(set, &all->agents, pairs, n, all->nearer.data(), n, &all->options, out);
  }));
  to.push_back(into<bch_penetration_depth>("penetration", false, n, [=](auto* out) {
    return bch_penetration(set, &all->agents, pairs, n, 16, &all->options, out);
  }));
  to.push_back(touches_into("nearest free", n, [=](auto* depths, auto* touches) {
    return bch_nearest_free(set, &all->agents, pairs, n, 16, &all->options, depths, touches);
  }));
  to.push_back(into<bch_penetration_depth>("penetration along", false, n, [=](auto* out) {
    return bch_penetration_along(set, &all->agents, pairs, n, all->along.data(), &all->options, out);
  }));
  to.push_back(into<float>("time of impact", false, n, [=](auto* out) {
    return bch_time_of_impact(set, &all->agents, pairs, n, all->x.data(), all->y.data(), &all->options, out);
  }));
  to.push_back(clearance_into("clearance", false, n, [=](auto* out) {
    return bch_clearance(set, &all->agents, pairs, n, &all->options, out);
  }));
}

void add_queries_of_crowds(const CScene& scene, std::vector<CQuery>& to) {
  const bch_shape_set* const set = scene.set.get();
  const bch_obstacles* const walls = scene.walls.get();
  const auto* const all = &scene;
  struct Found {
    OwnedCrowd crowd = made<bch_crowd_free>(bch_crowd_create, nullptr);
    const bch_pair* pairs = nullptr;
    std::size_t count = 0;
    bch_neighbour_rows neighbours{};
    bch_index_rows touched{};
    bch_contact_rows contacts{};
    bch_crowd_clearance_view near{};
    bch_crowd_penetration_view apart{};
  };
  const auto add = [&](const char* name, bool needs_memory, auto run_query, auto answer) {
    const auto found = std::make_shared<Found>();
    to.push_back({name, needs_memory, [=] { return run_query(*found); }, [=] { return answer(*found); }});
  };
  /// A call whose answer is one view, of arguments beside crowd, set, agents and options.
  const auto add_of = [&](const char* name, bool needs_memory, auto call, auto answer, auto view,
                          auto... more) {
    add(
        name, needs_memory,
        [=](Found& found) {
          return call(found.crowd.get(), set, &all->agents, more..., &all->options, &(found.*view));
        },
        answer);
  };
  const auto pair_bytes = [](const Found& found) { return bytes(std::span(found.pairs, found.count)); };
  const auto contact_bytes = [](const Found& found) {
    const bch_contact_rows& rows = found.contacts;
    return bytes(std::span(rows.pairs, rows.rows)) + row_bytes(rows);
  };
  const auto near_bytes = [](const Found& found) {
    const bch_crowd_clearance_view& near = found.near;
    const auto part = [&](const auto* values) { return bytes(std::span(values, near.count)); };
    return part(near.pairs) + part(near.distance) + part(near.direction) + part(near.discs) +
           part(near.points);
  };
  const auto apart_bytes = [](const Found& found) {
    const auto& [count, pairs, depths] = found.apart;
    std::vector<bch_penetration_depth> all_depths(depths, depths + count);
    clear_padding(all_depths);
    return bytes(std::span(pairs, count)) + bytes(all_depths);
  };
  const auto collisions = [=](Found& found) {
    return bch_crowd_collisions(found.crowd.get(), set, &all->agents, nullptr, &all->options, &found.pairs,
                                &found.count);
  };
  add(
      "candidates", false,
      [=](Found& found) {
        return bch_crowd_candidates(found.crowd.get(), set, &all->agents, 0.4, nullptr, &all->options,
                                    &found.pairs, &found.count);
      },
      pair_bytes);
  add("collisions", false, collisions, pair_bytes);
  add(
      "collisions by agent", false,
      [=](Found& found) {
        const bch_status status = collisions(found);
        return status != BCH_OK ? status : bch_crowd_by_agent(found.crowd.get(), &found.neighbours);
      },
      [](const Found& found) { return row_bytes(found.neighbours); });
  add_of(
      "obstacles", true, bch_crowd_obstacles, [](const Found& found) { return row_bytes(found.touched); },
      &Found::touched, walls);
  add_of("contacts of pairs", false, bch_crowd_contacts_of, contact_bytes, &Found::contacts,
         c_pairs(all->pairs), all->pairs.size());
  add_of("contacts", false, bch_crowd_contacts, contact_bytes, &Found::contacts, nullptr);
  add_of("clearances", false, bch_crowd_clearances, near_bytes, &Found::near, 0.2, nullptr);
  add(
      "nearest", false,
      [=](Found& found) {
        const bch_status status = bch_crowd_clearances(found.crowd.get(), set, &all->agents, 0.2, nullptr,
                                                       &all->options, &found.near);
        return status != BCH_OK ? status : bch_crowd_nearest(found.crowd.get(), 3, &found.neighbours);
      },
      [](const Found& found) { return row_bytes(found.neighbours); });
  const auto radii = std::make_shared<std::vector<double>>(all->agents.count);
  add(
      "disc radii", true,
      [=](Found& found) {
        const bch_status status = bch_crowd_clearances(found.crowd.get(), set, &all->agents, 0.2, nullptr,
                                                       &all->options, &found.near);
        return status != BCH_OK ? status
                                : bch_crowd_disc_radii(found.crowd.get(), &all->agents, 0.25, radii->data());
      },
      [=](const Found&) { return bytes(*radii); });
  add_of("penetrations", false, bch_crowd_penetrations, apart_bytes, &Found::apart, 16u, nullptr);
}

void add_queries_of_obstacles(const CScene& scene, std::vector<CQuery>& to) {
  const bch_shape_set* const set = scene.set.get();
  const bch_obstacles* const walls = scene.walls.get();
  const std::size_t n = scene.agents.count;
  const auto* const all = &scene;
  to.push_back(into<std::uint8_t>("walls: collide", true, n, [=](auto* out) {
    return bch_obstacles_collide(set, &all->agents, walls, &all->options, out);
  }));
  to.push_back(into<std::uint8_t>("walls: within", true, n, [=](auto* out) {
    return bch_obstacles_within(set, &all->agents, walls, all->nearer.data(), n, &all->options, out);
  }));
  to.push_back(into<bch_penetration_depth>("walls: penetration", true, n, [=](auto* out) {
    return bch_obstacles_penetration(set, &all->agents, walls, &all->options, out);
  }));
  to.push_back(touches_into("walls: free of all", n, [=](auto* depths, auto* touches) {
    return bch_nearest_free_of_all(set, &all->agents, c_pairs(all->pairs), all->pairs.size(), walls, 16,
                                   &all->options, depths, touches);
  }));
  to.push_back(into<float>("walls: time of impact", true, n, [=](auto* out) {
    return bch_obstacles_time_of_impact(set, &all->agents, walls, all->x.data(), all->y.data(), &all->options,
                                        out);
  }));
  to.push_back(clearance_into("walls: clearance", true, n, [=](auto* out) {
    return bch_obstacles_clearance(set, &all->agents, walls, &all->options, out);
  }));
}

std::vector<bch_vec2> directions(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<bch_vec2> all;
  for (std::size_t i = 0; i < x.size(); ++i)
    all.push_back({static_cast<float>(x[i]), static_cast<float>(y[i])});
  return all;
}

}  // namespace

CScene::CScene(const ShapeSet& of, Crowd people, std::vector<Pair> asked)
    : shapes(of),
      set(c_set(of)),
      crowd(std::move(people)),
      agents(c_agents(crowd)),
      pairs(std::move(asked)),
      x(drawn(1, std::max(pairs.size(), crowd.x.size()), -2, 2)),
      y(drawn(2, x.size(), -2, 2)),
      nearer(drawn(3, x.size(), 0, 0.5)),
      along(directions(x, y)),
      walls(made<bch_obstacles_free>(bch_obstacles_from_wkt, walls_text, 0, -HUGE_VAL, HUGE_VAL)) {}

std::vector<CQuery> all_queries(const CScene& scene) {
  std::vector<CQuery> all;
  add_queries_of_pairs(scene, all);
  add_queries_of_crowds(scene, all);
  add_queries_of_obstacles(scene, all);
  return all;
}

}  // namespace bch::test
