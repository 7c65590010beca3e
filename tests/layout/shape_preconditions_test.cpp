// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/format/shape_preconditions.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <limits>
#include <set>
#include <string>

#include "layout/format/shape_set_view.hpp"
#include "layout/format/shape_validation.hpp"
#include "layout/shape_set/shape_storage.hpp"
#include "tests/support/baked_bytes.hpp"

// For everything that queries take for granted of a set's arrays there is damage that this one check refuses.

namespace bch::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// A set's arrays, to be damaged, and what does not fit into them.
struct Arrays {
  detail::ShapeStorage own;
  detail::AlignedVector<float> beside;
  std::function<void(detail::ShapeArrays&)> last = [](detail::ShapeArrays&) {};

  explicit Arrays(const ShapeSetPlan& plan) {
    const ShapeSet set(few_shapes(), plan);
    detail::for_each_array(
        [](const char*, auto& to, const auto& from) { to.assign(from.begin(), from.end()); }, own,
        set.arrays());
  }

  detail::ShapeArrays view() const {
    detail::ShapeArrays all = own.arrays();
    last(all);
    return all;
  }
  /// The first shape's finest level: a tree of several blocks.
  float* top_block() { return own.nodes.data() + own.trees[finest].top; }
  float& name(float* block, std::uint32_t lane) { return block[detail::block_names + lane]; }
  /// The node above a disc of the finest level: x, y, radius and link.
  float* inner_node(std::uint32_t disc) {
    return own.nodes.data() + (own.trees[finest].first_inner() + disc) * std::size_t{detail::inner_floats};
  }
  /// The first block all of whose names are windows.
  float* lowest_block() {
    float* block = top_block();
    while (std::bit_cast<std::uint32_t>(name(block, 0)) < detail::leaf_window) block += detail::block_floats;
    return block;
  }

  /// The smallest radius of the finest level.
  float& smallest_disc() {
    const detail::Tree& tree = own.trees[finest];
    const std::uint32_t first = std::bit_cast<std::uint32_t>(name(lowest_block(), 0)) & ~detail::leaf_window;
    float* radius = own.nodes.data() + first + 2 * std::size_t{tree.stride};
    return *std::min_element(radius, radius + tree.stride);
  }

  /// The first inner node of the finest level that no block has.
  std::uint32_t node_of_no_block() {
    const detail::Tree& tree = own.trees[finest];
    for (std::uint32_t k = 0;; ++k) {
      bool is_in_block = false;
      for (std::size_t block = tree.top; block < tree.discs; block += detail::block_floats)
        for (std::uint32_t lane = 0; lane < detail::block_width; ++lane)
          is_in_block |= std::bit_cast<std::uint32_t>(own.nodes[block + detail::block_nodes + lane]) ==
                         tree.first_inner() + k;
      if (!is_in_block) return k;
    }
  }

  static constexpr std::size_t finest = 2;
};

struct Damage {
  const char* precondition;
  std::function<void(Arrays&)> make;
};

void add(float& name, std::uint32_t to) {
  name = std::bit_cast<float>(std::bit_cast<std::uint32_t>(name) + to);
}

/// 64 windows, all at the same eight discs, below the same node. Discs are all the same, and a chain of nodes is above them.
void name_a_window_64_times(Arrays& a) {
  a.own = {};
  a.own.depths = {all_depths};
  a.own.roots = {{0, 0, 1, detail::first_row}};
  const std::uint32_t discs = 9 * detail::block_floats;
  a.own.trees = {{0, discs, detail::block_width, detail::block_width, 1}};
  a.own.reach = {1};
  const std::uint32_t first_inner = a.own.trees[0].first_inner();
  a.own.nodes.resize((first_inner + detail::block_width) * detail::inner_floats + detail::block_floats);
  const auto put_discs = [&](std::uint32_t at) {
    std::fill_n(&a.own.nodes[at + 2 * detail::block_width], detail::block_width, 1.0f);
  };
  for (std::uint32_t block = 0; block < 9; ++block) {
    float* const x = &a.own.nodes[block * detail::block_floats];
    put_discs(block * detail::block_floats);
    for (std::uint32_t lane = 0; lane < detail::block_width; ++lane) {
      a.name(x, lane) =
          std::bit_cast<float>(block == 0 ? (lane + 1) * detail::block_floats : detail::leaf_window + discs);
      x[detail::block_nodes + lane] = std::bit_cast<float>(first_inner);
    }
  }
  put_discs(discs);
  for (std::uint32_t k = 0; k + 1 < detail::block_width; ++k) {
    float* const inner = &a.own.nodes[(first_inner + k) * detail::inner_floats];
    inner[2] = 1;
    inner[3] = std::bit_cast<float>(first_inner + (k == 0 ? 0 : k - 1) + detail::above_cut_disc);
  }
}

