// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/bodies.hpp>
#include <bch/files.hpp>
#include <bch/pairs.hpp>

#include "kernel/c_api/calls.hpp"
#include "kernel/c_api/posing.hpp"
#include "kernel/c_api/work.hpp"

struct bch_live_bodies {
  bch_live_bodies(std::span<const bch::BodyModel> models, std::span<const std::uint32_t> model_of_body)
      : bodies(models, model_of_body), lent(std::make_unique<bch_body_set>(bodies.set())) {}

  bch::LiveBodies bodies;
  std::unique_ptr<bch_body_set> lent;
  std::vector<bch::Pose> poses;  ///< of the last call, whose memory the next one uses
};

using namespace bch;
using namespace bch::c_api;

namespace {

constexpr double progress_parts = 1000;

/// Poses all bodies: pose_of(i) is that of body i.
template <class PoseOf>
void pose_all(bch_live_bodies& of, const PoseOf& pose_of, std::uint32_t threads) {
  of.poses.clear();
  for (std::uint32_t i = 0; i < of.bodies.set().body_count(); ++i) of.poses.push_back(pose_of(i));
  on_threads(threads, [&] { of.bodies.pose(of.poses); });
}

std::vector<BodyModel> models_of(const bch_body_model* const* models, std::size_t count) {
  std::vector<BodyModel> all;
  for (const bch_body_model* const model : array_of(models, count, "models"))
    all.push_back(object_of(model, "a model of models").model);
  return all;
}

}  // namespace

bch_status bch_spheres_from_capsules(const bch_space_capsule* capsules, size_t capsule_count, float error,
                                     bch_sphere* spheres, size_t capacity, size_t* count) {
  return guarded([&] {
    const auto all = same_array<BodySet::Capsule>(capsules, capsule_count, "capsules");
    deliver(spheres_from_capsules(all, error), spheres, capacity, "spheres", count);
  });
}

bch_status bch_spheres_from_polygons(const bch_vec2* corners, const uint64_t* offsets, size_t polygons,
                                     const bch_heights* heights, float error, bch_sphere* spheres,
                                     size_t capacity, size_t* count) {
  return guarded([&] {
    const auto all = parts_of<Vec2>(corners, offsets, polygons, "corners");
    const auto [bottom, top] = required(heights, "heights");
    deliver(spheres_from_polygons(all, {bottom, top}, error), spheres, capacity, "spheres", count);
  });
}

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
    deliver(of.spheres(body), spheres, capacity, "spheres", count);
  });
}

bch_status bch_body_set_free(bch_body_set* set) {
  return free_object(set, "set");
}

bch_status bch_body_model_make(const bch_character* character, const bch_body_options* given,
                               const bch_work* given_work, bch_body_model** model) {
  return guarded([&] {
    const Character& of = *object_of(character, "character").character;
    const bch_body_options options = sized<bch_body_options>(given, BCH_BODY_OPTIONS_INIT, "options");
    const bch_work work = sized<bch_work>(given_work, BCH_WORK_INIT, "work");
    required(model, "model");
    BodyOptions how{.spheres = options.spheres, .draft = options.draft != 0};
    if (const auto report = Work::function_of(work))
      how.progress = [=](double fraction) {
        return report(static_cast<std::size_t>(fraction * progress_parts),
                      static_cast<std::size_t>(progress_parts));
      };
    hand_out(std::make_unique<bch_body_model>(make_body(of, how)), model);
  });
}

bch_status bch_body_model_default(const bch_character* character, uint32_t spheres, bch_body_model** model) {
  return guarded([&] {
    const Character& of = *object_of(character, "character").character;
    required(model, "model");
    hand_out(std::make_unique<bch_body_model>(default_body(of, spheres)), model);
  });
}

bch_status bch_body_model_from_spheres(const bch_sphere* spheres, size_t count, bch_body_model** model) {
  return guarded([&] {
    const auto all = same_array<Sphere>(spheres, count, "spheres");
    required(model, "model");
    hand_out(std::make_unique<bch_body_model>(make_body(all)), model);
  });
}

