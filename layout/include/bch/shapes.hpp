// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <bch/geometry.hpp>
#include <bch/hierarchy.hpp>
#include <bch/outline.hpp>

namespace bch::detail {
struct AnimatedTree;
struct BuilderMark;
struct FlatBody;
struct ShapeArrays;
struct ShapeSetView;
}  // namespace bch::detail

namespace bch {

/// Represents a body seen from above: a pose of a character, a footprint, a cylinder.
/// The outline may be empty. Then the discs decide alone: containment without overlapping discs is no
/// collision.
struct Shape {
  Outline outline;
  Hierarchy hierarchy;
  Heights heights = {};  ///< by default the body takes part at every height
};

/// Makes a shape of given discs, such as the three to fifty of a body in mechanical crowd models.
/// The discs are enlarged only by the rounding margin, and queries number them as they are given. The shape
/// has no outline. Neighbouring discs should follow each other, because nodes group them in that order.
/// Cost:    6 ms for 50 discs.
/// Errors:  throws std::invalid_argument on no discs or more than 4096, on a disc that is not finite or
///          without a radius, naming it, or on a reach outside 1e-6 to 1e6 m.
Shape shape_from_discs(std::span<const Disc> discs);

/// Makes a shape of given polygons, a wheelchair's for instance, as outline_from_polygons() takes them.
/// Its exact leaves are the polygons themselves.
/// Units:   metres; the threshold is that of contour_hierarchy().
/// Errors:  throws std::invalid_argument as outline_from_polygons() and contour_hierarchy() do.
Shape shape_from_polygons(std::span<const std::vector<Vec2>> polygons, float threshold = 0.01f);

/// Represents the points within a radius of a segment of the ground plane, metres, in the shape's frame.
/// (BodySet::Capsule is one in space.)
struct Capsule {
  Vec2 a, b;
  float radius;
};

/// Makes a shape of given capsules, such as the limbs of a body.
/// The outline encloses each capsule in a polygon that is nowhere farther from it than a tolerance.
/// Units:   metres; the tolerance is more than 2^-20 of the capsules' reach, the threshold is that of
///          contour_hierarchy().
/// Errors:  throws std::invalid_argument on no capsules, on a capsule without a radius or beyond 1e6 m,
///          naming it, on a tolerance that is not positive or too small, and as shape_from_polygons().
Shape shape_from_capsules(std::span<const Capsule> capsules, float tolerance = 0.001f,
                          float threshold = 0.01f);

/// Describes discs that move through a part of a clip; with heights they are spheres.
/// Each disc goes straight on from key to key: its centre and its radius are linear in time.
struct AnimatedChunk {
  std::vector<double> times;     ///< of the keys, at least two, ascending; seconds of the clip
  std::uint32_t disc_count = 0;  ///< the number of discs at each key
  std::vector<Disc> keys;        ///< times.size() * disc_count, key by key; in the shape's frame, metres
  /// Heights of the centres of spheres, as many as keys; of all chunks or none.
  /// Discs without heights are cylinders of infinite height.
  std::vector<float> z = {};
  friend bool operator==(const AnimatedChunk&, const AnimatedChunk&) = default;
};

/// Describes a clip as moving discs: chunks that follow one another in time, each beginning when the one
/// before it ends.
struct AnimatedDiscs {
  std::vector<AnimatedChunk> chunks;  ///< from the clip's beginning to its end
  bool loops = false;                 ///< whether the clip repeats; it then lasts at least 1 ms
  Heights heights = {};               ///< of the body at all times; by default it takes part at every height
  friend bool operator==(const AnimatedDiscs&, const AnimatedDiscs&) = default;
};

/// Checks that moving discs are well-formed, as AnimatedShape needs them.
/// Times are finite, within +-1e6 s, ascend and leave no gap; a chunk has at least two keys and 1 to 4096
/// discs; heights are of all chunks or none, within +-1e6 m; a loop lasts at least 1 ms; the reach is 1e-6 to
/// 1e6 m.
/// Errors:  throws std::invalid_argument on anything else, naming the chunk, the disc and the key.
void validate(const AnimatedDiscs& discs);

/// Represents an animated body: a clip of a character, or other moving discs or spheres.
/// Times outside the clip are clamped or, if the clip loops, wrap around, even if its last pose is not its
/// first. Discs of animate() are kept exactly; others are rounded outward to 16 bits, by less than 0.15 mm
/// per metre of reach. "Animated shapes" in layout/README.md describes the tree. An object that was moved
/// from can only be assigned to or destroyed.
class AnimatedShape {
 public:
  /// Checks moving discs and builds the tree over them.
  /// Cost:    1 ms for 200 discs at 10 keys.
  /// Errors:  throws std::invalid_argument as validate() does.
  explicit AnimatedShape(const AnimatedDiscs& discs);
  AnimatedShape(AnimatedShape&&) noexcept;
  AnimatedShape& operator=(AnimatedShape&&) noexcept;
  ~AnimatedShape();