const std::vector<Damage>& all_damage() {
  static const std::vector<Damage> all = {
      {"alignment",
       [](Arrays& a) {
         a.beside.assign(1 + a.own.reach.size(), 1.0f);
         a.last = [&a](detail::ShapeArrays& view) {
           view.reach = std::span<const float>(a.beside).subspan(1);
         };
       }},
      {"depths", [](Arrays& a) { a.own.depths[2] = a.own.depths[1]; }},
      {"depths", [](Arrays& a) { a.last = [](detail::ShapeArrays& view) { view.depths = {}; }; }},
      {"sizes", [](Arrays& a) { a.own.extremes.pop_back(); }},
      {"sizes", [](Arrays& a) { a.own.reach.clear(); }},
      {"sizes", [](Arrays& a) { a.own.shape_contours.pop_back(); }},
      {"sizes", [](Arrays& a) { a.own.segment_margin.pop_back(); }},
      {"sizes",  // more profiles than kernels can name
       [](Arrays& a) {
         a.last = [](detail::ShapeArrays& view) {
           constexpr std::size_t shapes = 70'000'000;
           const auto many = [](auto& span) { span = {span.data(), shapes}; };
           view.depths = view.depths.first(1);
           many(view.roots), many(view.trees), many(view.reach), many(view.inscribed), many(view.extremes);
           many(view.profiles), many(view.shape_contours), many(view.segment_margin);
         };
       }},
      {"sizes",
       [](Arrays& a) {
         a = Arrays({.slices = {0.4f, 1}});
         a.own.heights.pop_back();
       }},
      {"slices",
       [](Arrays& a) {
         a = Arrays({.slices = {0.4f, 1}});
         a.own.slices[1] = a.own.slices[0];
       }},
      {"slices",
       [](Arrays& a) {
         a = Arrays({.outlines = false, .culling = false, .heights = true});
         a.own.slices = {1};
         a.own.slab_parts = {0, 0, 1, 1, 2, 2};
       }},
      {"slab parts",
       [](Arrays& a) {
         a.own.slab_parts = {0, 1, 2};
       }},
      {"slab parts",
       [](Arrays& a) {
         a = Arrays({.slices = {0.4f, 1}});
         a.own.slab_parts[4] = 0;
       }},
      {"slab parts",
       [](Arrays& a) {
         a = Arrays({.slices = {0.4f, 1}});
         std::fill_n(a.own.slab_parts.end() - 3, 3, detail::no_part);
       }},
      {"slab parts",
       [](Arrays& a) {
         a = Arrays({.slices = {0.4f, 1}});
         std::fill_n(a.own.slab_parts.end() - 3, 3, 3u);
       }},
      {"hull supports",
       [](Arrays& a) {
         a = Arrays({.slices = {0.4f, 1}});
         a.own.hull_support.back() = nan;
       }},
      {"heights",
       [](Arrays& a) {
         a = Arrays({.heights = true});
         a.own.heights[1] = {2, 1};
       }},
      {"heights",  // of a part in all slabs, in the highest of which it is
       [](Arrays& a) {
         a = Arrays({.slices = {0.4f, 1}});
         a.own.heights[1] = {2, 3};
       }},
      {"rows", [](Arrays& a) { a.own.roots[Arrays::finest].row += 1; }},
      {"rows", [](Arrays& a) { a.own.support.resize(a.own.support.size() + detail::support_stride); }},
      {"single depth",  // what made DynamicShapeSet copy roots without their trees
       [](Arrays& a) {
         a = Arrays({.depths = {all_depths}, .outlines = false});
         a.own.depths[0] = 0;
       }},
      {"single depth",
       [](Arrays& a) {
         a = Arrays({.depths = {2, 5}});
         a.own.depths[0] = 0;
       }},
      {"infinite rows", [](Arrays& a) { a.own.support[detail::support_stride + 3] = 1; }},
      {"reaches", [](Arrays& a) { a.own.reach[1] = 0; }},
      {"roots",  // of others a tree has the like
       [](Arrays& a) {
         a = Arrays({.depths = {0}});
         a.own.roots[1].radius = 0;
       }},
      {"supports", [](Arrays& a) { a.own.support.back() = nan; }},
      {"inscribed discs", [](Arrays& a) { a.own.inscribed[1].radius[3] = -1; }},
      {"extremes", [](Arrays& a) { a.own.extremes[2].y[31] = infinity; }},
      {"profiles", [](Arrays& a) { a.own.profiles[1].sectors[31].outer = -infinity; }},
      {"profiles", [](Arrays& a) { a.own.profiles[1].sectors[7].inner = infinity; }},
      {"shape contours", [](Arrays& a) { a.own.shape_contours[1].end -= 1; }},
      {"contours", [](Arrays& a) { a.own.contours[1].end = a.own.contours[1].begin; }},
      {"contours", [](Arrays& a) { a.own.points[a.own.contours[0].end].x += 1; }},
      {"points", [](Arrays& a) { a.own.points[5].y = nan; }},
      {"segment margins", [](Arrays& a) { a.own.segment_margin[1] = -1e-6f; }},
      {"contour discs", [](Arrays& a) { a.own.contours[0].disc.radius *= 2; }},
      {"contour discs",  // as large as its farthest point asks, but elsewhere
       [](Arrays& a) {
         Disc& disc = a.own.contours[0].disc;
         const Vec2 farthest =
             *std::min_element(a.own.points.begin(), a.own.points.begin() + a.own.contours[0].end,
                               [](const Vec2& p, const Vec2& q) { return p.x < q.x; });
         disc = {farthest.x + 1000, farthest.y, 1000};
       }},
      {"order of levels", [](Arrays& a) { a.own.trees[Arrays::finest] = a.own.trees[Arrays::finest - 1]; }},
      {"blocks", [](Arrays& a) { a.name(a.top_block(), 0) = std::bit_cast<float>(a.own.trees[2].top); }},
      {"blocks", [](Arrays& a) { a.top_block()[0] = infinity; }},
      {"room", [](Arrays& a) { a.own.trees[Arrays::finest].stride = detail::block_width - 1; }},
      {"room", [](Arrays& a) { a.own.nodes.resize(a.own.nodes.size() - 1); }},
      {"windows", [](Arrays& a) { add(a.name(a.lowest_block(), 7), 4096); }},
      {"first window", [](Arrays& a) { add(a.name(a.lowest_block(), 0), 1); }},
      {"number of windows", name_a_window_64_times},
      {"padding", [](Arrays& a) { a.lowest_block()[3] = infinity; }},
      {"numbers", [](Arrays& a) { a.smallest_disc() = 1e-12f; }},
      {"numbers", [](Arrays& a) { a.smallest_disc() *= -1; }},
      {"single discs", [](Arrays& a) { a.own.roots[Arrays::finest - 1].row = detail::single_disc; }},
      {"single discs", [](Arrays& a) { a.own.roots[0].x += 0.01f; }},
      {"reach of a level", [](Arrays& a) { a.own.reach[0] = 100; }},
      {"inner nodes", [](Arrays& a) { a.own.roots[Arrays::finest].radius *= 8; }},
      {"inner nodes", [](Arrays& a) { a.inner_node(a.node_of_no_block())[2] *= 8; }},
      {"inner nodes",  // a way that never ends
       [](Arrays& a) {
         const std::uint32_t k = a.node_of_no_block();
         a.inner_node(k)[3] = std::bit_cast<float>(
             (std::bit_cast<std::uint32_t>(a.inner_node(k)[3]) & detail::above_cut_disc) +
             a.own.trees[Arrays::finest].first_inner() + k);
       }},
      {"inner nodes", [](Arrays& a) { add(a.inner_node(a.node_of_no_block())[3], detail::above_cut_disc); }},
      {"inner nodes",  // below the node above the one that it is below
       [](Arrays& a) {
         const std::uint32_t first = a.own.trees[Arrays::finest].first_inner();
         const auto above = [&](std::uint32_t k) {
           return (std::bit_cast<std::uint32_t>(a.inner_node(k)[3]) & ~detail::above_cut_disc) - first;
         };
         std::uint32_t k = 2;
         while (!(above(k) < k && above(above(k)) < above(k))) ++k;
         float& link = a.inner_node(k)[3];
         link = std::bit_cast<float>((std::bit_cast<std::uint32_t>(link) & detail::above_cut_disc) + first +
                                     above(above(k)));
       }},
      {"nodes of blocks", [](Arrays& a) { a.lowest_block()[2 * detail::block_width + 3] *= 1.01f; }},
      {"nodes of blocks",  // the root's
       [](Arrays& a) {
         for (std::uint32_t field = 0; field < 3; ++field)
           a.lowest_block()[field * detail::block_width + 3] = (&a.own.roots[Arrays::finest].x)[field];
       }},
      {"nodes of blocks", [](Arrays& a) { add(a.lowest_block()[detail::block_nodes + 3], 1); }},
      {"segments of leaves",  // of the next shape
       [](Arrays& a) { a.own.leaf_segments[a.own.trees[Arrays::finest].segments] += a.own.contours[0].end; }},
      {"segments of leaves",  // a list beyond the array
       [](Arrays& a) { a.own.leaf_segments.back() |= detail::leaf_list; }},
      {"segments of leaves",  // more than there are, again and again
       [](Arrays& a) {
         const detail::Tree& tree = a.own.trees[Arrays::finest];
         for (std::uint32_t k = 0; k < tree.count; ++k)
           a.own.leaf_segments[tree.segments + k] = std::uint32_t{3} << detail::leaf_count_shift;
       }},
      {"segments of leaves", [](Arrays& a) { a.own.trees[Arrays::finest].segments += 1; }},
      {"segments of leaves", [](Arrays& a) { a.own.trees[Arrays::finest].points += 1; }},
      {"segments of leaves",  // of a coarse level
       [](Arrays& a) {
         std::swap(a.own.trees[Arrays::finest].segments, a.own.trees[Arrays::finest - 1].segments);
       }},
      {"segments of leaves", [](Arrays& a) { a.own.leaf_segments.push_back(1 << detail::leaf_count_shift); }},
      {"outer radii", [](Arrays& a) { a.lowest_block()[detail::block_outer + 3] += 1; }},
      {"outer radii", [](Arrays& a) { a.lowest_block()[detail::block_outer + 3] = nan; }},
      {"outer radii", [](Arrays& a) { a.own.trees[Arrays::finest].outer += 1; }},
  };
  return all;
}

