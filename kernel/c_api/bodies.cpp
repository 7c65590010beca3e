// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/collide.hpp>

#include "kernel/c_api/calls.hpp"

using namespace bch;
using namespace bch::c_api;

bch_status bch_body_set_create(const bch_sphere* spheres, const uint64_t* offsets, size_t count,
                               bch_body_set** set) {
  return guarded([&] {
    const auto bodies = parts_of<Sphere>(spheres, offsets, count, "spheres");
    required(set, "set");
    hand_out(std::make_unique<bch_body_set>(BodySet(bodies)), set);
  });
}

bch_status bch_body_set_get_info(const bch_body_set* set, bch_body_set_info* info) {
  return guarded([&] {
    const BodySet& of = object_of(set, "set").set;
    bch_body_set_info values = BCH_BODY_SET_INFO_INIT;
    values.bodies = of.body_count();
    values.bytes = of.bytes();
    fill(info, values, "info");
  });
}

bch_status bch_body_set_get_spheres(const bch_body_set* set, uint32_t body, bch_sphere* spheres,
                                    size_t capacity, size_t* count) {
  return guarded([&] {
    const BodySet& of = object_of(set, "set").set;
    check_index(body, of.body_count(), "body");
    const auto to = same_array<Sphere>(spheres, capacity, "spheres");
    required(count, "count");
    const std::vector<Sphere> all = of.spheres(body);
    std::copy_n(all.begin(), std::min(all.size(), capacity), to.begin());
    *count = all.size();
  });
}

bch_status bch_body_set_free(bch_body_set* set) {
  return free_object(set, "set");
}

bch_status bch_collide_bodies(const bch_body_set* set, const bch_agents* agents, const bch_pair* pairs,
                              size_t count, const bch_query_options* options, uint8_t* hits) {
  return guarded([&] {
    const PairCallOn<bch_body_set> call(set, agents, pairs, count, options);
    const auto to = array_of(hits, count, "hits");
    call.run([&] { collide(call.shapes, call.agents, call.pairs, to, call.options.implementation); });
  });
}
