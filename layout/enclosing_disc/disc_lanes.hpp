// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "layout/enclosing_disc/disc_sets.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Finds the smallest enclosing discs of many point sets, one set per lane, by the algorithm of disc_pivoting.hpp
/// without its unpredictable branches. The operations of a lane depend neither on the width nor on other lanes, so
/// every instruction set gives the same bits.
template <class Simd>
class DiscLanes {
 public:
  static void solve(const DiscSets& job) noexcept {
    for (std::size_t i = 0; i < job.small_count; i += width) Block(job, i, job.small_count).solve_small();
    const std::size_t large = job.count - job.small_count;
    if (large == 0) return;
    const std::size_t last_block = job.count - (large < width - 1 ? large : width - 1);
    for (std::size_t i = job.small_count; i < last_block; i += width) Block(job, i, last_block).solve_large();
    Block(job, last_block, job.count, true).solve_large();
  }

 private:
  using Batch = typename Simd::Double;
  using Mask = typename Batch::batch_bool_type;
  static constexpr std::size_t width = Simd::doubles;
  static_assert(width <= disc_set_lanes);

  struct Point {
    Batch x, y;
  };
  /// Holds the two or three points on the boundary (if two, the second and third are the same) and their disc.
  struct Basis {
    Point a, b, c;
    Point centre;
    Batch square_radius;
    Mask is_pair;
  };

  static Batch select(const Mask& where, const Batch& yes, const Batch& no) {
    return xsimd::select(where, yes, no);
  }
  static Point select(const Mask& where, const Point& yes, const Point& no) {
    return {select(where, yes.x, no.x), select(where, yes.y, no.y)};
  }
  static Batch square_distance(const Point& a, const Point& b) {
    const Batch x = a.x - b.x, y = a.y - b.y;
    return x * x + y * y;
  }
  static Point middle(const Point& a, const Point& b) {
    return {Batch(0.5) * (a.x + b.x), Batch(0.5) * (a.y + b.y)};
  }

  /// Returns the smallest disc around a triangle: the disc on the longest side as diameter, unless the triangle is
  /// acute.
  static Basis basis(const Point& a, const Point& b, const Point& c) {
    const Batch ab = square_distance(a, b), bc = square_distance(b, c), ca = square_distance(c, a);
    const Batch bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
    const Batch scale = Batch(0.5) / (bx * cy - by * cx);
    const Point offset{(cy * ab - by * ca) * scale, (bx * ca - cx * ab) * scale};
    Basis result{a, b, c, {a.x + offset.x, a.y + offset.y}, offset.x * offset.x + offset.y * offset.y, {}};
    const Mask ca_spans = ca >= ab + bc, bc_spans = bc >= ab + ca, ab_spans = ab >= bc + ca;
    const auto drop = [&](const Mask& where, const Point& from, const Point& to, const Batch& square) {
      result.a = select(where, from, result.a);
      result.b = select(where, to, result.b);
      result.c = select(where, to, result.c);
      result.centre = select(where, middle(from, to), result.centre);
      result.square_radius = select(where, Batch(0.25) * square, result.square_radius);
    };
    drop(ca_spans, c, a, ca);
    drop(bc_spans, b, c, bc);
    drop(ab_spans, a, b, ab);
    result.is_pair = ca_spans | bc_spans | ab_spans;
    return result;
  }

  static Basis pivot(const Basis& old, const Point& q) {
    const Batch a = square_distance(old.a, q), b = square_distance(old.b, q), c = square_distance(old.c, q);
    const Mask b_far = b > a, c_far = c > xsimd::max(a, b);
    const Point far = select(c_far, old.c, select(b_far, old.b, old.a));
    const Point next = select(c_far, old.a, select(b_far, old.c, old.b));
    const Point last = select(c_far, old.b, select(b_far, old.a, old.c));
    const Batch x = old.centre.x - far.x, y = old.centre.y - far.y;
    const auto side = [&](const Point& p) { return x * (p.y - far.y) - y * (p.x - far.x); };
    const Point beyond = select(side(q) * side(next) <= Batch(0.0), next, last);
    return basis(q, select(old.is_pair, old.a, far), select(old.is_pair, old.b, beyond));
  }

