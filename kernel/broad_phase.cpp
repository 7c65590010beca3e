// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/broad_phase.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "kernel/collide.hpp"
#include "layout/heading.hpp"
#include "layout/rounding.hpp"

namespace bch {
namespace {

using Range = tbb::blocked_range<std::size_t>;
constexpr std::size_t grain = 1024;

/// An agent's root disc in the world. The offset stays apart from the position, because far from the origin
/// their sum would lose what their differences keep.
struct Root {
  double x, y;                ///< the agent's position
  double offset_x, offset_y;  ///< of the disc's centre, turned by the heading
  double radius;              ///< with the slack of a pruning disc, which covers the float test's rounding
};

bool can_overlap(const Root& a, const Root& b) {
  const double x = (b.x - a.x) + (b.offset_x - a.offset_x);
  const double y = (b.y - a.y) + (b.offset_y - a.offset_y);
  const double r = a.radius + b.radius;
  return x * x + y * y <= r * r;
}

struct Cell {
  std::int64_t row, column;
  friend bool operator<(const Cell& a, const Cell& b) {
    return std::tie(a.row, a.column) < std::tie(b.row, b.column);
  }
};

struct Entry {
  Cell cell;
  std::uint32_t agent;
};

/// The agents sorted by cell, row after row: three neighbouring cells of a row are one run of entries.
class Grid {
 public:
  Grid(const ShapeSet& shapes, const Agents& agents) : roots_(agents.size()), entries_(agents.size()) {
    place_roots(shapes.view(), agents);
    double largest = 0;
    for (const Root& root : roots_) largest = std::max(largest, root.radius);
    // The slack covers the rounding of world coordinates up to 1e9 m (1.2e-7 m) and of the division.
    const double size = 2 * largest * (1 + 0x1p-10) + 1e-6;
    tbb::parallel_for(Range(0, roots_.size(), grain), [&](const Range& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const Root& root = roots_[i];
        const auto index = [size](double at) { return static_cast<std::int64_t>(std::floor(at / size)); };
        entries_[i] = {{index(root.y + root.offset_y), index(root.x + root.offset_x)},
                       static_cast<std::uint32_t>(i)};
      }
    });
    tbb::parallel_sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
      return a.cell < b.cell || (!(b.cell < a.cell) && a.agent < b.agent);
    });
  }

  std::size_t size() const { return entries_.size(); }

  /// Calls visit(agent, higher) for every candidate pair whose lower index is the agent of an entry in the
  /// range; all pairs of one agent in a row.
  template <class Visit>
  void visit_pairs(const Range& range, Visit visit) const {
    auto window = first_windows(entries_[range.begin()].cell);
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Entry& entry = entries_[i];
      for (int k = 0; k < 3; ++k) {
        const Cell from{entry.cell.row + k - 1, entry.cell.column - 1};
        while (window[k] != entries_.end() && window[k]->cell < from) ++window[k];
        for (auto other = window[k];
             other != entries_.end() && other->cell.row == from.row && other->cell.column <= from.column + 2;
             ++other)
          if (other->agent > entry.agent && can_overlap(roots_[entry.agent], roots_[other->agent]))
            visit(entry.agent, other->agent);
      }
    }
  }

 private:
  using Iterator = std::vector<Entry>::const_iterator;

  void place_roots(const ShapeSetView& shapes, const Agents& agents) {
    tbb::parallel_for(Range(0, roots_.size(), grain), [&](const Range& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const std::uint32_t level = agents.level.empty() ? shapes.level_count - 1 : agents.level[i];
        const std::size_t root = std::size_t{agents.shape[i]} * shapes.level_count + level;
        const double x = shapes.roots[root].x, y = shapes.roots[root].y;
        const Rotation turn = rotation(agents.heading[i]);
        roots_[i] = {agents.x[i], agents.y[i], turn.cosine * x - turn.sine * y,
                     turn.sine * x + turn.cosine * y,
                     static_cast<double>(shapes.roots[root].radius) +
                         rounding::nesting_margin * static_cast<double>(shapes.reach[agents.shape[i]])};
      }
    });
  }

  /// Where the runs of the three rows around a cell begin.
  std::array<Iterator, 3> first_windows(Cell cell) const {
    std::array<Iterator, 3> window;
    for (int k = 0; k < 3; ++k)
      window[k] = std::lower_bound(entries_.begin(), entries_.end(), Cell{cell.row + k - 1, cell.column - 1},
                                   [](const Entry& entry, const Cell& from) { return entry.cell < from; });
    return window;
  }

  std::vector<Root> roots_;
  std::vector<Entry> entries_;
};

}  // namespace

std::vector<Pair> candidate_pairs(const ShapeSet& shapes, const Agents& agents) {
  validate(shapes, agents);
  if (agents.size() == 0) return {};
  const Grid grid(shapes, agents);

  // Two passes, counting and filling: every agent's pairs have their place before any is written.
  std::vector<std::size_t> begin(agents.size() + 1);
  tbb::parallel_for(Range(0, grid.size(), grain), [&](const Range& range) {
    grid.visit_pairs(range, [&](std::uint32_t agent, std::uint32_t) { ++begin[agent + 1]; });
  });
  for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];

  std::vector<Pair> pairs(begin.back());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  tbb::parallel_for(Range(0, grid.size(), grain), [&](const Range& range) {
    grid.visit_pairs(range, [&](std::uint32_t agent, std::uint32_t other) {
      pairs[next[agent]++] = {agent, other};
    });
  });
  tbb::parallel_for(Range(0, agents.size(), grain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(begin[i]),
                pairs.begin() + static_cast<std::ptrdiff_t>(begin[i + 1]),
                [](const Pair& a, const Pair& b) { return a.second < b.second; });
  });
  return pairs;
}

}  // namespace bch
