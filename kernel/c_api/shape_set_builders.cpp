// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <array>
#include <optional>

#include <bch/shapes.hpp>

#include "kernel/baking/pose_baker.hpp"
#include "kernel/c_api/arguments.hpp"
#include "kernel/c_api/custom_characters.hpp"
#include "kernel/c_api/objects.hpp"
#include "kernel/c_api/posing.hpp"
#include "kernel/c_api/work.hpp"
#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "layout/shape_set/builder_mark.hpp"

struct bch_shape_set_builder {
  explicit bch_shape_set_builder(const bch_plan* given)
      : plan(bch::c_api::plan_of(given)), threshold(bch::c_api::threshold_of(given)), prepared(plan) {
    clear(std::make_unique<bch::ShapeSetBuilder>(plan));
  }

  const bch::ShapeSetPlan plan;
  const float threshold;
  bch::BuiltShape prepared;
  std::unique_ptr<bch::ShapeSetBuilder> builder;
  bch::ShapeOrigins origins;

  void clear(std::unique_ptr<bch::ShapeSetBuilder> empty) noexcept {
    builder = std::move(empty);
    origins = {static_cast<double>(threshold), {}, {}};
  }
};

namespace bch::c_api {
namespace {

/// Returns the number of a name among those of a set's origins, where it is the last one or new.
uint32_t number_of(ShapeOrigins& origins, const std::string& name) {
  if (origins.names.empty() || origins.names.back() != name) origins.names.push_back(name);
  return static_cast<uint32_t>(origins.names.size() - 1);
}

/// What the poses of a character are called: its name, then those of its clips.
ShapeOrigin origin_of(ShapeOrigins& origins, const std::string& name, const Character& character,
                      PoseTime at) {
  if (at.clip == PoseTime::rest) return {number_of(origins, name), ShapeOrigin::no_clip, 0};
  const auto first = static_cast<uint32_t>(origins.names.size());
  const std::size_t clips = character.clips.size();
  // As it stands there already where the character was the last one to be added.
  const auto last = origins.names.end() - static_cast<std::ptrdiff_t>(std::min<std::size_t>(first, clips));
  const bool known = first > clips && last[-1] == name &&
                     std::equal(last, origins.names.end(), character.clips.begin(),
                                [](const std::string& clip, const Clip& of) { return clip == of.name; });
  if (!known) {
    origins.names.push_back(name);
    for (const Clip& clip : character.clips) origins.names.push_back(clip.name);
  }
  const uint32_t number = known ? first - static_cast<uint32_t>(clips) - 1 : first;
  return {number, number + 1 + at.clip, at.seconds};
}

/// The same where characters take turns: `known` is what was answered before about this one.
ShapeOrigin origin_of(ShapeOrigins& origins, const bch_character& of, PoseTime at,
                      std::optional<ShapeOrigin>& known) {
  if (known && at.clip == PoseTime::rest) return {known->character, ShapeOrigin::no_clip, 0};
  if (known && known->clip != ShapeOrigin::no_clip)
    return {known->character, known->character + 1 + at.clip, at.seconds};
  known = origin_of(origins, of.name, *of.character, at);
  return *known;
}

/// Adds shapes, all of them or, where that fails, none.
template <class Add>
void all_or_none(bch_shape_set_builder& to, Add add) {
  const detail::BuilderMark end = to.builder->mark();
  const std::size_t names = to.origins.names.size(), origins = to.origins.origins.size();
  try {
    add();
  } catch (...) {
    to.builder->rollback(end);
    to.origins.names.resize(names);
    to.origins.origins.resize(origins);
    throw;
  }
}

/// Adds a shape. `origin_in(origins)` names where it comes from.
template <class OriginIn>
void add(bch_shape_set_builder& to, const Shape& shape, OriginIn origin_in) {
  to.prepared.prepare(shape, to.origins.origins.size());
  all_or_none(to, [&] {
    to.origins.origins.push_back(origin_in(to.origins));
    to.builder->add(to.prepared);
  });
}

/// Adds a shape that has no pose.
void add_without_pose(bch_shape_set_builder& to, const char* kind, const Shape& shape) {
  add(to, shape, [&](ShapeOrigins& in) { return ShapeOrigin{number_of(in, kind), ShapeOrigin::no_clip, 0}; });
}

/// Adds a body of the caller's own.
void add_own(bch_shape_set_builder* handle, const char* kind, const bch_heights* heights,
             const std::function<Shape(const bch_shape_set_builder&)>& make) {
  bch_shape_set_builder& to = object_of(handle, "builder");
  Shape shape = make(to);
  if (heights != nullptr) shape.heights = {heights->bottom, heights->top};
  add_without_pose(to, kind, shape);
}

/// Makes shapes and adds them to a builder, all or none: `make` adds them by a baker, and tells the work of each that is done.
template <class Make>
void add_baked(bch_shape_set_builder& to, std::span<const bch_character* const> characters, std::size_t count,
               const bch_work* given, const Make& make) {
  std::vector<detail::BakedCharacter> named;
  for (const bch_character* const each : characters) named.push_back({each->character.get(), each->name});
  detail::PoseBaker baker(std::move(named), to.plan, to.threshold);
  Work work(given, count);
  all_or_none(to, [&] {
    on_threads(work.threads(), [&] {
      make(baker, detail::BakeSteps{.outlined = [&](std::size_t, const Shape&) { work.part_done(); }});
    });
    work.all_done();
  });
}

/// Adds the shapes that pose_ids name.
void add_pose_ids(bch_shape_set_builder& to, std::span<const bch_character* const> characters,
                  std::span<const PoseId> pose_ids, const bch_work* given) {
  add_baked(
      to, characters, pose_ids.size(), given, [&](detail::PoseBaker& baker, const detail::BakeSteps& steps) {
        baker.add(*to.builder, pose_ids, steps);
        std::vector<std::optional<ShapeOrigin>> known(characters.size());
        for (const auto& [character, at] : pose_ids)
          to.origins.origins.push_back(origin_of(to.origins, *characters[character], at, known[character]));
      });
}

void check_pose_ids(std::span<const bch_character* const> characters, std::span<const bch_pose_id> pose_ids) {
  for (const bch_character* const character : characters) object_of(character, "a character of characters");
  for (std::size_t i = 0; i < pose_ids.size(); ++i) {
    if (pose_ids[i].character >= characters.size())
      throw Failure(BCH_OUT_OF_RANGE, "pose_ids[" + std::to_string(i) + "].character is " +
                                          std::to_string(pose_ids[i].character) + " of " +
                                          std::to_string(characters.size()));
    check_pose(*characters[pose_ids[i].character]->character, pose_ids[i].at, i);
  }
}

/// Makes the set of all shapes of a builder, which is then empty.
void finish(bch_shape_set_builder& builder, bch_shape_set** set) {
  required(set, "set");
  auto next = std::make_unique<ShapeSetBuilder>(builder.plan);
  // All that may need memory comes first, so that the shapes are here or there.
  bch_shape_set* made = nullptr;
  hand_out(std::make_unique<bch_shape_set>(BakedShapes{ShapeSetBuilder(builder.plan).finish(), {}}), &made);
  try {
    made->own->set = std::move(*builder.builder).finish();
  } catch (...) {
    take_back(made, "set");
    throw;
  }
  made->own->origins = std::move(builder.origins);
  builder.clear(std::move(next));
  *set = made;
}

}  // namespace
}  // namespace bch::c_api

