// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/disc_union_area.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

namespace bch::cli {
namespace {

constexpr double turn = 2 * std::numbers::pi;

struct Circle {
  double x, y, radius;
};

/// Angles of a circle, begin <= end, within [0, turn].
using Arc = std::pair<double, double>;

/// Half the integral of x dy - y dx along an arc.
double swept_area(const Circle& c, double begin, double end) {
  const double x = std::sin(end) - std::sin(begin), y = std::cos(end) - std::cos(begin);
  return c.radius / 2 * (c.radius * (end - begin) + c.x * x - c.y * y);
}

/// Adds the arcs of circle a that lie in disc b. Returns: false where that is all of a.
bool add_hidden_arcs(const Circle& a, const Circle& b, bool a_first, std::vector<Arc>& hidden) {
  const double x = b.x - a.x, y = b.y - a.y, distance = std::hypot(x, y);
  if (distance >= a.radius + b.radius) return true;
  // If two discs are equal, the first one counts.
  if (distance == 0 && a.radius == b.radius) return a_first;
  if (distance + a.radius <= b.radius) return false;
  if (distance + b.radius <= a.radius) return true;
  const double cosine =
      (a.radius * a.radius - b.radius * b.radius + distance * distance) / (2 * a.radius * distance);
  const double half = std::acos(std::clamp(cosine, -1.0, 1.0));
  double begin = std::atan2(y, x) - half;
  if (begin < 0) begin += turn;
  const double end = begin + 2 * half;
  hidden.push_back({begin, std::min(end, turn)});
  if (end > turn) hidden.push_back({0, end - turn});
  return true;
}

double visible_area(const Circle& circle, std::vector<Arc>& hidden) {
  std::sort(hidden.begin(), hidden.end());
  hidden.push_back({turn, turn});
  double sum = 0, seen_to = 0;
  for (const auto& [begin, end] : hidden) {
    if (begin > seen_to) sum += swept_area(circle, seen_to, begin);
    seen_to = std::max(seen_to, end);
  }
  return sum;
}

struct Box {
  double left, right, low, high;

  explicit Box(const Circle& c)
      : left(c.x - c.radius), right(c.x + c.radius), low(c.y - c.radius), high(c.y + c.radius) {}
  void enlarge(const Box& by) {
    left = std::min(left, by.left), right = std::max(right, by.right);
    low = std::min(low, by.low), high = std::max(high, by.high);
  }
  bool meets(const Box& other) const {
    return left <= other.right && other.left <= right && low <= other.high && other.low <= high;
  }
};

/// A tree of boxes over circles, halved by the longer side: which ones may meet another is known without all of them.
class CircleTree {
 public:
  explicit CircleTree(const std::vector<Circle>& circles) : circles_(circles), order_(circles.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    if (!order_.empty()) add(0, order_.size());
  }

  /// Calls each(i) for those whose boxes meet that of the circle, until it returns false.
  template <class Each>
  void visit(const Circle& circle, Each each) const {
    // Wider by far more than what is rounded.
    const double slack = 1e-9 * (std::abs(circle.x) + std::abs(circle.y) + circle.radius);
    const Box box({circle.x, circle.y, circle.radius + slack});
    std::size_t node = 0;
    while (node < nodes_.size()) {
      const Node& now = nodes_[node];
      if (!now.box.meets(box)) {
        node = now.skip;
        continue;
      }
      ++node;
      if (now.end - now.begin > together) continue;
      for (std::size_t i = now.begin; i < now.end; ++i)
        if (!each(order_[i])) return;
    }
  }

 private:
  /// Nodes stand before what is below them; `skip` is the one after all of that.
  struct Node {
    Box box;
    std::size_t begin, end, skip;
  };
  static constexpr std::size_t together = 8;

  void add(std::size_t begin, std::size_t end) {
    Box box(circles_[order_[begin]]);
    for (std::size_t i = begin; i < end; ++i) box.enlarge(Box(circles_[order_[i]]));
    const std::size_t node = nodes_.size();
    nodes_.push_back({box, begin, end, 0});
    if (end - begin > together) {
      const bool by_x = box.right - box.left > box.high - box.low;
      const std::size_t middle = begin + (end - begin) / 2;
      const auto place = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
      std::nth_element(place(begin), place(middle), place(end), [&](std::size_t a, std::size_t b) {
        return by_x ? circles_[a].x < circles_[b].x : circles_[a].y < circles_[b].y;
      });
      add(begin, middle);
      add(middle, end);
    }
    nodes_[node].skip = nodes_.size();
  }

  const std::vector<Circle>& circles_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace

double union_area(std::span<const Disc> discs) {
  std::vector<Circle> circles;
  for (const Disc& d : discs)
    circles.push_back({static_cast<double>(d.x), static_cast<double>(d.y), static_cast<double>(d.radius)});
  const CircleTree tree(circles);
  double area = 0;
  std::vector<Arc> hidden;
  for (std::size_t i = 0; i < circles.size(); ++i) {
    hidden.clear();
    bool visible = true;
    tree.visit(circles[i], [&](std::size_t j) {
      return visible = j == i || add_hidden_arcs(circles[i], circles[j], i < j, hidden);
    });
    if (visible) area += visible_area(circles[i], hidden);
  }
  return area;
}

std::vector<Disc> discs_of(const Hierarchy& hierarchy, std::uint32_t depth) {
  std::vector<Disc> discs;
  for (const std::uint32_t node : cut(hierarchy, depth)) discs.push_back(hierarchy.nodes[node].disc);
  return discs;
}

}  // namespace bch::cli
