// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <chrono>
#include <cstdint>
#include <span>

#include <bch/baked.hpp>
#include <bch/clearance.hpp>
#include <bch/collide.hpp>
#include <bch/time_of_impact.hpp>

// What ratios.py compares with: calls of the C++ library on the arrays of the Python program, in the same process. Each function
// returns the nanoseconds that its call took.

namespace {

using namespace bch;

template <class Call>
double nanoseconds(Call call) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

extern "C" {

struct CppScene {
  const std::uint32_t* shape;
  const double *x, *y, *heading;
  std::size_t agents;
  const Pair* pairs;
  std::size_t count;
};

void* cpp_load(const char* file) {
  return new BakedShapes(load_baked(file));
}

static Agents agents_of(const CppScene* scene) {
  const std::size_t n = scene->agents;
  return {{scene->shape, n}, {scene->x, n}, {scene->y, n}, {scene->heading, n}};
}

double cpp_collide(const void* set, const CppScene* scene, std::uint8_t* hits) {
  const ShapeSet& shapes = static_cast<const BakedShapes*>(set)->set;
  const Agents agents = agents_of(scene);
  return nanoseconds([&] { collide(shapes, agents, {scene->pairs, scene->count}, {hits, scene->count}); });
}

double cpp_clearance(const void* set, const CppScene* scene, double limit, float* distance) {
  const ShapeSet& shapes = static_cast<const BakedShapes*>(set)->set;
  const Agents agents = agents_of(scene);
  return nanoseconds([&] {
    clearance(shapes, agents, {scene->pairs, scene->count}, {{distance, scene->count}},
              {.max_distance = limit});
  });
}

double cpp_time_of_impact(const void* set, const CppScene* scene, const double* x, const double* y,
                          float* times) {
  const ShapeSet& shapes = static_cast<const BakedShapes*>(set)->set;
  const Agents agents = agents_of(scene);
  const std::size_t n = scene->count;
  return nanoseconds([&] {
    time_of_impact(shapes, agents, {scene->pairs, n}, {{x, n}, {y, n}}, {times, n});
  });
}

double cpp_collide_all(const void* set, const CppScene* scene, std::uint64_t* found) {
  static CrowdCollider collider;
  const ShapeSet& shapes = static_cast<const BakedShapes*>(set)->set;
  const Agents agents = agents_of(scene);
  return nanoseconds([&] { *found = collider.collide_all(shapes, agents).values.size(); });
}
}