  /// Represents a block of sets, one per lane, stored point after point. Sets with fewer points than others repeat
  /// their last point.
  class Block {
   public:
    /// Loads the sets of a block, one per lane. If `is_shared`, the last two lanes share the largest set, which often
    /// has twice the points of the next.
    Block(const DiscSets& job, std::size_t begin, std::size_t end, bool is_shared = false)
        : job_(job), begin_(begin), end_(end), is_shared_(is_shared) {
      Column columns[width];
      for (std::size_t lane = 0; lane < width; ++lane) columns[lane] = column(lane);
      if (is_shared) {
        Column &half = columns[width - 2], &other = columns[width - 1];
        const std::size_t middle = half.last / 2;
        other = {half.first + middle + 1, half.last - middle - 1};
        half.last = middle;
      }
      fill(columns);
    }

    /// Solves sets of up to four points. The smallest disc is the largest of the smallest discs around two or three
    /// of the points.
    void solve_small() const {
      const auto at = [&](std::size_t k) { return point(k < count_ ? k : count_ - 1); };
      const Point a = at(0), b = at(1), c = at(2), d = at(3);
      Basis best = basis(a, b, c);
      const auto offer = [&](const Basis& other) {
        const Mask larger = other.square_radius > best.square_radius;
        best.centre = select(larger, other.centre, best.centre);
        best.square_radius = select(larger, other.square_radius, best.square_radius);
      };
      if (count_ > 3) {
        offer(basis(a, b, d));
        offer(basis(a, c, d));
        offer(basis(b, c, d));
      }
      const Point centre{rounded(best.centre.x), rounded(best.centre.y)};
      Batch largest(0.0);
      for (std::size_t k = 0; k < count_; ++k)
        largest = xsimd::max(largest, square_distance(point(k), centre));
      store(centre, largest);
    }

    /// Solves sets of more than four points by pivoting. The farthest points are those from the centre rounded to
    /// float, so that the last pass over the points also gives the radius. Rounding may then decide which of two
    /// points is the farthest, but whether a point is outside is tested against the exact disc.
    void solve_large() const {
      const Point a = farthest(start()).point, b = farthest(a).point;
      const Batch ab = square_distance(a, b);
      Basis now{a, b, b, middle(a, b), Batch(0.25) * ab, ab >= Batch(0.0)};
      Point best = now.centre;
      Batch least(HUGE_VAL);
      Mask open = now.is_pair;
      for (int i = 0; i < max_disc_pivots; ++i) {
        const Point centre{rounded(now.centre.x), rounded(now.centre.y)};
        const Farthest q = farthest(centre);
        const Mask better = open & (q.square < least);
        best = select(better, centre, best);
        least = select(better, q.square, least);
        open = open & (square_distance(q.point, now.centre) > now.square_radius * Batch(disc_slack));
        if (!xsimd::any(open)) break;
        const Basis next = pivot(now, q.point);
        open = open & (next.square_radius > now.square_radius);
        now.a = select(open, next.a, now.a);
        now.b = select(open, next.b, now.b);
        now.c = select(open, next.c, now.c);
        now.centre = select(open, next.centre, now.centre);
        now.square_radius = select(open, next.square_radius, now.square_radius);
        now.is_pair = (open & next.is_pair) | (now.is_pair & !open);
      }
      store(best, least);
    }

   private:
    struct Farthest {
      Point point;
      Batch square;
    };
    /// Represents the points of a lane.
    struct Column {
      const Vec2* first;
      std::size_t last;
    };

    Column column(std::size_t lane) const {
      const PointRange range = job_.sets[job_.order[set(lane)]];
      return {job_.points + range.begin, range.end - range.begin - std::size_t{1}};
    }

