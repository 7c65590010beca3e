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
/// If the outline is empty, only discs are tested: a body in a gap between the discs of another one does not
/// collide.
struct Shape {
  Outline outline;
  Hierarchy hierarchy;
  Heights heights = {};  ///< by default all heights
};

/// Makes a shape of discs, such as the three to fifty discs of a body in mechanical crowd models.
/// The shape has no outline. Discs are enlarged only by the rounding margin, and queries number them in the
/// given order. Discs near each other should follow each other, because nodes of the tree group them in that
/// order.
/// Cost:    6 ms for 50 discs.
/// Errors:  throws std::invalid_argument if there are no discs or more than 4096, if the extent is outside
///          1e-6 to 1e6 m, or if a disc, which is named, is not finite or has no radius.
Shape shape_from_discs(std::span<const Disc> discs);

/// Makes a shape of polygons, for instance of a wheelchair. They are those of outline_from_polygons().
/// Its exact leaves are the polygons themselves.
/// Units:   metres; discs of a radius below the threshold are not divided.
/// Errors:  throws std::invalid_argument as outline_from_polygons() and contour_hierarchy() do.
Shape shape_from_polygons(std::span<const std::vector<Vec2>> polygons, float threshold = 0.01f);

/// Represents the points within a radius of a segment of the ground plane, metres, in the shape's frame.
/// (BodySet::Capsule lies in space.)
struct Capsule {
  Vec2 a, b;
  float radius;
};

/// Makes a shape of capsules, such as the limbs of a body.
/// The outline has one polygon per capsule, which encloses the capsule and protrudes from it by at most a
/// tolerance.
/// Units:   metres; the tolerance must exceed 2^-20 of the capsules' extent; the threshold is as above.
/// Errors:  throws std::invalid_argument if there are no capsules, if the tolerance is not positive or too
///          small, if a capsule, which is named, has no radius or lies beyond 1e6 m, and as
///          shape_from_polygons() does.
Shape shape_from_capsules(std::span<const Capsule> capsules, float tolerance = 0.001f,
                          float threshold = 0.01f);

/// Describes a chunk: a part of a clip, and its moving discs, which are spheres if they have heights.
/// Centres and radii change linearly from key to key.
struct AnimatedChunk {
  std::vector<double> times;     ///< of the keys, at least two, ascending; seconds of the clip
  std::uint32_t disc_count = 0;  ///< the number of discs at each key
  std::vector<Disc> keys;        ///< times.size() * disc_count, key by key; in the shape's frame, metres
  /// Heights of the centres of spheres, in the order of `keys`; in all chunks or in none.
  /// Without heights, discs are cylinders of infinite height.
  std::vector<float> z = {};
  friend bool operator==(const AnimatedChunk&, const AnimatedChunk&) = default;
};

/// Describes a clip as moving discs, in chunks. Each chunk begins when the chunk before it ends.
struct AnimatedDiscs {
  std::vector<AnimatedChunk> chunks;  ///< from the clip's beginning to its end
  bool loops = false;                 ///< whether the clip repeats; it then lasts at least 1 ms
  Heights heights = {};               ///< range of the body over the whole clip; by default all
  friend bool operator==(const AnimatedDiscs&, const AnimatedDiscs&) = default;
};

/// Checks what AnimatedShape expects of moving discs.
/// Times are finite, within +-1e6 s, ascend and leave no gap. A chunk has at least two keys and 1 to 4096
/// discs. All chunks have heights or none has; heights are within +-1e6 m. A clip that loops lasts at least 1
/// ms. The extent is 1e-6 to 1e6 m.
/// Errors:  throws std::invalid_argument naming the chunk, the disc and the key.
void validate(const AnimatedDiscs& discs);

/// Represents an animated body: a clip of a character, or other moving discs or spheres.
/// Times outside the clip are clamped or, if the clip loops, wrap around, even if the last pose is not the
/// first. Discs of animate() are stored exactly. Other discs are rounded outward to 16-bit numbers, by less
/// than 0.15 mm per metre of extent. "Animated shapes" in layout/README.md describes the tree. A moved-from
/// object can only be assigned to or destroyed.
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
  double end() const noexcept;    ///< likewise
  bool loops() const noexcept;
  /// Returns the interval of heights of the body over the whole clip.
  const Heights& heights() const noexcept { return heights_; }
  /// Returns whether the discs are spheres.
  bool in_space() const noexcept;
  /// Returns the radius about the agent's position that encloses all discs at every time, metres.
  /// For spheres, their discs as seen from above are enclosed.
  double bounding_radius() const noexcept;
  std::size_t bytes() const noexcept;
  /// Returns the discs at a time as stored, in the order of AnimatedDiscs.
  /// For spheres, returns their discs as seen from above.
  std::vector<Disc> discs(double seconds) const;
  /// Returns the spheres at a time, in the same order; empty if the body is made of discs.
  std::vector<Sphere> spheres(double seconds) const;
  /// Returns the body at a time as a shape without outline, whose leaves are its discs.
  /// The leaves are numbered in the order of the current chunk's tree, not of discs(), so numbers can change
  /// from chunk to chunk. Pass the shape to ShapeSet or BuiltShape.
  /// Cost:    a few us for 200 discs, less than packing it (BuiltShape).
  Shape shape(double seconds) const;
  /// Writes the same shape into `shape`, whose memory is reused.
  void shape(double seconds, Shape& shape) const;

  // Internal, for the library's own code; the type AnimatedTree is not public.
  /// Returns the tree of the discs.
  const detail::AnimatedTree& tree() const noexcept { return *tree_; }

 private:
  std::unique_ptr<detail::AnimatedTree> tree_;
  Heights heights_;
};