  double begin() const noexcept;  ///< seconds of the clip
  double end() const noexcept;
  bool loops() const noexcept;
  /// Returns the heights of the body at all times.
  const Heights& heights() const noexcept { return heights_; }
  /// Returns whether its discs are spheres.
  bool in_space() const noexcept;
  /// Returns the radius about the agent's position that holds all discs at every time, metres.
  /// Spheres count as seen from above.
  double reach() const noexcept;
  std::size_t bytes() const noexcept;
  /// Returns the discs at a time, as they are kept, in the order in which they were given.
  /// Spheres are discs as seen from above.
  std::vector<Disc> discs(double seconds) const;
  /// Returns the spheres at a time, likewise; none of a body that is not in space.
  std::vector<Sphere> spheres(double seconds) const;
  /// Returns the body at a time as a shape without outline, whose leaves are its discs.
  /// They are numbered in the order of the current chunk's tree, not in that of discs(): numbers can change
  /// from chunk to chunk. A set takes the shape, and so does a BuiltShape for a DynamicShapeSet.
  /// Cost:    a few us for 200 discs, less than making it flat.
  Shape shape(double seconds) const;
  /// Writes that shape into `shape`, and reuses its memory.
  void shape(double seconds, Shape& shape) const;

  // For the library's own parts, which alone know these types.
  /// Returns the tree of the discs.
  const detail::AnimatedTree& tree() const noexcept { return *tree_; }

 private:
  std::unique_ptr<detail::AnimatedTree> tree_;
  Heights heights_;
};

/// Selects what makes two leaves meet.
enum class Leaves {
  discs,  ///< their discs overlap
  /// Their discs overlap, and their segments come within 1.7 um per metre of both reaches (exact leaves).
  /// This applies to agents at depth all_depths whose shapes have exact leaves. Otherwise, and for leaves of
  /// more than 127 segments, discs decide.
  segments,
};

/// Describes what a scene will use of its shapes; nothing else is built or stored.
struct ShapeSetPlan {
  /// Lists the levels of detail: cut depths, ascending. Level k of every shape is its cut at depths[k].
  std::vector<std::uint32_t> depths = {all_depths};
  /// Says whether to keep the outlines.
  /// Without them discs alone decide: containment without overlapping discs is no hit, and there are no exact
  /// leaves. Exact leaves exist at depth all_depths, for shapes whose cut is more than one disc and whose
  /// hierarchy has its primitives.
  bool outlines = true;
  /// Says whether to keep culling data, which lets queries skip most traversals and changes no answer.
  /// It consists of 32-DOPs, profiles and, with outlines, inscribed discs, and does not pay for a set that
  /// answers few queries.
  bool culling = true;
  /// Says whether to keep the heights of bodies, which agents at different heights need; see Agents::z.
  bool heights = false;
  friend bool operator==(const ShapeSetPlan&, const ShapeSetPlan&) = default;
};

/// Checks that a plan is one that ShapeSet takes.
/// Errors:  throws std::invalid_argument on a plan without depths, with more than 255, or with depths out of
///          order.
void validate(const ShapeSetPlan& plan);

/// Holds the flat form of many shapes for batch queries: structure of arrays, aligned to cache lines,
/// immutable.
/// An object that was moved from can only be assigned to or destroyed.
class ShapeSet {
 public:
  /// Makes shapes flat, each at all depths of a plan, and copies what it needs of them.
  /// Errors:  throws std::invalid_argument on a plan that validate() rejects and, naming the shape, on a
  ///          hierarchy or a non-empty outline (if the plan uses it) that validate() rejects;
  ///          std::length_error beyond 2^31 floats in the nodes' arrays.
  explicit ShapeSet(std::span<const Shape> shapes, const ShapeSetPlan& plan = {});
  ShapeSet(ShapeSet&&) noexcept;
  ShapeSet& operator=(ShapeSet&&) noexcept;
  ~ShapeSet();

  std::uint32_t shape_count() const noexcept;
  std::uint32_t level_count() const noexcept { return static_cast<std::uint32_t>(depths().size()); }
  std::span<const std::uint32_t> depths() const noexcept;
  /// Returns whether the heights of bodies are kept, so that agents may have a z.
  bool has_heights() const noexcept;
  /// Returns whether some level of some shape has exact leaves.
  bool exact_leaves() const noexcept;
  /// Returns whether every cut is a single disc: there are roots and nothing else.
  bool roots_only() const noexcept;
  /// Returns the plan of what is stored. A roots-only set has neither outlines nor culling data.
  ShapeSetPlan plan() const;
  std::size_t bytes() const noexcept;

  /// Returns the discs of a shape's cut, in the order in which queries number them.
  /// Errors:  throws std::out_of_range on an index out of range.
  std::vector<Disc> discs(std::uint32_t shape, std::uint32_t level) const;
  /// Returns the radius that holds all discs of a shape at every level and heading, metres.
  /// It is one about the agent's position. Takes time linear in the discs.
  /// Errors:  throws std::out_of_range on an index out of range.
  float bounding_radius(std::uint32_t shape) const;

  // For the library's own parts, which alone know these types.