using namespace bch;
using namespace bch::c_api;

bch_status bch_shape_set_builder_create(const bch_plan* plan, bch_shape_set_builder** builder) {
  return guarded([&] {
    required(builder, "builder");
    hand_out(std::make_unique<bch_shape_set_builder>(plan), builder);
  });
}

bch_status bch_shape_set_builder_add_poses(bch_shape_set_builder* handle, const bch_character* character,
                                           const bch_pose* poses, size_t count, const bch_work* work) {
  return guarded([&] {
    bch_shape_set_builder& builder = object_of(handle, "builder");
    const bch_character& of = object_of(character, "character");
    const auto all = array_of(poses, count, "poses");
    check_poses(*of.character, all);
    std::vector<PoseId> pose_ids;
    for (const bch_pose& pose : all) pose_ids.push_back({0, {pose.clip, pose.seconds}});
    const bch_character* const characters[] = {&of};
    add_pose_ids(builder, characters, pose_ids, work);
  });
}

bch_status bch_shape_set_builder_add_pose_arrays(bch_shape_set_builder* handle,
                                                 const bch_character* character, const bch_pose_arrays* poses,
                                                 size_t count, const bch_work* work) {
  return guarded([&] {
    bch_shape_set_builder& builder = object_of(handle, "builder");
    const bch_character& of = object_of(character, "character");
    const bch_character* const characters[] = {&of};
    const CustomPoses own(poses, count);
    add_baked(builder, characters, count, work,
              [&](detail::PoseBaker& baker, const detail::BakeSteps& steps) {
                const auto pose_of = [&](std::size_t i) { return detail::PoseOfCharacter{0, own[i]}; };
                baker.add(*builder.builder, count, pose_of, steps);
                std::optional<ShapeOrigin> known;
                for (std::size_t i = 0; i < count; ++i)
                  builder.origins.origins.push_back(origin_of(builder.origins, of, {}, known));
              });
  });
}