/// Selects the test of two leaves.
enum class Leaves {
  discs,  ///< the discs of the leaves overlap
  /// The discs overlap, and segments of the outlines in the two leaves come within 1.7 um per metre of the
  /// sum of both extents (exact leaves).
  /// This applies to agents at depth all_depths whose shapes have exact leaves (see ShapeSetPlan). For other
  /// agents, and for leaves of more than 127 segments, discs decide.
  segments,
};

/// Selects what a set stores of its shapes; nothing else is built.
struct ShapeSetPlan {
  /// Lists the levels of detail: cut depths, ascending. Level k of a shape is its cut at depths[k].
  std::vector<std::uint32_t> depths = {all_depths};
  /// Whether to store outlines. Without them only discs are tested (see Shape), and there are no exact
  /// leaves.
  /// Exact leaves exist at depth all_depths, for shapes whose cut has more than one disc and whose hierarchy
  /// has primitives.
  bool outlines = true;
  /// Whether to store culling data, which make queries faster and change no answer: bounds of the shape along
  /// 32 directions and in 32 sectors and, with outlines, discs inside it. For a set that answers few queries,
  /// building them takes longer than they save.
  bool culling = true;
  /// Whether to store the heights of bodies, which agents at different heights need; see Agents::z.
  bool heights = false;
  friend bool operator==(const ShapeSetPlan&, const ShapeSetPlan&) = default;
};

/// Checks that ShapeSet accepts a plan.
/// Errors:  throws std::invalid_argument if the plan has no depths or more than 255, or depths that do not
///          ascend.
void validate(const ShapeSetPlan& plan);

/// Holds many shapes in flat form for batch queries: immutable, as structures of arrays that are aligned to
/// cache lines.
/// A moved-from object can only be assigned to or destroyed.
class ShapeSet {
 public:
  /// Packs shapes, each at all depths of a plan, and copies all that the plan stores.
  /// Errors:  throws std::invalid_argument if validate() rejects the plan or, naming the shape, a hierarchy
  ///          or an outline that is stored and not empty; std::length_error beyond 2^31 floats in the arrays
  ///          of nodes.
  explicit ShapeSet(std::span<const Shape> shapes, const ShapeSetPlan& plan = {});
  ShapeSet(ShapeSet&&) noexcept;
  ShapeSet& operator=(ShapeSet&&) noexcept;
  ~ShapeSet();

  std::uint32_t shape_count() const noexcept;
  std::uint32_t level_count() const noexcept { return static_cast<std::uint32_t>(depths().size()); }
  std::span<const std::uint32_t> depths() const noexcept;
  /// Returns whether heights of bodies are stored, so that agents may have a z.
  bool has_heights() const noexcept;
  /// Returns whether any shape has exact leaves at any level.
  bool exact_leaves() const noexcept;
  /// Returns whether every cut is a single disc, so that the set has only roots and no other nodes.
  bool roots_only() const noexcept;
  /// Returns the plan of what is stored. A set of roots alone has neither outlines nor culling data.
  ShapeSetPlan plan() const;
  std::size_t bytes() const noexcept;

  /// Returns the discs of a shape's cut, in the order in which queries number them.
  /// Errors:  throws std::out_of_range if an index is out of range.
  std::vector<Disc> discs(std::uint32_t shape, std::uint32_t level) const;
  /// Returns the radius about the agent's position that encloses a shape at every level and heading, metres.
  /// Takes time linear in the number of discs.
  /// Errors:  throws std::out_of_range if the index is out of range.
  float bounding_radius(std::uint32_t shape) const;

  // Internal, for the library's own code; the types in namespace detail are not public.

  /// Refers to arrays that stay valid while `memory` lives, for instance a mapped file.
  /// Precondition: validate(arrays) does not throw.
  ShapeSet(const detail::ShapeArrays& arrays, std::shared_ptr<const void> memory);
  /// Refers to these arrays from now on.
  void rebind(const detail::ShapeArrays& arrays) noexcept;
  const detail::ShapeSetView& view() const noexcept;
  const detail::ShapeArrays& arrays() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Holds a packed shape, ready to be added to a set. (Packing is nearly all the work of making a set.)
/// An object reuses its memory for the next shape. A moved-from object can only be assigned to or destroyed.
/// Threads: one at a time may use an object.
class BuiltShape {
 public:
  /// Takes the plan of the sets that the shapes are for.
  /// Errors:  throws std::invalid_argument on a bad plan.
  explicit BuiltShape(const ShapeSetPlan& plan);
  BuiltShape(BuiltShape&&) noexcept;
  BuiltShape& operator=(BuiltShape&&) noexcept;
  ~BuiltShape();