bch_status bch_body_models_save(const bch_body_model* const* models, size_t model_count, const char* path) {
  return guarded([&] {
    std::vector<BakedBody> bodies;
    for (const BodyModel& model : models_of(models, model_count)) bodies.push_back(to_bytes(model));
    required(path, "path");
    save_baked(path, ShapeSet(std::span<const Shape>(), {}), {}, {}, bodies);
  });
}

bch_status bch_body_model_load(const char* path, size_t index, size_t* count, bch_body_model** model) {
  return guarded([&] {
    required(path, "path");
    required(model, "model");
    required(count, "count");
    require_file(path);
    const std::vector<BakedBody> bodies = load_baked(path, FileAccess::map).bodies;
    if (index < bodies.size())
      hand_out(std::make_unique<bch_body_model>(body_model(bodies[index])), model);
    else
      *model = nullptr;
    *count = bodies.size();
  });
}

bch_status bch_bake_bodies(const bch_body_model* const* models, size_t model_count, uint32_t poses,
                           const bch_work* given_work, bch_body_set** set) {
  return guarded([&] {
    const std::vector<BodyModel> all = models_of(models, model_count);
    const bch_work work = sized<bch_work>(given_work, BCH_WORK_INIT, "work");
    required(set, "set");
    const BakeBodiesOptions how{.poses = poses, .progress = Work::function_of(work)};
    on_threads(work.threads, [&] { hand_out(std::make_unique<bch_body_set>(bake(all, how)), set); });
  });
}

bch_status bch_body_model_get_sphere_count(const bch_body_model* model, uint32_t* count) {
  return guarded([&] {
    const BodyModel& of = object_of(model, "model").model;
    required(count, "count") = static_cast<uint32_t>(of.sphere_count());
  });
}

bch_status bch_body_model_free(bch_body_model* model) {
  return free_object(model, "model");
}

bch_status bch_live_bodies_create(const bch_body_model* const* models, size_t model_count,
                                  const uint32_t* model_of_body, size_t count, bch_live_bodies** bodies) {
  return guarded([&] {
    const std::vector<BodyModel> all = models_of(models, model_count);
    const auto model_of = array_of(model_of_body, count, "model_of_body");
    required(bodies, "bodies");
    auto live = std::make_unique<bch_live_bodies>(all, model_of);
    const bch_body_set* const lent = live->lent.get();
    hand_out(std::move(live), lent, bodies);
  });
}

bch_status bch_live_bodies_pose(bch_live_bodies* bodies, const bch_pose* poses, uint32_t threads) {
  return guarded([&] {
    bch_live_bodies& of = object_of(bodies, "bodies");
    const auto times = array_of(poses, of.bodies.set().body_count(), "poses");
    pose_all(
        of, [&](std::size_t i) { return pose_of(times[i]); }, threads);
  });
}

bch_status bch_live_bodies_pose_from_arrays(bch_live_bodies* bodies, const bch_pose_arrays* poses,
                                            uint32_t threads) {
  return guarded([&] {
    bch_live_bodies& of = object_of(bodies, "bodies");
    const CustomPoses own(poses, of.bodies.set().body_count());
    pose_all(
        of, [&](std::size_t i) { return own[i]; }, threads);
  });
}

bch_status bch_live_bodies_get_set(const bch_live_bodies* bodies, const bch_body_set** set) {
  return guarded([&] {
    const bch_live_bodies& of = object_of(bodies, "bodies");
    required(set, "set") = of.lent.get();
  });
}

bch_status bch_live_bodies_free(bch_live_bodies* bodies) {
  return guarded([&] {
    if (const auto taken = take_back(bodies, "bodies")) registry::end_loan(taken->lent.get());
  });
}