bch_status bch_shape_set_builder_add_pose_ids(bch_shape_set_builder* handle,
                                              const bch_character* const* characters, size_t character_count,
                                              const bch_pose_id* pose_ids, size_t count,
                                              const bch_work* work) {
  return guarded([&] {
    bch_shape_set_builder& builder = object_of(handle, "builder");
    const auto of = array_of(characters, character_count, "characters");
    const auto all = array_of(pose_ids, count, "pose_ids");
    check_pose_ids(of, all);
    std::vector<PoseId> shapes;
    for (const auto& [character, at] : all) shapes.push_back({character, {at.clip, at.seconds}});
    add_pose_ids(builder, of, shapes, work);
  });
}

bch_status bch_shape_set_builder_add_shape(bch_shape_set_builder* handle,
                                           const bch_shape_builder* shape_builder) {
  return guarded([&] {
    bch_shape_set_builder& builder = object_of(handle, "builder");
    const bch_shape_builder& by = object_of(shape_builder, "shape_builder");
    add(builder, made_by(by), [&](ShapeOrigins& in) { return origin_of(in, by.name, *by.character, by.at); });
  });
}

bch_status bch_shape_set_builder_add_polygons(bch_shape_set_builder* builder, const bch_vec2* corners,
                                              const uint64_t* offsets, size_t polygons,
                                              const bch_heights* heights) {
  return guarded([&] {
    add_own(builder, "polygons", heights, [&](const bch_shape_set_builder& to) {
      return shape_from_polygons(parts_of<Vec2>(corners, offsets, polygons, "corners"), to.threshold);
    });
  });
}

bch_status bch_shape_set_builder_add_capsules(bch_shape_set_builder* builder, const bch_capsule* capsules,
                                              size_t count, float tolerance, const bch_heights* heights) {
  return guarded([&] {
    add_own(builder, "capsules", heights, [&](const bch_shape_set_builder& to) {
      return shape_from_capsules(same_array<Capsule>(capsules, count, "capsules"), tolerance, to.threshold);
    });
  });
}

bch_status bch_shape_set_builder_add_discs(bch_shape_set_builder* builder, const bch_disc* discs,
                                           size_t count, const bch_heights* heights) {
  return guarded([&] {
    add_own(builder, "discs", heights, [&](const bch_shape_set_builder&) {
      return shape_from_discs(same_array<Disc>(discs, count, "discs"));
    });
  });
}

bch_status bch_shape_set_builder_add_cylinder(bch_shape_set_builder* builder, float radius,
                                              const bch_heights* heights) {
  return guarded([&] {
    add_own(builder, "cylinder", heights, [&](const bch_shape_set_builder&) {
      Shape shape;  // made first: GCC 12 would destroy a braced one twice where the next line throws
      shape.hierarchy = detail::fixed_cylinder(radius);
      return shape;
    });
  });
}

bch_status bch_shape_set_builder_add_mesh(bch_shape_set_builder* handle, const bch_vec3* positions,
                                          size_t position_count, const uint32_t* triangles,
                                          size_t triangle_count) {
  return guarded([&] {
    bch_shape_set_builder& builder = object_of(handle, "builder");
    if (triangle_count > SIZE_MAX / 3) throw Failure(BCH_INVALID_ARGUMENT, "triangle_count is too large");
    const Character mesh = character_of_mesh(array_of(positions, position_count, "positions"),
                                             array_of(triangles, 3 * triangle_count, "triangles"));
    ShapeBuilder shape_builder(mesh, builder.plan, builder.threshold);
    add_without_pose(builder, "mesh", shape_builder.shape({}));
  });
}

bch_status bch_shape_set_builder_add_animated_shape(bch_shape_set_builder* handle,
                                                    const bch_animated_shape* shape, double seconds) {
  return guarded([&] {
    bch_shape_set_builder& builder = object_of(handle, "builder");
    const bch_animated_shape& of = object_of(shape, "shape");
    if (!detail::is_finite(seconds))
      throw Failure(BCH_INVALID_ARGUMENT,
                    "seconds is " + detail::shortest(seconds) + "; expected a finite number");
    add_without_pose(builder, "moment", of.shape.shape(seconds));
  });
}

bch_status bch_shape_set_builder_finish(bch_shape_set_builder* handle, bch_shape_set** set) {
  return guarded([&] { finish(object_of(handle, "builder"), set); });
}

bch_status bch_bake(const bch_character* const* characters, size_t character_count, uint32_t poses,
                    const bch_plan* plan, const bch_work* work, bch_shape_set** set) {
  return guarded([&] {
    const auto of = array_of(characters, character_count, "characters");
    required(set, "set");
    std::vector<PoseId> pose_ids;
    for (std::uint32_t i = 0; i < of.size(); ++i)
      for (const PoseTime at : sample_poses(*object_of(of[i], "a character of characters").character, poses))
        pose_ids.push_back({i, at});
    bch_shape_set_builder builder(plan);
    add_pose_ids(builder, of, pose_ids, work);
    finish(builder, set);
  });
}

bch_status bch_shape_set_builder_free(bch_shape_set_builder* builder) {
  return free_object(builder, "builder");
}