/// What the other checks read without looking: where one of these does not hold they must not run.
const std::set<std::string> relied_upon = {"depths",   "sizes",           "slab parts", "shape contours",
                                           "contours", "order of levels", "blocks",     "room",
                                           "windows",  "numbers"};

/// Runs the checks as validate() does, but for one. Returns: the name of the one that refuses; empty where none does.
std::string refused_by(const detail::ShapeArrays& arrays, const std::string& without,
                       const std::string& stop_at) {
  std::string name;
  const auto runs = [&](const detail::Precondition& each) {
    name = each.name;
    return name != without;
  };
  try {
    for (const detail::Precondition& each : detail::shape_preconditions()) {
      if (each.name == stop_at) return {};
      if (each.check_set != nullptr && runs(each)) each.check_set(arrays);
    }
    detail::LevelNodes level{};
    for (std::size_t root = 0; root < arrays.trees.size(); ++root) {
      level.root = root, level.begin = level.end, level.windows = {};
      for (const detail::Precondition& each : detail::shape_preconditions()) {
        if (each.name == stop_at) break;
        if (each.check_level != nullptr && runs(each)) each.check_level(arrays, level);
      }
    }
  } catch (const std::invalid_argument&) {
    return name;
  }
  return {};
}

TEST(ShapePreconditions, HaveNamesOfTheirOwnAndOneCheckEach) {
  std::set<std::string> names;
  for (const detail::Precondition& each : detail::shape_preconditions()) {
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    EXPECT_TRUE((each.check_set == nullptr) != (each.check_level == nullptr)) << each.name;
    EXPECT_GT(std::string(each.says).size(), 20u) << each.name;
  }
}

TEST(ShapePreconditions, HoldForASoundSet) {
  const Arrays sound({.depths = {0, 3, all_depths}, .outlines = true});
  EXPECT_NO_THROW(validate(sound.view()));
}

TEST(ShapePreconditions, EachRefusesWhatNoOtherDoes) {
  std::set<std::string> damaged;
  for (const Damage& damage : all_damage()) {
    damaged.insert(damage.precondition);
    Arrays arrays({.depths = {0, 3, all_depths}, .outlines = true});
    damage.make(arrays);
    const detail::ShapeArrays view = arrays.view();
    EXPECT_THROW(validate(view), std::invalid_argument) << damage.precondition;
    EXPECT_EQ(refused_by(view, "", ""), damage.precondition);
    const bool others_may_run = !relied_upon.contains(damage.precondition);
    EXPECT_EQ(refused_by(view, damage.precondition, others_may_run ? "" : damage.precondition), "")
        << damage.precondition;
  }
  for (const detail::Precondition& each : detail::shape_preconditions())
    EXPECT_TRUE(damaged.contains(each.name)) << each.name << ": no damage violates it";
}

}  // namespace
}  // namespace bch::test
