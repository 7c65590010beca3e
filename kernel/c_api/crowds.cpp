// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/broad_phase.hpp>
#include <bch/collide.hpp>
#include <bch/contacts.hpp>

#include "kernel/c_api/calls.hpp"
#include "kernel/c_api/obstacles.hpp"

struct bch_broad_phase {
  bch::BroadPhase broad_phase;
};

struct bch_crowd_collider {
  bch::CrowdCollider collider;
};

struct bch_contact_finder {
  bch::ContactFinder finder;
};

using namespace bch;
using namespace bch::c_api;

namespace {

bch_index_rows rows_of(const Rows<std::uint32_t>& rows) {
  return {rows.size(), rows.offsets.data(), rows.values.data()};
}

bch_contact_rows contact_rows(std::span<const Pair> pairs, const Rows<DiscPair>& rows) {
  return {rows.size(), reinterpret_cast<const bch_pair*>(pairs.data()), rows.offsets.data(),
          reinterpret_cast<const bch_disc_pair*>(rows.values.data())};
}

}  // namespace

bch_status bch_broad_phase_create(bch_broad_phase** broad_phase) {
  return guarded([&] {
    required(broad_phase, "broad_phase");
    hand_out(std::make_unique<bch_broad_phase>(), broad_phase);
  });
}

bch_status bch_broad_phase_find(bch_broad_phase* handle, const bch_shape_set* set, const bch_agents* agents,
                                double margin, const bch_query_options* options, const bch_pair** pairs,
                                size_t* count) {
  return guarded([&] {
    BroadPhase& broad_phase = object_of(handle, "broad_phase").broad_phase;
    const Call call(set, agents, options);
    required(pairs, "pairs");
    required(count, "count");
    std::span<const Pair> found;
    call.run([&] { found = broad_phase.find(call.shapes, call.agents, margin); });
    *pairs = reinterpret_cast<const bch_pair*>(found.data());
    *count = found.size();
  });
}

bch_status bch_broad_phase_free(bch_broad_phase* broad_phase) {
  return free_object(broad_phase, "broad_phase");
}

bch_status bch_crowd_collider_create(bch_crowd_collider** collider) {
  return guarded([&] {
    required(collider, "collider");
    hand_out(std::make_unique<bch_crowd_collider>(), collider);
  });
}

bch_status bch_crowd_collider_collide_all(bch_crowd_collider* handle, const bch_shape_set* set,
                                          const bch_agents* agents, const bch_obstacles* obstacles,
                                          const bch_query_options* options, bch_index_rows* neighbours,
                                          bch_index_rows* touched) {
  return guarded([&] {
    CrowdCollider& collider = object_of(handle, "collider").collider;
    const Call call(set, agents, options);
    required(neighbours, "neighbours");
    if ((obstacles == nullptr) != (touched == nullptr))
      throw Failure(BCH_INVALID_ARGUMENT, "obstacles and touched: one of them is NULL");
    CrowdCollisions found;
    if (obstacles == nullptr) {
      call.run([&] { found.agents = collider.collide_all(call.shapes, call.agents, call.options); });
    } else {
      const ObstacleSet& walls = object_of(obstacles, "obstacles").set;
      call.run([&] { found = collider.collide_all(call.shapes, call.agents, walls, call.options); });
      *touched = rows_of(found.obstacles);
    }
    *neighbours = rows_of(found.agents);
  });
}

bch_status bch_crowd_collider_free(bch_crowd_collider* collider) {
  return free_object(collider, "collider");
}

bch_status bch_contact_finder_create(bch_contact_finder** finder) {
  return guarded([&] {
    required(finder, "finder");
    hand_out(std::make_unique<bch_contact_finder>(), finder);
  });
}

bch_status bch_contact_finder_find(bch_contact_finder* handle, const bch_shape_set* set,
                                   const bch_agents* agents, const bch_pair* pairs, size_t count,
                                   const bch_query_options* options, bch_contact_rows* contacts) {
  return guarded([&] {
    ContactFinder& finder = object_of(handle, "finder").finder;
    const PairCall call(set, agents, pairs, count, options);
    required(contacts, "contacts");
    call.run([&] {
      *contacts = contact_rows(call.pairs, finder.find(call.shapes, call.agents, call.pairs, call.options));
    });
  });
}

bch_status bch_contact_finder_find_all(bch_contact_finder* handle, const bch_shape_set* set,
                                       const bch_agents* agents, const bch_query_options* options,
                                       bch_contact_rows* contacts) {
  return guarded([&] {
    ContactFinder& finder = object_of(handle, "finder").finder;
    const Call call(set, agents, options);
    required(contacts, "contacts");
    call.run([&] {
      const CrowdContacts found = finder.find_all(call.shapes, call.agents, call.options);
      *contacts = contact_rows(found.pairs, found.contacts);
    });
  });
}

bch_status bch_contact_finder_free(bch_contact_finder* finder) {
  return free_object(finder, "finder");
}