  /// Views arrays that live as long as `memory`, a mapped file for instance.
  /// Precondition: validate(arrays) does not throw.
  ShapeSet(const detail::ShapeArrays& arrays, std::shared_ptr<const void> memory);
  /// Views other arrays from now on.
  void rebind(const detail::ShapeArrays& arrays) noexcept;
  const detail::ShapeSetView& view() const noexcept;
  const detail::ShapeArrays& arrays() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Holds a shape in its flat form, ready to be added to a set.
/// Preparing shapes is nearly all the work of making a set; an object keeps its memory for the next shape. An
/// object that was moved from can only be assigned to or destroyed.
/// Threads: one at a time may use an object.
class BuiltShape {
 public:
  /// Takes the plan of the sets that the shapes are for.
  /// Errors:  throws std::invalid_argument on a bad plan.
  explicit BuiltShape(const ShapeSetPlan& plan);
  BuiltShape(BuiltShape&&) noexcept;
  BuiltShape& operator=(BuiltShape&&) noexcept;
  ~BuiltShape();

  /// Makes a shape flat, in place of the previous one.
  /// Errors:  throws std::invalid_argument as ShapeSet does, with `index` as the shape's number; then call
  ///          prepare() again.
  void prepare(const Shape& shape, std::size_t index);

  // For the library's own parts, which alone know these types.
  /// Returns the arrays that builders and sets copy.
  detail::FlatBody& flat() noexcept;
  const detail::FlatBody& flat() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Builds a set shape by shape, without all shapes in memory.
/// The set is the same, byte for byte, as ShapeSet makes of all at once. An object that was moved from can
/// only be assigned to or destroyed.
class ShapeSetBuilder {
 public:
  /// Begins an empty set of a plan.
  /// `expected_shapes` is an estimate for which memory is reserved; any number may be added.
  /// Errors:  throws std::invalid_argument on a bad plan.
  explicit ShapeSetBuilder(const ShapeSetPlan& plan, std::size_t expected_shapes = 0);
  ShapeSetBuilder(ShapeSetBuilder&&) noexcept;
  ShapeSetBuilder& operator=(ShapeSetBuilder&&) noexcept;
  ~ShapeSetBuilder();

  /// Adds a shape that was prepared with the same plan.
  /// Errors:  throws std::length_error beyond 2^31 floats in the nodes' arrays or 2^32 roots. Shapes that
  ///          were added before are then unchanged.
  void add(const BuiltShape& shape);
  /// Returns the set of the shapes so far.
  /// It can be queried until the next call of another function; more shapes may follow.
  const ShapeSet& set();
  /// Returns the set of the shapes that were added. Where memory runs out, the shapes stay in the builder.
  ShapeSet finish() &&;

  // For the library's own parts, which alone know these types.
  /// Returns the nodes of the shapes so far, or none for sets of only roots.
  /// They are as the set is going to have them, and valid until the next call of another function.
  std::span<const float> nodes() const noexcept;
  /// Returns the present end of the set, for rollback().
  detail::BuilderMark mark() const noexcept;
  /// Removes all that was added since mark() returned `to`. Allocates nothing.
  void rollback(const detail::BuilderMark& to) noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Holds a set whose shapes are replaced while it lives, for characters whose poses are new in every frame.
///
///     PoseShaper shaper(character);                  // each thread has its own shaper and prepared shape
///     BuiltShape prepared(dynamic.set().plan());
///     prepared.prepare(shaper.shape({clip, seconds}), shape);
///     if (!dynamic.try_replace(shape, prepared)) later.push_back(shape);  // for replace(), by one thread
/// See:     "Plans" in layout/README.md, for how memory grows and after some frames no longer does.
class DynamicShapeSet {
 public:
  /// Copies a set, another one's set() for instance, with its plan and without its unused gaps.
  /// A copy of a roots-only set accepts only single-disc shapes. One that was moved from can only be assigned
  /// to or destroyed.
  explicit DynamicShapeSet(const ShapeSet& start);
  DynamicShapeSet(DynamicShapeSet&&) noexcept;
  DynamicShapeSet& operator=(DynamicShapeSet&&) noexcept;
  ~DynamicShapeSet();

  /// Returns the present shapes.
  /// Once a shape has been replaced, the set can be queried and copied but not baked, because its arrays may
  /// have gaps. To bake it, copy it.
  const ShapeSet& set() const noexcept;

  /// Replaces a shape by one that was prepared with set().plan(), if the new one fits into its place.
  /// Threads may replace different shapes at the same time, while no query runs. Allocates nothing.
  /// Returns: whether it fitted. If not, the set is unchanged and replace() is needed. Nor does the first
  ///          single-disc shape of a one-level set fit, because replace() has to update the set.
  /// Errors:  throws std::out_of_range on an index out of range, std::invalid_argument on a shape of another
  ///          plan.
  bool try_replace(std::uint32_t shape, const BuiltShape& by);

  /// Replaces a shape, if need be in a new place.
  /// Only one thread may call it at a time: arrays may move, and earlier views of set() are then invalid.
  /// Takes time linear in the number of shapes where try_replace() would refuse.
  /// Errors:  as try_replace(); std::length_error as ShapeSet. The shape is then the previous one.
  void replace(std::uint32_t shape, const BuiltShape& by);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bch