  /// Packs a shape, in place of the previous one.
  /// Errors:  throws std::invalid_argument as ShapeSet does, with `index` as the number of the shape. After
  ///          an error, call prepare() again before adding the object.
  void prepare(const Shape& shape, std::size_t index);

  // Internal, for the library's own code; the types in namespace detail are not public.
  /// Returns the arrays that builders and sets copy.
  detail::FlatBody& flat() noexcept;
  const detail::FlatBody& flat() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Builds a set shape by shape, without holding all shapes in memory.
/// The set has the same bytes as one that ShapeSet makes of all shapes at once. A moved-from object can only
/// be assigned to or destroyed.
class ShapeSetBuilder {
 public:
  /// Begins an empty set that follows `plan`.
  /// Memory is reserved for `expected_shapes`, an estimate; any number may be added.
  /// Errors:  throws std::invalid_argument on a bad plan.
  explicit ShapeSetBuilder(const ShapeSetPlan& plan, std::size_t expected_shapes = 0);
  ShapeSetBuilder(ShapeSetBuilder&&) noexcept;
  ShapeSetBuilder& operator=(ShapeSetBuilder&&) noexcept;
  ~ShapeSetBuilder();

  /// Adds a shape that was prepared with the same plan.
  /// Errors:  throws std::length_error beyond 2^31 floats in the arrays of nodes or 2^32 roots. The shapes
  ///          added before stay unchanged.
  void add(const BuiltShape& shape);
  /// Returns the set of the shapes so far, which can be queried until the next call of another member
  /// function.
  /// More shapes may follow.
  const ShapeSet& set();
  /// Returns the set of all added shapes. If memory runs out, the shapes stay in the builder.
  ShapeSet finish() &&;

  // Internal, for the library's own code; the types in namespace detail are not public.
  /// Returns the nodes of the shapes so far, as the set will contain them; empty for a set of roots alone.
  /// Valid until the next call of another member function.
  std::span<const float> nodes() const noexcept;
  /// Returns the present end of the set, for rollback().
  detail::BuilderMark mark() const noexcept;
  /// Removes all shapes added since mark() returned `to`. Allocates nothing.
  void rollback(const detail::BuilderMark& to) noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Holds a set whose shapes are replaced while it lives, for characters whose poses are new in every frame.
///
///     ShapeBuilder shape_builder(character);  // one per thread, as the BuiltShape
///     BuiltShape prepared(dynamic.set().plan());
///     prepared.prepare(shape_builder.shape({clip, seconds}), shape);
///     if (!dynamic.try_replace(shape, prepared)) later.push_back(shape);  // for replace(), by one thread
/// "Plans" in layout/README.md says how memory grows, and why it stops growing after some frames.
class DynamicShapeSet {
 public:
  /// Copies a set with its plan, but without the unused space that the set() of a DynamicShapeSet may have.
  /// A copy of a set of roots alone accepts only shapes of a single disc. A moved-from object can only be
  /// assigned to or destroyed.
  explicit DynamicShapeSet(const ShapeSet& start);
  DynamicShapeSet(DynamicShapeSet&&) noexcept;
  DynamicShapeSet& operator=(DynamicShapeSet&&) noexcept;
  ~DynamicShapeSet();

  /// Returns the present shapes as a set, which can be queried and copied.
  /// Once a shape has been replaced, the set cannot be saved in a baked file, because its arrays may have
  /// gaps; a DynamicShapeSet that copies it has none.
  const ShapeSet& set() const noexcept;

  /// Replaces a shape by one prepared with set().plan(), if the new shape fits into the memory of the old
  /// one. Threads may replace different shapes at the same time, while no query runs. Allocates nothing.
  /// Returns: whether the shape fitted. If not, the set is unchanged and replace() is needed. In a set of one
  ///          level, replace() is also needed for the first shape of a single disc.
  /// Errors:  throws std::out_of_range if the index is out of range, std::invalid_argument if the shape has
  ///          another plan.
  bool try_replace(std::uint32_t shape, const BuiltShape& by);

  /// Replaces a shape, in a new place if the old place is too small.
  /// One thread at a time may call it: arrays may move, which makes earlier views of set() invalid. If the
  /// shape does not fit, it takes time linear in the number of shapes.
  /// Errors:  as try_replace(); std::length_error as ShapeSet. The shape is then unchanged.
  void replace(std::uint32_t shape, const BuiltShape& by);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bch