bch_status bch_collide_bodies(const bch_body_set* set, const bch_agents* agents, const bch_pair* pairs,
                              size_t count, const bch_query_options* options, uint8_t* hits) {
  return guarded([&] {
    const PairCallOn<bch_body_set> call(set, agents, pairs, count, options);
    const auto to = array_of(hits, count, "hits");
    call.run([&] { collide(call.shapes, call.agents, call.pairs, to, call.options); });
  });
}

bch_status bch_within_bodies(const bch_body_set* set, const bch_agents* agents, const bch_pair* pairs,
                             size_t count, const double* distances, size_t distance_count,
                             const bch_query_options* options, uint8_t* answers) {
  return guarded([&] {
    const PairCallOn<bch_body_set> call(set, agents, pairs, count, options);
    const auto near = array_of(distances, distance_count, "distances");
    const auto to = array_of(answers, count, "answers");
    call.run([&] { within(call.shapes, call.agents, call.pairs, near, to, call.options); });
  });
}

bch_status bch_time_of_impact_bodies(const bch_body_set* set, const bch_agents* agents, const bch_pair* pairs,
                                     size_t count, const double* x, const double* y, const double* z,
                                     const bch_query_options* options, float* times) {
  return guarded([&] {
    const PairCallOn<bch_body_set> call(set, agents, pairs, count, options);
    Displacements displacements{array_of(x, count, "x"), array_of(y, count, "y")};
    if (z != nullptr) displacements.z = array_of(z, count, "z");
    const auto to = array_of(times, count, "times");
    call.run([&] { time_of_impact(call.shapes, call.agents, call.pairs, displacements, to, call.options); });
  });
}

bch_status bch_clearance_bodies(const bch_body_set* set, const bch_agents* agents, const bch_pair* pairs,
                                size_t count, const bch_query_options* options,
                                const bch_body_clearance_out* given) {
  return guarded([&] {
    const PairCallOn<bch_body_set> call(set, agents, pairs, count, options);
    const BodyClearanceAnswers to = clearance_answers(given, count);
    call.run([&] { clearance(call.shapes, call.agents, call.pairs, to, call.options); });
  });
}

bch_status bch_penetration_bodies(const bch_body_set* set, const bch_agents* agents, const bch_pair* pairs,
                                  size_t count, uint32_t directions, const bch_query_options* options,
                                  bch_penetration_depth* depths) {
  return guarded([&] {
    const PairCallOn<bch_body_set> call(set, agents, pairs, count, options);
    const auto to = penetrations(depths, count);
    call.run([&] { penetration(call.shapes, call.agents, call.pairs, directions, to, call.options); });
  });
}

bch_status bch_nearest_free_bodies(const bch_body_set* set, const bch_agents* agents, const bch_pair* pairs,
                                   size_t count, uint32_t directions, const bch_query_options* options,
                                   bch_penetration_depth* depths) {
  return bch_nearest_free_bodies_touches(set, agents, pairs, count, directions, options, depths, nullptr);
}

bch_status bch_nearest_free_bodies_touches(const bch_body_set* set, const bch_agents* agents,
                                           const bch_pair* pairs, size_t count, uint32_t directions,
                                           const bch_query_options* options, bch_penetration_depth* depths,
                                           bch_touch* touches) {
  return guarded([&] {
    const PairCallOn<bch_body_set> call(set, agents, pairs, count, options);
    const auto to = penetrations(depths, count);
    const auto ends = touches_of(touches, count);
    call.run([&] { nearest_free(call.shapes, call.agents, call.pairs, directions, to, call.options, ends); });
  });
}

bch_status bch_penetration_along_bodies(const bch_body_set* set, const bch_agents* agents,
                                        const bch_pair* pairs, size_t count, const bch_vec2* directions,
                                        const bch_query_options* options, bch_penetration_depth* depths) {
  return guarded([&] {
    const PairCallOn<bch_body_set> call(set, agents, pairs, count, options);
    const auto along = same_array<Vec2>(directions, count, "directions");
    const auto to = penetrations(depths, count);
    call.run([&] { penetration_along(call.shapes, call.agents, call.pairs, along, to, call.options); });
  });
}
