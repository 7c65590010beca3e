// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <ranges>
#include <type_traits>

namespace bch {

/// Names two agents by index. For collisions the order does not matter; other queries report results for the
/// first agent.
struct Pair {
  std::uint32_t first;
  std::uint32_t second;
  friend bool operator==(const Pair&, const Pair&) = default;
};

/// Refers to one value per agent in the caller's memory: an array, or a member of the caller's structs.
template <class Value>
class Strided {
 public:
  constexpr Strided() = default;
  /// Refers to `size` values, `stride` bytes apart, of which `first` is the first.
  /// Queries reject a stride that is not a multiple of the value's alignment.
  constexpr Strided(const Value* first, std::size_t size, std::size_t stride = sizeof(Value)) noexcept
      : first_(first), size_(size), stride_(stride) {}
  /// Refers to the values of a contiguous range: a vector, a span, an array.
  template <class Range>
  requires std::ranges::contiguous_range<const Range> && std::ranges::sized_range<const Range> &&
      std::is_same_v<std::ranges::range_value_t<const Range>, Value>
  constexpr Strided(const Range& values) noexcept  // NOLINT(google-explicit-constructor): a view
      : Strided(std::ranges::data(values), std::ranges::size(values)) {}

  constexpr std::size_t size() const noexcept { return size_; }
  constexpr bool empty() const noexcept { return size_ == 0; }
  const Value& operator[](std::size_t i) const noexcept {
    return *reinterpret_cast<const Value*>(reinterpret_cast<const unsigned char*>(first_) + i * stride_);
  }
  constexpr const Value* data() const noexcept { return first_; }
  constexpr std::size_t stride() const noexcept { return stride_; }  ///< bytes

 private:
  const Value* first_ = nullptr;
  std::size_t size_ = 0, stride_ = sizeof(Value);
};

/// Refers to one number per agent, all of them floats or all doubles.
class Numbers {
 public:
  constexpr Numbers() = default;
  constexpr Numbers(Strided<double> values) noexcept  // NOLINT(google-explicit-constructor): a view
      : first_(values.data()), size_(values.size()), stride_(values.stride()) {}
  constexpr Numbers(Strided<float> values) noexcept  // NOLINT(google-explicit-constructor): a view
      : first_(values.data()), size_(values.size()), stride_(values.stride()), is_float_(true) {}
  template <class Range>
  requires std::is_convertible_v<const Range&, Strided<double>> ||
      std::is_convertible_v<const Range&, Strided<float>>
  constexpr Numbers(const Range& values) noexcept  // NOLINT(google-explicit-constructor): a view
      : Numbers(Strided<std::ranges::range_value_t<const Range>>(values)) {}

  constexpr std::size_t size() const noexcept { return size_; }
  constexpr bool empty() const noexcept { return size_ == 0; }
  double operator[](std::size_t i) const noexcept {
    const auto* const at = static_cast<const unsigned char*>(first_) + i * stride_;
    return is_float_ ? double{*reinterpret_cast<const float*>(at)} : *reinterpret_cast<const double*>(at);
  }
  constexpr const void* data() const noexcept { return first_; }
  constexpr std::size_t stride() const noexcept { return stride_; }  ///< bytes
  constexpr bool is_float() const noexcept { return is_float_; }

 private:
  const void* first_ = nullptr;
  std::size_t size_ = 0, stride_ = sizeof(double);
  bool is_float_ = false;
};

/// Refers to one heading per agent, all of them angles or all directions.
class Headings {
 public:
  /// Holds a heading as the caller gave it: an angle, in radians, or a direction (x, y).
  struct Value {
    double x, y = 0;
    bool is_direction = false;
  };

  constexpr Headings() = default;
  constexpr Headings(const Numbers& angles) noexcept  // NOLINT(google-explicit-constructor): a view
      : x_(angles) {}
  /// Takes directions in the world: the unit vector (cosine, sine) of each agent's +x axis.
  /// Lengths must be from 0.999 to 1.001; queries normalise the vectors.
  constexpr Headings(const Numbers& x, const Numbers& y) noexcept : x_(x), y_(y), are_directions_(true) {}
  template <class Range>
  requires std::is_constructible_v<Numbers, const Range&>
  constexpr Headings(const Range& angles) noexcept  // NOLINT(google-explicit-constructor): a view
      : x_(angles) {}

  constexpr std::size_t size() const noexcept { return x_.size(); }
  constexpr bool are_directions() const noexcept { return are_directions_; }
  Value operator[](std::size_t i) const noexcept {
    return are_directions_ ? Value{x_[i], y_[i], true} : Value{x_[i]};
  }
  constexpr const Numbers& x() const noexcept { return x_; }  ///< x of the directions, or the angles
  constexpr const Numbers& y() const noexcept { return y_; }  ///< y of the directions

 private:
  Numbers x_, y_;
  bool are_directions_ = false;
};

/// Refers to a crowd in the arrays of its simulator: one entry per agent in each array; nothing is copied.
/// A heading turns a shape about its agent's position. At heading 0 the built-in characters face +x;
/// ImportOptions says where imported ones face. If a clip rotates the root bone, that rotation is part of the
/// shape, not of the heading.
/// Units:   metres and radians, counter-clockwise, on the ground plane; |x|, |y|, |z| <= 1e9 m and |heading|
///          <= 1e9 rad.
struct Agents {
  Strided<std::uint32_t> shape;  ///< index into the ShapeSet or BodySet
  Numbers x;
  Numbers y;
  Headings heading;
  Strided<std::uint8_t> level = {};  ///< level of detail: index into the set's depths; empty: the last
  /// The height of the ground under each agent: a floor, a step, a stage.
  /// Empty: all agents stand on one ground, and the heights of shapes are ignored. Otherwise agents collide
  /// only if their intervals of height intersect as well, and a ShapeSet needs ShapeSetPlan::heights.
  Numbers z = {};

  std::size_t size() const noexcept { return shape.size(); }
  /// Returns the index of an agent's shape and level in arrays with level_count entries per shape.
  std::size_t root(std::size_t agent, std::size_t level_count) const noexcept {
    return shape[agent] * level_count + (level.empty() ? level_count - 1 : level[agent]);
  }
};

}  // namespace bch
