// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <list>
#include <mutex>

#include <bch/shapes.hpp>

#include "kernel/c_api/arguments.hpp"
#include "kernel/c_api/objects.hpp"
#include "kernel/c_api/posing.hpp"
#include "kernel/c_api/work.hpp"
#include "kernel/runtime/spares.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/shortest.hpp"

namespace bch::c_api {
namespace {

/// Makes shapes for one thread at a time. It keeps what it learned of characters.
class Workshop {
 public:
  explicit Workshop(const ShapeSetPlan& plan) : plan_(plan), prepared_(plan) {}

  const BuiltShape& make(const std::shared_ptr<const Character>& character, float threshold, const Pose& pose,
                         std::size_t i, uint32_t shape) {
    prepared_.prepare(shape_of_pose(shape_builder(character, threshold), pose, i), shape);
    return prepared_;
  }

 private:
  struct Learned {
    Learned(const std::shared_ptr<const Character>& of, const ShapeSetPlan& plan, float down_to)
        : character(of), threshold(down_to), shape_builder(*of, plan, down_to) {}

    const std::shared_ptr<const Character> character;
    const float threshold;
    ShapeBuilder shape_builder;
  };
  const ShapeSetPlan plan_;
  BuiltShape prepared_;
  std::list<Learned> learned_;

  ShapeBuilder& shape_builder(const std::shared_ptr<const Character>& character, float threshold) {
    for (Learned& each : learned_)
      if (each.character == character && each.threshold == threshold) return each.shape_builder;
    return learned_.emplace_back(character, plan_, threshold).shape_builder;
  }
};

}  // namespace
}  // namespace bch::c_api

struct bch_dynamic_shape_set {
  explicit bch_dynamic_shape_set(const bch::ShapeSet& start)
      : dynamic(start), plan(dynamic.set().plan()), lent(std::make_unique<bch_shape_set>(dynamic.set())) {}

  bch::DynamicShapeSet dynamic;
  const bch::ShapeSetPlan plan;
  std::unique_ptr<bch_shape_set> lent;
  bch::detail::Spares<bch::c_api::Workshop> workshops;
};

namespace bch::c_api {
namespace {

void check_shapes(const ShapeSet& set, std::span<const uint32_t> shapes) {
  std::vector<bool> named(set.shape_count());
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const std::string which = "shapes[" + std::to_string(i) + "] is " + std::to_string(shapes[i]);
    if (shapes[i] >= named.size())
      throw Failure(BCH_OUT_OF_RANGE, which + " of " + std::to_string(named.size()));
    if (named[shapes[i]]) throw Failure(BCH_INVALID_ARGUMENT, which + ", as one before");
    named[shapes[i]] = true;
  }
}

/// `pose_at(i)` gives the pose of shapes[i].
template <class PoseAt>
void replace_poses(bch_dynamic_shape_set& set, const bch_character& of, std::span<const uint32_t> shapes,
                   PoseAt pose_at, float threshold, const bch_work* given) {
  check_shapes(set.dynamic.set(), shapes);
  if (!(threshold > 0 && threshold <= 1e6f))
    throw Failure(BCH_INVALID_ARGUMENT,
                  "threshold is " + detail::shortest(threshold) + "; expected above 0 and at most 1e6 m");
  Work work(given, shapes.size());
  const auto make = [&](Workshop& by, std::size_t i) -> const BuiltShape& {
    return by.make(of.character, threshold, pose_at(i), i, shapes[i]);
  };
  const auto new_workshop = [&] { return Workshop(set.plan); };
  std::vector<std::size_t> outgrown;
  std::mutex of_outgrown;
  const auto replace_range = [&](std::size_t begin, std::size_t end) {
    const auto workshop = set.workshops.borrow(new_workshop);
    for (std::size_t i = begin; i < end; ++i) {
      if (!set.dynamic.try_replace(shapes[i], make(*workshop, i))) {
        const std::lock_guard lock(of_outgrown);
        outgrown.push_back(i);
      }
      work.part_done();
    }
  };
  on_threads(work.threads(), [&] { detail::for_ranges(shapes.size(), 1, replace_range); });
  const auto workshop = set.workshops.borrow(new_workshop);
  for (const std::size_t i : outgrown) set.dynamic.replace(shapes[i], make(*workshop, i));
  work.all_done();
}

}  // namespace
}  // namespace bch::c_api

using namespace bch;
using namespace bch::c_api;

bch_status bch_dynamic_shape_set_create(const bch_shape_set* start, bch_dynamic_shape_set** set) {
  return guarded([&] {
    required(set, "set");
    auto made = std::make_unique<bch_dynamic_shape_set>(object_of(start, "start").set);
    const bch_shape_set* const lent = made->lent.get();
    hand_out(std::move(made), lent, set);
  });
}

bch_status bch_dynamic_shape_set_get_shapes(const bch_dynamic_shape_set* set, const bch_shape_set** shapes) {
  return guarded([&] {
    const bch_shape_set* const lent = object_of(set, "set").lent.get();
    required(shapes, "shapes") = lent;
  });
}

bch_status bch_dynamic_shape_set_replace(bch_dynamic_shape_set* handle, uint32_t shape,
                                         const bch_shape_builder* shape_builder) {
  return guarded([&] {
    bch_dynamic_shape_set& set = object_of(handle, "set");
    BuiltShape prepared(set.plan);
    prepared.prepare(made_by(object_of(shape_builder, "shape_builder")), shape);
    set.dynamic.replace(shape, prepared);
  });
}

bch_status bch_dynamic_shape_set_replace_poses(bch_dynamic_shape_set* handle, const bch_character* character,
                                               const uint32_t* shapes, const bch_pose* poses, size_t count,
                                               float threshold, const bch_work* work) {
  return guarded([&] {
    bch_dynamic_shape_set& set = object_of(handle, "set");
    const bch_character& of = object_of(character, "character");
    const auto which = array_of(shapes, count, "shapes");
    const auto at = array_of(poses, count, "poses");
    check_poses(*of.character, at);
    replace_poses(
        set, of, which, [&](std::size_t i) { return pose_of(at[i]); }, threshold, work);
  });
}

bch_status bch_dynamic_shape_set_replace_pose_arrays(bch_dynamic_shape_set* handle,
                                                     const bch_character* character, const uint32_t* shapes,
                                                     const bch_pose_arrays* poses, size_t count,
                                                     float threshold, const bch_work* work) {
  return guarded([&] {
    bch_dynamic_shape_set& set = object_of(handle, "set");
    const bch_character& of = object_of(character, "character");
    const CustomPoses own(poses, count);
    replace_poses(
        set, of, array_of(shapes, count, "shapes"), [&](std::size_t i) { return own[i]; }, threshold, work);
  });
}

bch_status bch_dynamic_shape_set_free(bch_dynamic_shape_set* set) {
  return guarded([&] {
    if (const auto taken = take_back(set, "set")) registry::end_loan(taken->lent.get());
  });
}
