// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/leaf_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace bch::detail {
namespace {

struct Box {
  double low[3], high[3];

  static Box empty() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  }
  void add(const Sphere& sphere) {
    const double at[] = {double{sphere.x}, double{sphere.y}, double{sphere.z}}, r = double{sphere.radius};
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], at[axis] - r);
      high[axis] = std::max(high[axis], at[axis] + r);
    }
  }
  /// Grows with the chance that what is in the box meets another body's leaf: both have a size.
  double cost() const {
    constexpr double other = 0.1;  // metres
    const double x = high[0] - low[0], y = high[1] - low[1];
    return (std::sqrt(x * x + y * y) / 2 + other) * ((high[2] - low[2]) / 2 + other);
  }
};

constexpr double diagonal = 0.70710678;
constexpr double directions[][3] = {{1, 0, 0},
                                    {0, 1, 0},
                                    {0, 0, 1},
                                    {diagonal, diagonal, 0},
                                    {diagonal, -diagonal, 0},
                                    {diagonal, 0, diagonal},
                                    {diagonal, 0, -diagonal},
                                    {0, diagonal, diagonal},
                                    {0, diagonal, -diagonal}};

class Splitter {
 public:
  Splitter(std::span<const std::vector<Sphere>> poses, std::uint32_t leaf_size)
      : poses_(poses), leaf_size_(leaf_size), order_(poses.front().size()), along_(order_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    split(0, order_.size());
  }

  std::vector<std::uint32_t> take() && { return std::move(order_); }

 private:
  void split(std::size_t begin, std::size_t end) {
    const std::size_t leaves = (end - begin + leaf_size_ - 1) / leaf_size_;
    if (leaves < 2) return;
    std::vector<std::uint32_t> best;
    double least = std::numeric_limits<double>::infinity();
    std::size_t at = 0;
    for (const std::vector<Sphere>& pose : poses_)
      for (const auto& direction : directions) {
        sort(begin, end, pose, direction);
        const std::vector<double> costs = costs_of_splits(begin, end, leaves);
        // Parts of less than a third make the tree deep for nothing.
        for (std::size_t i = std::max<std::size_t>(1, leaves / 3);
             i <= leaves - std::max<std::size_t>(1, leaves / 3); ++i)
          if (costs[i] < least) {
            least = costs[i], at = begin + i * leaf_size_;
            best.assign(order_.begin() + static_cast<std::ptrdiff_t>(begin),
                        order_.begin() + static_cast<std::ptrdiff_t>(end));
          }
      }
    std::copy(best.begin(), best.end(), order_.begin() + static_cast<std::ptrdiff_t>(begin));
    split(begin, at);
    split(at, end);
  }

  void sort(std::size_t begin, std::size_t end, const std::vector<Sphere>& pose,
            const double (&direction)[3]) {
    for (std::size_t i = begin; i < end; ++i) {
      const Sphere& s = pose[order_[i]];
      along_[order_[i]] =
          double{s.x} * direction[0] + double{s.y} * direction[1] + double{s.z} * direction[2];
    }
    std::sort(order_.begin() + static_cast<std::ptrdiff_t>(begin),
              order_.begin() + static_cast<std::ptrdiff_t>(end), [&](std::uint32_t i, std::uint32_t j) {
                return along_[i] != along_[j] ? along_[i] < along_[j] : i < j;
              });
  }

  /// Returns, for i leaves on the left, what both parts cost in all poses, each as often as it has spheres.
  std::vector<double> costs_of_splits(std::size_t begin, std::size_t end, std::size_t leaves) const {
    std::vector<double> costs(leaves + 1);
    for (const std::vector<Sphere>& pose : poses_) {
      Box left = Box::empty(), right = Box::empty();
      for (std::size_t i = begin; i < end; ++i) {
        left.add(pose[order_[i]]);
        const std::size_t count = i + 1 - begin;
        if (count % leaf_size_ == 0) costs[count / leaf_size_] += left.cost() * static_cast<double>(count);
      }
      for (std::size_t i = end; i-- > begin;) {
        right.add(pose[order_[i]]);
        if ((i - begin) % leaf_size_ == 0)
          costs[(i - begin) / leaf_size_] += right.cost() * static_cast<double>(end - i);
      }
    }
    return costs;
  }

  std::span<const std::vector<Sphere>> poses_;
  std::size_t leaf_size_;
  std::vector<std::uint32_t> order_;
  std::vector<double> along_;  ///< by sphere
};

}  // namespace

std::vector<std::uint32_t> leaf_order(std::span<const std::vector<Sphere>> poses, std::uint32_t leaf_size) {
  return Splitter(poses, leaf_size).take();
}

}  // namespace bch::detail