    void fill(const Column (&columns)[width]) {
      std::size_t least = columns[0].last, most = least;
      for (const Column& column : columns) {
        least = column.last < least ? column.last : least;
        most = column.last > most ? column.last : most;
      }
      count_ = most + 1;
      double* to = job_.scratch;
      const auto put = [&](auto point) {
        Batch xy[2];
        Simd::load_pairs(point, xy);
        Simd::store(to, xy[0]), Simd::store(to + width, xy[1]);
        to += 2 * width;
      };
      std::size_t k = 0;
      for (; k <= least; ++k) put([&](std::size_t lane) { return columns[lane].first + k; });
      for (; k <= count_; ++k)
        put([&](std::size_t lane) {
          const auto [first, last] = columns[lane];
          return first + (k < last ? k : last);
        });
    }

    /// Returns the number of the set in a lane. Surplus lanes have the last set.
    std::size_t set(std::size_t lane) const { return begin_ + lane < end_ ? begin_ + lane : end_ - 1; }

    Point point(std::size_t k) const {
      return {Simd::load(job_.scratch + 2 * k * width), Simd::load(job_.scratch + (2 * k + 1) * width)};
    }

    static void keep_farther(Farthest& best, const Point& p, const Batch& square) {
      best.point = select(square > best.square, p, best.point);
      best.square = xsimd::max(best.square, square);
    }

    /// Returns one point of each set.
    Point start() const {
      Farthest first{point(0), Batch(0.0)};
      if (is_shared_) share_farthest(first);
      return first.point;
    }

    /// Returns the point farthest from another. It alternates between two chains of comparisons, because each
    /// comparison must wait for the last one of its chain.
    Farthest farthest(const Point& from) const {
      Farthest even{point(0), square_distance(point(0), from)}, odd = even;
      for (std::size_t k = 1; k < count_; k += 2) {
        const Point p = point(k), q = point(k + 1);
        keep_farther(odd, p, square_distance(p, from));
        keep_farther(even, q, square_distance(q, from));
      }
      keep_farther(odd, even.point, even.square);
      if (is_shared_) share_farthest(odd);
      return odd;
    }

    /// Sets the last two lanes to the farther of their two points.
    static void share_farthest(Farthest& farthest) {
      alignas(64) double x[width], y[width], square[width];
      farthest.point.x.store_aligned(x);
      farthest.point.y.store_aligned(y);
      farthest.square.store_aligned(square);
      constexpr std::size_t one = width - 2, other = width - 1;
      const std::size_t farther = square[other] > square[one] ? other : one;
      x[one] = x[other] = x[farther];
      y[one] = y[other] = y[farther];
      square[one] = square[other] = square[farther];
      farthest = {{Batch::load_aligned(x), Batch::load_aligned(y)}, Batch::load_aligned(square)};
    }

    /// Rounds a value to the 24 bits of a float's significand.
    /// Source:  T. J. Dekker, "A floating-point technique for extending the available precision", Numerische
    ///          Mathematik 18, 1971.
    static Batch rounded(const Batch& value) {
      const Batch scaled = value * Batch(0x1p29 + 1);
      return scaled - (scaled - value);
    }

    /// Stores the discs. The centre's coordinates are floats.
    void store(const Point& centre, const Batch& square_radius) const {
      alignas(64) double x[width], y[width], square[width];
      centre.x.store_aligned(x);
      centre.y.store_aligned(y);
      square_radius.store_aligned(square);
      for (std::size_t lane = 0; lane < width; ++lane)
        job_.discs[job_.order[set(lane)]] = {{static_cast<float>(x[lane]), static_cast<float>(y[lane])},
                                             square[lane]};
    }

    const DiscSets& job_;
    std::size_t begin_, end_;
    std::size_t count_ = 0;
    bool is_shared_;
  };
};

}  // namespace bch::detail
