// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <gtest/gtest.h>

#include <bch/bch.h>

#include "tests/support/scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace bch::test {

/// Frees an object of the C interface at its end.
template <class Object, bch_status (*free)(Object*)>
struct Freed {
  void operator()(Object* object) const { EXPECT_EQ(free(object), BCH_OK) << bch_last_error(); }
};
template <class Object, bch_status (*free)(Object*)>
using Owned = std::unique_ptr<Object, Freed<Object, free>>;
using OwnedSet = Owned<bch_shape_set, bch_shape_set_free>;
using OwnedBuilder = Owned<bch_shape_set_builder, bch_shape_set_builder_free>;
using OwnedCharacter = Owned<bch_character, bch_character_free>;
using OwnedShapeBuilder = Owned<bch_shape_builder, bch_shape_builder_free>;
using OwnedCrowd = Owned<bch_crowd, bch_crowd_free>;
using OwnedObstacles = Owned<bch_obstacles, bch_obstacles_free>;

inline void expect_ok(bch_status status) {
  EXPECT_EQ(status, BCH_OK) << bch_status_name(status) << ": " << bch_last_error();
}

/// Makes an object of the C interface by a function that hands it out by its last argument, and that has the others before it.
template <auto free, class... Parameters, class... Arguments>
auto made(bch_status (*make)(Parameters...), Arguments... arguments) {
  using To = std::tuple_element_t<sizeof...(Parameters) - 1, std::tuple<Parameters...>>;
  using Object = std::remove_pointer_t<std::remove_pointer_t<To>>;
  Object* object = nullptr;
  expect_ok(make(arguments..., &object));
  return Owned<Object, free>(object);
}

inline OwnedCharacter c_person(std::int32_t which) {
  return made<bch_character_free>(bch_character_default, which);
}
inline OwnedBuilder c_builder(const bch_plan* plan = nullptr) {
  return made<bch_shape_set_builder_free>(bch_shape_set_builder_create, plan);
}
inline OwnedSet finished(const OwnedBuilder& builder) {
  return made<bch_shape_set_free>(bch_shape_set_builder_finish, builder.get());
}

/// Returns all values of a function that fills an array and says how many there are.
template <class Value, class Get>
std::vector<Value> all_of(Get get) {
  std::size_t count = 0;
  expect_ok(get(nullptr, 0, &count));
  std::vector<Value> all(count + 1);  // room for more than there are
  expect_ok(get(all.data(), all.size(), &count));
  all.pop_back();
  EXPECT_EQ(count, all.size());
  return all;
}
inline std::vector<bch_disc> discs_of(const bch_shape_set* set, std::uint32_t shape,
                                      std::uint32_t level = 0) {
  return all_of<bch_disc>([=](auto... to) { return bch_shape_set_get_discs(set, shape, level, to...); });
}

/// Returns values as bytes.
template <class Values>
std::string bytes(const Values& values) {
  return {reinterpret_cast<const char*>(std::data(values)), std::size(values) * sizeof *std::data(values)};
}

/// The same set for the C interface, by way of a file.
inline OwnedSet c_set(const ShapeSet& set) {
  const TemporaryFolder folder;
  const std::string file = folder.file("shapes.bch").string();
  save_baked(file, set);
  return made<bch_shape_set_free>(bch_shape_set_load, file.c_str(), BCH_READ);
}

inline bch_agents c_agents(const Crowd& crowd) {
  bch_agents agents = BCH_AGENTS_INIT;
  agents.shape = crowd.shape.data(), agents.x = crowd.x.data(), agents.y = crowd.y.data();
  agents.heading = crowd.heading.data(), agents.level = crowd.level.data();
  agents.z = crowd.z.empty() ? nullptr : crowd.z.data();
  agents.count = crowd.x.size();
  return agents;
}

inline const bch_pair* c_pairs(const std::vector<Pair>& pairs) {
  return reinterpret_cast<const bch_pair*>(pairs.data());
}

}  // namespace bch::test
