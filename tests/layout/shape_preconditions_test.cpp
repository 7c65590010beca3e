// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/format/shape_preconditions.hpp"
#include "layout/format/shape_set_view.hpp"
#include "layout/format/shape_validation.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "layout/shape_set/shape_storage.hpp"
#include "layout/shape_set/verify.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

// For everything that queries take for granted of a set's arrays there is damage that this one check refuses.

namespace bch::test {
namespace {

/// Adds to a number that is kept among floats.
void add(float& name, std::uint32_t to) {
  name = std::bit_cast<float>(std::bit_cast<std::uint32_t>(name) + to);
}

/// The arrays of a set of few_shapes(), to be damaged, and what does not fit into them.
struct DamagedArrays {
  detail::ShapeStorage own;
  detail::AlignedVector<float> beside;
  std::function<void(detail::ShapeArrays&)> last = [](detail::ShapeArrays&) {};

  explicit DamagedArrays(const ShapeSetPlan& plan = {.depths = {0, 3, all_depths}, .outlines = true}) {
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

  static constexpr std::size_t finest = 2;
  /// The first shape's finest level: a tree of several blocks.
  detail::Tree& tree() { return own.trees[finest]; }
  float* top_block() { return own.nodes.data() + tree().top; }
  float& name(float* block, std::uint32_t lane) { return block[detail::block_names + lane]; }
  void set_child(std::uint32_t name_of_first) { name(top_block(), 0) = std::bit_cast<float>(name_of_first); }
  /// The first block all of whose names are leaf blocks.
  float* lowest_block() {
    float* block = top_block();
    while (std::bit_cast<std::uint32_t>(name(block, 0)) < detail::leaf_bit) block += detail::block_floats;
    return block;
  }
  /// The discs of the level: x, and from there to y and to radii.
  float* discs() { return own.nodes.data() + tree().discs; }
  float* radii() { return discs() + 2 * std::size_t{tree().stride}; }
  float& smallest_disc() { return *std::min_element(radii(), radii() + tree().stride); }
  /// The node above a disc of the level: x, y, radius and link.
  float* inner_node(std::uint32_t disc) {
    return own.nodes.data() + (tree().first_inner() + disc) * std::size_t{detail::inner_floats};
  }
  std::uint32_t link(std::uint32_t disc) { return std::bit_cast<std::uint32_t>(inner_node(disc)[3]); }
  /// The first inner node that no block has.
  std::uint32_t node_of_no_block() {
    for (std::uint32_t k = 0;; ++k) {
      bool is_in_block = false;
      for (std::size_t block = tree().top; block < tree().discs; block += detail::block_floats)
        for (std::uint32_t lane = 0; lane < detail::block_width; ++lane)
          is_in_block |= std::bit_cast<std::uint32_t>(own.nodes[block + detail::block_nodes + lane]) ==
                         tree().first_inner() + k;
      if (!is_in_block) return k;
    }
  }
};

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

using detail::Inconsistency;
using detail::verify;
using detail::baked::Section;
using Arrays = DamagedArrays;

const ShapeSetPlan levels{.depths = {0, 3, all_depths}, .outlines = true}, roots{.depths = {0}},
    high{.heights = true}, two_levels{.depths = {2, 5}},
    discs_alone{.depths = {all_depths}, .outlines = false};

struct Damage {
  const char* what;
  std::function<void(Arrays&)> make;
  const ShapeSetPlan& plan = levels;
};

/// 64 leaf blocks, all at the same eight discs, below the same node. Discs are all the same, and a chain of nodes is above them.
void name_a_leaf_block_64_times(Arrays& a) {
  a.own = {};
  a.own.depths = {all_depths};
  a.own.roots = {{0, 0, 1, detail::first_row}};
  const std::uint32_t discs = 9 * detail::block_floats;
  a.own.trees = {{0, discs, detail::block_width, detail::block_width, 1}};
  a.own.max_extent = {1};
  const std::uint32_t first_inner = a.own.trees[0].first_inner();
  a.own.nodes.resize((first_inner + detail::block_width) * detail::inner_floats + detail::block_floats);
  const auto store_discs = [&](std::uint32_t at) {
    std::fill_n(&a.own.nodes[at + 2 * detail::block_width], detail::block_width, 1.0f);
  };
  for (std::uint32_t block = 0; block < 9; ++block) {
    float* const x = &a.own.nodes[block * detail::block_floats];
    store_discs(block * detail::block_floats);
    for (std::uint32_t lane = 0; lane < detail::block_width; ++lane) {
      a.name(x, lane) =
          std::bit_cast<float>(block == 0 ? (lane + 1) * detail::block_floats : detail::leaf_bit + discs);
      x[detail::block_nodes + lane] = std::bit_cast<float>(first_inner);
    }
  }
  store_discs(discs);
  for (std::uint32_t k = 0; k + 1 < detail::block_width; ++k) {
    float* const inner = &a.own.nodes[(first_inner + k) * detail::inner_floats];
    inner[2] = 1;
    inner[3] = std::bit_cast<float>(first_inner + (k == 0 ? 0 : k - 1) + detail::parent_of_cut_disc);
  }
}

/// By the one precondition that it violates.
const std::vector<Damage>& all_damage() {
  static const std::vector<Damage> all = {
      {"alignment",
       [](Arrays& a) {
         a.beside.assign(1 + a.own.max_extent.size(), 1.0f);
         a.last = [&a](auto& view) { view.max_extent = std::span<const float>(a.beside).subspan(1); };
       }},
      {"depths", [](Arrays& a) { a.own.depths[2] = a.own.depths[1]; }},
      {"depths", [](Arrays& a) { a.own.depths.clear(); }},
      {"sizes", [](Arrays& a) { a.own.inscribed.pop_back(); }},
      {"sizes", [](Arrays& a) { a.own.max_extent.clear(); }},
      {"sizes", [](Arrays& a) { a.own.shape_contours.pop_back(); }},
      {"sizes", [](Arrays& a) { a.own.segment_margin.pop_back(); }},
      {"sizes",  // more profiles than kernels can name
       [](Arrays& a) {
         a.last = [](auto& view) {
           const auto many = [](auto&... spans) { ((spans = {spans.data(), std::size_t{70'000'000}}), ...); };
           view.depths = view.depths.first(1);
           many(view.roots, view.trees, view.max_extent, view.inscribed, view.profiles, view.shape_contours,
                view.segment_margin);
         };
       }},
      {"sizes", [](Arrays& a) { a.own.heights.pop_back(); }, high},
      {"heights", [](Arrays& a) { a.own.heights[1].bottom = 2, a.own.heights[1].top = 1; }, high},
      {"heights", [](Arrays& a) { a.own.heights[2].top = nan; }, high},
      {"rows", [](Arrays& a) { a.own.roots[Arrays::finest].row += 1; }},
      {"rows", [](Arrays& a) { a.own.support.resize(a.own.support.size() + detail::support_stride); }},
      // What made DynamicShapeSet copy roots without their trees.
      {"single depth", [](Arrays& a) { a.own.depths[0] = 0; }, discs_alone},
      {"single depth", [](Arrays& a) { a.own.depths[0] = 0; }, two_levels},
      {"infinite rows", [](Arrays& a) { a.own.support[detail::support_stride + 3] = 1; }},
      {"extents", [](Arrays& a) { a.own.max_extent[1] = 0; }},
      {"roots", [](Arrays& a) { a.own.roots[1].radius = 0; }, roots},  // of others a tree has the like
      {"supports", [](Arrays& a) { a.own.support.back() = nan; }},
      {"inscribed discs", [](Arrays& a) { a.own.inscribed[1].radius[3] = -1; }},
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
         const Vec2 farthest = *std::ranges::min_element(
             a.own.points.begin(), a.own.points.begin() + a.own.contours[0].end, {}, &Vec2::x);
         a.own.contours[0].disc = {farthest.x + 1000, farthest.y, 1000};
       }},
      {"order of levels", [](Arrays& a) { a.tree() = a.own.trees[Arrays::finest - 1]; }},
      {"blocks", [](Arrays& a) { a.set_child(a.tree().top); }},
      {"blocks", [](Arrays& a) { a.top_block()[0] = infinity; }},
      {"room", [](Arrays& a) { a.tree().stride = detail::block_width - 1; }},
      {"room", [](Arrays& a) { a.own.nodes.resize(a.own.nodes.size() - 1); }},
      {"leaf blocks",  // by one disc
       [](Arrays& a) {
         a.name(a.lowest_block(), 7) = std::bit_cast<float>(detail::leaf_bit + a.tree().discs +
                                                            a.tree().stride - detail::block_width + 1);
       }},
      {"first leaf block", [](Arrays& a) { add(a.name(a.lowest_block(), 0), 1); }},
      {"number of leaf blocks", name_a_leaf_block_64_times},
      {"padding", [](Arrays& a) { a.lowest_block()[3] = infinity; }},
      {"numbers", [](Arrays& a) { a.smallest_disc() = 1e-12f; }},
      {"numbers", [](Arrays& a) { a.smallest_disc() *= -1; }},
      {"single discs", [](Arrays& a) { a.own.roots[Arrays::finest - 1].row = detail::single_disc; }},
      {"single discs", [](Arrays& a) { a.own.roots[0].x += 0.01f; }},
      {"extent of a level", [](Arrays& a) { a.own.max_extent[0] = 100; }},
      {"inner nodes", [](Arrays& a) { a.own.roots[Arrays::finest].radius *= 8; }},
      {"inner nodes", [](Arrays& a) { a.inner_node(a.node_of_no_block())[2] *= 8; }},
      {"inner nodes",  // a way that never ends
       [](Arrays& a) {
         const std::uint32_t k = a.node_of_no_block(), kind = a.link(k) & detail::parent_of_cut_disc;
         a.inner_node(k)[3] = std::bit_cast<float>(kind + a.tree().first_inner() + k);
       }},
      {"inner nodes",
       [](Arrays& a) { add(a.inner_node(a.node_of_no_block())[3], detail::parent_of_cut_disc); }},
      {"inner nodes",  // below the node above the one that it is below
       [](Arrays& a) {
         const auto above = [&](std::uint32_t k) {
           return (a.link(k) & ~detail::parent_of_cut_disc) - a.tree().first_inner();
         };
         std::uint32_t k = 2;
         while (!(above(k) < k && above(above(k)) < above(k))) ++k;
         add(a.inner_node(k)[3], above(above(k)) - above(k));
       }},
      {"nodes of blocks", [](Arrays& a) { a.lowest_block()[2 * detail::block_width + 3] *= 1.01f; }},
      {"nodes of blocks",  // the root's
       [](Arrays& a) {
         for (std::uint32_t field = 0; field < 3; ++field)
           a.lowest_block()[field * detail::block_width + 3] = (&a.own.roots[Arrays::finest].x)[field];
       }},
      {"nodes of blocks", [](Arrays& a) { add(a.lowest_block()[detail::block_nodes + 3], 1); }},
      // Of the next shape; a list beyond the array; more than there are, again and again; of a coarse level.
      {"segments of leaves",
       [](Arrays& a) { a.own.leaf_segments[a.tree().segments] += a.own.contours[0].end; }},
      {"segments of leaves", [](Arrays& a) { a.own.leaf_segments.back() |= detail::leaf_list; }},
      {"segments of leaves",
       [](Arrays& a) {
         std::fill_n(a.own.leaf_segments.begin() + a.tree().segments, a.tree().count,
                     std::uint32_t{3} << detail::leaf_count_shift);
       }},
      {"segments of leaves",
       [](Arrays& a) { std::swap(a.tree().segments, a.own.trees[Arrays::finest - 1].segments); }},
      {"segments of leaves", [](Arrays& a) { a.tree().segments += 1; }},
      {"segments of leaves", [](Arrays& a) { a.tree().points += 1; }},
      {"segments of leaves", [](Arrays& a) { a.own.leaf_segments.push_back(1 << detail::leaf_count_shift); }},
      {"outer radii", [](Arrays& a) { a.lowest_block()[detail::block_outer + 3] += 1; }},
      {"outer radii", [](Arrays& a) { a.lowest_block()[detail::block_outer + 3] = nan; }},
      {"outer radii", [](Arrays& a) { a.tree().outer_radius += 1; }},
  };
  return all;
}

/// By what is said of it.
const std::vector<Damage>& named_damage() {
  static const std::vector<Damage> all = {
      {"depths 2: expected more than", [](Arrays& a) { a.own.depths[2] = 0; }},
      {"is not the next block", [](Arrays& a) { a.set_child(0x7fffffe0); }},
      {"is not the next block", [](Arrays& a) { a.set_child(a.tree().top + 2 * detail::block_floats); }},
      {"is not the next block", [](Arrays& a) { a.set_child(a.tree().top + 1); }},
      {"leaf blocks at 0",
       [](Arrays& a) { a.name(a.lowest_block(), 0) = std::bit_cast<float>(detail::leaf_bit); }},
      {"to 2147483647", [](Arrays& a) { a.name(a.lowest_block(), 0) = std::bit_cast<float>(~0u); }},
      {"trees 2: the first leaf block", [](Arrays& a) { add(a.name(a.lowest_block(), 0), 1); }},
      {"begins with padding", [](Arrays& a) { a.top_block()[0] = infinity; }},
      {"trees 2", [](Arrays& a) { a.tree().stride = ~0u; }},
      {"trees 2", [](Arrays& a) { a.tree().stride -= 1; }},
      {"trees 2", [](Arrays& a) { a.tree().top = 0; }},
      {"", [](Arrays& a) { a.tree().top = 0x7fffffff; }},
      {"", [](Arrays& a) { a.tree().top = ~0u; }},
      {"", [](Arrays& a) { a.tree().top |= detail::leaf_bit; }},
      {"expected discs of finite numbers", [](Arrays& a) { a.top_block()[0] = nan; }},
      {"expected discs of finite numbers", [](Arrays& a) { a.top_block()[0] = -infinity; }},
      {"expected discs of finite numbers", [](Arrays& a) { a.top_block()[detail::block_width] = infinity; }},
      {"expected discs of finite numbers", [](Arrays& a) { a.top_block()[2 * detail::block_width] = -0.1f; }},
      {"expected discs of finite numbers",
       [](Arrays& a) { a.top_block()[2 * detail::block_width] = infinity; }},
      {"roots 0", [](Arrays& a) { a.own.roots[0].radius = -1; }},
      {"roots 0", [](Arrays& a) { a.own.roots[0].radius = 0; }},
      {"roots 1", [](Arrays& a) { a.own.roots[1].x = nan; }},
      {"roots 1", [](Arrays& a) { a.own.roots[1].row = 2; }},
      {"roots 5: row 3", [](Arrays& a) { a.own.roots[2].row = detail::single_disc; }},
      {"support 3", [](Arrays& a) { a.own.support[3] = 1; }},
      {"support 70", [](Arrays& a) { a.own.support[70] = nan; }},
      {"max_extent 1", [](Arrays& a) { a.own.max_extent[1] = 1e7f; }},
      {"max_extent 2", [](Arrays& a) { a.own.max_extent[2] = nan; }},
      {"inscribed 1", [](Arrays& a) { a.own.inscribed[1].radius[3] = nan; }},
      {"profiles 1", [](Arrays& a) { a.own.profiles[1].y = infinity; }},
      {"profiles 1", [](Arrays& a) { a.own.profiles[1].sectors[31].inner = nan; }},
      {"profiles 1", [](Arrays& a) { a.own.profiles[1].sectors[0].outer = infinity; }},
      {"profiles 1", [](Arrays& a) { a.own.profiles[1].sectors[7].extent = infinity; }},
      {"shape_contours 0", [](Arrays& a) { a.own.shape_contours[0].begin = 1; }},
      {"shape_contours 2", [](Arrays& a) { a.own.shape_contours[2].begin = 0; }},
      {"shape_contours 1: ends", [](Arrays& a) { a.own.shape_contours[1].end = 0; }},
      {"shape_contours: expected an end at 4, found 1000",
       [](Arrays& a) { a.own.shape_contours[2].end = 1000; }},
      {"contours 2", [](Arrays& a) { a.own.contours[2].begin = 1; }},
      {"contours: expected an end at 62, found 4294967296", [](Arrays& a) { a.own.contours[3].end = ~0u; }},
      {"contours 1", [](Arrays& a) { a.own.contours[1].end = 0; }},
      {"contours 3", [](Arrays& a) { a.own.contours[3].disc.radius = -1; }},
      {"points 5", [](Arrays& a) { a.own.points[5].y = nan; }}};
  return all;
}

/// What the other checks read without looking: where one of these does not hold they must not run.
const std::set<std::string> relied_upon = {"depths", "sizes", "shape contours", "contours", "order of levels",
                                           "blocks", "room",  "leaf blocks",    "numbers"};

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
      level.root = root, level.begin = level.end, level.leaf_blocks = {};
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

TEST(ShapePreconditions, EachRefusesWhatNoOtherDoes) {
  std::set<std::string> damaged;
  for (const Damage& damage : all_damage()) {
    damaged.insert(damage.what);
    Arrays arrays(damage.plan);
    damage.make(arrays);
    const detail::ShapeArrays view = arrays.view();
    EXPECT_THROW(validate(view), std::invalid_argument) << damage.what;
    EXPECT_EQ(refused_by(view, "", ""), damage.what);
    const bool others_may_run = !relied_upon.contains(damage.what);
    EXPECT_EQ(refused_by(view, damage.what, others_may_run ? "" : damage.what), "") << damage.what;
  }
  for (const detail::Precondition& each : detail::shape_preconditions())
    EXPECT_TRUE(damaged.contains(each.name)) << each.name << ": no damage violates it";
}

TEST(ShapePreconditions, SayWhatIsWrong) {
  for (const Damage& damage : named_damage()) {
    Arrays arrays(damage.plan);
    damage.make(arrays);
    const std::string message = complaint([&] { validate(arrays.view()); });
    EXPECT_TRUE(has(message, damage.what));
    EXPECT_NE(message, "accepted") << damage.what;
  }
}

// ---- What verify() says of sets that were made honestly, and of such with one number changed.

const ShapeSetPlan plans[] = {{},
                              {{0}, false, false},
                              {{0, 3, 6, all_depths}, true, true},
                              {{2, 5}, true},
                              {{0, 6}, false, false},
                              {{4}, false, true, true},
                              {{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, all_depths}, true}};

void expect_nothing(const ShapeSet& set) {
  for (const Inconsistency& inconsistency : verify(set, 5)) ADD_FAILURE() << text_of(inconsistency);
}

TEST(Verify, FindsNothingInSyntheticShapes) {
  const std::vector<Shape> shapes = synthetic_shapes(91, samples(400));
  for (const ShapeSetPlan& plan : plans) expect_nothing(ShapeSet(shapes, plan));
}

TEST(Verify, FindsNothingInCharacters) {
  for (const Character& character : people()) {
    const std::vector<Shape> shapes = pose_shapes(character, 60);
    for (const ShapeSetPlan& plan : plans) expect_nothing(ShapeSet(shapes, plan));
  }
}

TEST(Verify, FindsNothingInShapesWithoutOutlines) {
  std::vector<Shape> shapes = synthetic_shapes(92, 40);
  for (Shape& shape : shapes) shape.outline = {};
  shapes.push_back({{}, detail::fixed_cylinder(0.25f)});
  for (const ShapeSetPlan& plan : plans)
    if (!plan.outlines) expect_nothing(ShapeSet(shapes, plan));
}

/// Their nodes hold their discs, as their trees say.
TEST(Verify, LooksAtBodiesOfDiscs) {
  std::vector<Disc> body;
  for (int i = 0; i < 12; ++i)
    body.push_back({0.125f * static_cast<float>(i), 0.0625f * static_cast<float>(i % 3), 0.25f});
  const std::vector<Shape> shapes(2, shape_from_discs(body));
  for (const ShapeSetPlan& plan : plans) expect_nothing(ShapeSet(shapes, plan));
  // A disc that is large enough to be beyond the nodes above it, though it touches the same others.
  BakedBytes bytes(ShapeSet(shapes), origins_of(2));
  const detail::Tree& tree = bytes.section<detail::Tree>(Section::trees)[1];
  ASSERT_NE(tree.conservative_nodes, 0u);
  bytes.section<float>(Section::nodes)[tree.discs + 2 * tree.stride + 1] += 0.125f;
  bytes.seal();
  bool said = false;
  for (const Inconsistency& inconsistency : verify(bytes.load().set, 50))
    said |= inconsistency.what.find("does not hold the discs below it") != std::string::npos;
  EXPECT_TRUE(said);
}

TEST(Verify, FindsNothingInADynamicSet) {
  const std::vector<Shape> pool = synthetic_shapes(93, 40);
  const ShapeSetPlan plan{{0, 3, all_depths}, true};
  DynamicShapeSet dynamic(ShapeSet({pool.data(), 8}, plan));
  Random random(94);
  BuiltShape prepared(plan);
  for (int i = 0; i < 60; ++i) {
    prepared.prepare(pool[random.below(40)], 0);
    dynamic.replace(random.below(8), prepared);
    expect_nothing(dynamic.set());
  }
}

struct Lie {
  const char* array;
  const char* says;
  std::function<void(DamagedArrays&)> report;
};

constexpr std::size_t first_support = detail::first_row * detail::support_stride;

const std::vector<Lie>& lies() {
  static const std::vector<Lie> all = {
      {"depths", "discs at depth 1", [](Arrays& a) { a.own.depths[1] = 1; }},
      {"nodes", "needs", [](Arrays& a) { a.lowest_block()[detail::block_outer] *= 0.9f; }},
      {"nodes", "needs", [](Arrays& a) { a.tree().outer_radius *= 1.01f; }},
      {"nodes", "needs", [](Arrays& a) { a.tree().outer_radius *= 0.99f; }},
      {"nodes", "is not below", [](Arrays& a) { add(a.name(a.lowest_block(), 1), 1); }},
      {"nodes", "sticks out of the one above", [](Arrays& a) { a.radii()[0] *= 3; }},
      {"nodes", "belongs to none", [](Arrays& a) { a.radii()[0] = 1; }},
      {"nodes", "cover", [](Arrays& a) { a.discs()[4] += 0.01f; }},
      {"nodes", "cover", [](Arrays& a) { a.own.points[7].x *= 0.5f; }},
      {"max_extent", "its discs say", [](Arrays& a) { a.own.max_extent[1] *= 0.9f; }},
      {"max_extent", "the outline reaches", [](Arrays& a) { a.own.max_extent[0] *= 1.001f; }},
      {"support", "number 11", [](Arrays& a) { a.own.support[first_support + 11] -= 0.001f; }},
      {"support", "number 63", [](Arrays& a) { a.own.support[first_support + 63] += 0.001f; }},
      {"inscribed", "disc 2", [](Arrays& a) { a.own.inscribed[0].radius[2] += 0.01f; }},
      {"inscribed", "disc 1", [](Arrays& a) { a.own.inscribed[1].x[1] += 0.5f; }},
      {"inscribed", "disc 0", [](Arrays& a) { a.own.inscribed[1].y[0] -= 0.05f; }},
      {"profiles", "centre", [](Arrays& a) { a.own.profiles[0].x += 0.01f; }},
      {"profiles", "inner of sector 3", [](Arrays& a) { a.own.profiles[0].sectors[3].inner += 0.01f; }},
      {"profiles", "outer of sector 4", [](Arrays& a) { a.own.profiles[0].sectors[4].outer -= 0.01f; }},
      {"profiles", "extent of sector 5", [](Arrays& a) { a.own.profiles[0].sectors[5].extent += 0.01f; }},
      {"profiles", "shallow_outer of sector 6",
       [](Arrays& a) { a.own.profiles[0].sectors[6].shallow_outer -= 0.01f; }},
      {"contours", "contour 0",  // still about the points that it has
       [](Arrays& a) {
         detail::Contour& contour = a.own.contours[0];
         Disc& disc = contour.disc;
         disc.x += 0.05f, disc.radius = 0;
         for (std::uint32_t i = 0; i < contour.end; ++i)
           disc.radius =
               std::max(disc.radius, std::hypot(a.own.points[i].x - disc.x, a.own.points[i].y - disc.y));
       }},
      {"leaf_segments", "no leaves that name segment",
       [](Arrays& a) {
         std::uint32_t& word = a.own.leaf_segments[5];
         word = std::uint32_t{1} << detail::leaf_count_shift | (word + 3) % 8;
       }},
      {"segment_margin", "is below what rounding needs", [](Arrays& a) { a.own.segment_margin[0] *= 0.2f; }},
  };
  return all;
}

TEST(Verify, NamesTheLie) {
  for (const Lie& lie : lies()) {
    Arrays arrays;
    lie.report(arrays);
    ASSERT_NO_THROW(validate(arrays.view())) << lie.array << ", " << lie.says;
    bool found = false;
    std::string all;
    for (const Inconsistency& inconsistency : verify(ShapeSet(arrays.view(), nullptr))) {
      all += text_of(inconsistency) + "\n";
      found |= inconsistency.array == std::string(lie.array) &&
               inconsistency.what.find(lie.says) != std::string::npos;
    }
    EXPECT_TRUE(found) << lie.array << ", " << lie.says << ":\n" << all;
  }
}

TEST(Verify, SaysNoMoreThanItIsAskedFor) {
  Arrays arrays;
  for (std::size_t i = first_support; i < arrays.own.support.size(); ++i) arrays.own.support[i] -= 0.1f;
  const ShapeSet set(arrays.view(), nullptr);
  EXPECT_EQ(verify(set, 7).size(), 7u);
  EXPECT_GT(verify(set, 1000).size(), 100u);
}

TEST(Verify, LooksAtRootsWithoutTrees) {
  const std::vector<Shape> shapes = {{{}, detail::fixed_cylinder(0.25f)}};
  BakedBytes bytes(ShapeSet(shapes, {.depths = {0, 2}}), origins_of(1));
  bytes.section<detail::Root>(Section::roots)[1].radius = 0.3f;
  bytes.seal();
  const auto findings = verify(bytes.load().set);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].array, std::string("roots"));
}

}  // namespace
}  // namespace bch::test
