// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/cli/crowd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "bench/base/disc_union_area.hpp"
#include "bench/base/svg.hpp"
#include "bench/base/text.hpp"

namespace bch::cli {
namespace {

constexpr double picture_width = 1100, margin = 20;
constexpr double view_top = 76, view_width = picture_width - 2 * margin, view_height = 620;
constexpr double legend_height = 84;
constexpr double picture_height = view_top + view_height + legend_height;
/// Agents with their middle in the window, about. A crowd of hardly more is drawn whole.
constexpr double window_agents = 48, whole_crowd = 60;

constexpr const char* style =
    R"(.key { font-size: 22px }
.middle { text-anchor: middle }
.view { fill: #f7f9fa }
.frame { fill: none; stroke: #9aa7b3 }
.shape { stroke-width: 1.3; stroke-linejoin: round; fill-opacity: .8 }
.discs { stroke-width: .8; fill: none; stroke-opacity: .7 }
.free .shape, .cleared .shape { fill: #9cc3e6; stroke: #1f5f99 }
.free .discs, .cleared .discs { stroke: #2f6a9e }
.cylinder { fill: none; stroke: #1f5f99; stroke-width: 2; stroke-dasharray: 7 5 }
.partner { fill: none; stroke: #8d8d8d; stroke-width: 1; stroke-dasharray: 2 4 }
.colliding .shape { fill: #d9622b; stroke: #7a2503 }
.colliding .discs { stroke: #6b1f02 }
.overlap { fill: #7d1402; stroke: #2e0500; stroke-width: .9; opacity: .72 }
.scale { fill: none; stroke: #1c2733; stroke-width: 2 }
)";

enum State : std::size_t { is_free, is_cleared, is_colliding, states };
constexpr std::array<const char*, states> state_name{"free", "cleared", "colliding"};

/// The part of the ground that is drawn, metres.
struct Window {
  double x, y, width, height;
  double scale() const { return view_width / width; }
};

Window middle_of(const CrowdPicture& picture) {
  constexpr double aspect = view_width / view_height;
  constexpr double border_metres = 1;  // for those who stand at the edge, metres
  const double middle = picture.crowd.side / 2;
  const bool whole = static_cast<double>(picture.crowd.size()) <= whole_crowd;
  const double h =
      whole ? picture.crowd.side + border_metres : std::sqrt(window_agents / picture.density / aspect);
  return {middle - h * aspect / 2, middle - h / 2, h * aspect, h};
}

std::string caption_of(const CrowdPicture& picture, const Window& window) {
  const double side = picture.crowd.side;
  const std::string part = window.height >= side
                               ? fmt::format("All {:.1f} m × {:.1f} m", side, side)
                               : fmt::format("The middle {:.1f} m × {:.1f} m of {:.1f} m × {:.1f} m",
                                             window.width, window.height, side, side);
  return fmt::format("{}, seen from above. {}", part, picture.parts_are);
}

struct DrawnAgent {
  DrawnBody body;
  Placement placement;
  State state = is_free;
  bool is_partner = false;  ///< collides, and its cylinder overlaps that of a cleared agent
  std::vector<PixelDisc> discs = {};
  std::vector<bool> overlaps = {};  ///< per disc

  DrawnAgent(DrawnBody drawn, const Placement& at, State how = is_free)
      : body(std::move(drawn)), placement(at), state(how), overlaps(body.parts.size()) {
    for (const Sphere& part : body.parts) discs.push_back(placed(placement, part));
  }
};

class Scene {
 public:
  explicit Scene(const CrowdPicture& picture);
  void draw(Svg& svg) const;
  Window window;

 private:
  void add_visible_agents(const CrowdPicture& picture);
  DrawnAgent* drawn(std::uint32_t agent);
  void colour(std::span<const Pair> pairs, State state);
  void mark_overlaps(std::span<const Pair> colliding);
  void mark_partners(std::span<const Pair> cleared);

  bool reaches_in(const DrawnAgent& agent) const;

  double reach_;  ///< of a body, metres
  static constexpr std::uint32_t unseen = 0xffffffff;
  std::vector<DrawnAgent> agents_;
  std::vector<std::uint32_t> drawn_index_;  ///< per agent of the crowd
};

Scene::Scene(const CrowdPicture& picture) : window(middle_of(picture)), reach_(picture.reach) {
  add_visible_agents(picture);
  colour(picture.cleared, is_cleared);
  colour(picture.colliding, is_colliding);
  mark_overlaps(picture.colliding);
  mark_partners(picture.cleared);
}

/// Adds the agents in the window and those just outside: their parts reach in, or they touch agents whose parts do.
void Scene::add_visible_agents(const CrowdPicture& picture) {
  const Crowd& crowd = picture.crowd;
  drawn_index_.assign(crowd.size(), unseen);
  const double reach = 2 * reach_;
  for (std::uint32_t i = 0; i < crowd.size(); ++i) {
    const double x = crowd.x[i] - window.x, y = crowd.y[i] - window.y;
    if (x < -reach || y < -reach || x > window.width + reach || y > window.height + reach) continue;
    drawn_index_[i] = static_cast<std::uint32_t>(agents_.size());
    agents_.emplace_back(picture.body(i),
                         Placement{{margin + window.scale() * x, view_top + view_height - window.scale() * y},
                                   std::cos(crowd.heading[i]),
                                   std::sin(crowd.heading[i]),
                                   window.scale()});
  }
}

DrawnAgent* Scene::drawn(std::uint32_t agent) {
  return drawn_index_[agent] == unseen ? nullptr : &agents_[drawn_index_[agent]];
}

void Scene::colour(std::span<const Pair> pairs, State state) {
  for (const auto [first, second] : pairs)
    for (DrawnAgent* const agent : {drawn(first), drawn(second)})
      if (agent != nullptr) agent->state = state;
}

void Scene::mark_overlaps(std::span<const Pair> colliding) {
  for (const auto [first, second] : colliding) {
    DrawnAgent *const a = drawn(first), *const b = drawn(second);
    if (a == nullptr || b == nullptr) continue;
    for (std::size_t i = 0; i < a->discs.size(); ++i)
      for (std::size_t j = 0; j < b->discs.size(); ++j)
        if (overlap(a->discs[i], b->discs[j])) a->overlaps[i] = true, b->overlaps[j] = true;
  }
}

/// Marks those whose cylinders explain why a cleared agent is not free.
void Scene::mark_partners(std::span<const Pair> cleared) {
  for (const auto [first, second] : cleared) {
    DrawnAgent *const a = drawn(first), *const b = drawn(second);
    if (a == nullptr || b == nullptr) continue;
    if (a->state == is_cleared && b->state == is_colliding) b->is_partner = true;
    if (b->state == is_cleared && a->state == is_colliding) a->is_partner = true;
  }
}

void draw_overlaps(Svg& svg, const DrawnAgent& agent) {
  std::vector<PixelDisc> discs;
  for (std::size_t i = 0; i < agent.discs.size(); ++i)
    if (agent.overlaps[i]) discs.push_back(agent.discs[i]);
  draw_discs(svg, visible(discs));
}

void draw_agent(Svg& svg, const DrawnAgent& agent) {
  svg.group({}, "shape", [&] { draw_outline(svg, agent.placement, agent.body.outline); });
  svg.group({}, "discs", [&] { draw_discs(svg, visible(agent.discs)); });
}

void draw_cylinder(Svg& svg, const DrawnAgent& agent) {
  draw_discs(svg, {placed(agent.placement, agent.body.cylinder)});
}

bool Scene::reaches_in(const DrawnAgent& agent) const {
  const double x = agent.placement.origin.x - margin, y = agent.placement.origin.y - view_top,
               reach = reach_ * window.scale();
  return x >= -reach && y >= -reach && x <= view_width + reach && y <= view_height + reach;
}

/// What matters most is drawn last.
void Scene::draw(Svg& svg) const {
  const auto draw = [&](const char* id, const char* classes, const auto& is_drawn, const auto& how) {
    svg.group(id, classes, [&] {
      for (const DrawnAgent& agent : agents_)
        if (is_drawn(agent) && reaches_in(agent)) how(svg, agent);
    });
  };
  for (std::size_t state = 0; state < states; ++state)
    draw(
        state_name[state], state_name[state], [&](const DrawnAgent& agent) { return agent.state == state; },
        draw_agent);
  draw(
      "overlaps", "overlap", [](const DrawnAgent&) { return true; }, draw_overlaps);
  draw(
      "partners", "partner", [](const DrawnAgent& agent) { return agent.is_partner; }, draw_cylinder);
  draw(
      "single-cylinders", "cylinder", [](const DrawnAgent& agent) { return agent.state == is_cleared; },
      draw_cylinder);
}

/// A small agent that stands for all of its kind.
void draw_key(Svg& svg, const CrowdPicture& picture, State state, double x, std::string_view first,
              std::string_view second) {
  constexpr double icon = 44;
  const Disc cylinder = picture.key.cylinder;
  const double scale = icon / 2 / static_cast<double>(cylinder.radius);
  const double y = view_top + view_height + legend_height / 2;
  DrawnAgent agent(
      picture.key,
      {{x + icon / 2 - scale * static_cast<double>(cylinder.x), y + scale * static_cast<double>(cylinder.y)},
       1,
       0,
       scale},
      state);
  svg.open_group({}, state_name[state]);
  draw_agent(svg, agent);
  if (state == is_cleared) svg.group({}, "cylinder", [&] { draw_cylinder(svg, agent); });
  if (state == is_colliding) {
    for (std::size_t i = 0; i < agent.discs.size(); ++i)
      agent.overlaps[i] = agent.discs[i].centre.x > x + 0.6 * icon;
    svg.group({}, "overlap", [&] { draw_overlaps(svg, agent); });
  }
  svg.close_group();
  svg.text({x + icon + 14, y - 5}, "key", first);
  svg.text({x + icon + 14, y + 21}, "key", second);
}

void draw_legend(Svg& svg, const CrowdPicture& picture, const Window& window) {
  svg.group("legend", {}, [&] {
    draw_key(svg, picture, is_colliding, margin, "collides;",
             fmt::format("overlapping {}s are dark", picture.part_name));
    draw_key(svg, picture, is_cleared, 440, "free; dashed: its single", "cylinder overlaps another's");
  });

  const double right = picture_width - margin, left = right - window.scale();
  const double y = view_top + view_height + 34;
  svg.group("scale", {}, [&] {
    svg.group({}, "scale", [&] { svg.scale(left, right, y); });
    svg.text({(left + right) / 2, y + 22}, "key middle", "1 m");
  });
}

}  // namespace

CrowdPicture picture_of(std::span<const Shape> shapes, const Crowd& crowd, const CrowdAnswers& answers,
                        std::uint32_t level, double density) {
  const LevelAnswers &drawn = answers.levels[level], &single = answers.levels.front();
  const auto body_of = [](const Shape& shape, std::uint32_t depth) {
    DrawnBody body{shape.outline, shape.hierarchy.nodes.front().disc, {}};
    for (const Disc& disc : discs_of(shape.hierarchy, depth))
      body.parts.push_back({disc.x, disc.y, 0, disc.radius});
    return body;
  };
  CrowdPicture picture{crowd, density};
  for (const Shape& shape : shapes) picture.reach = std::max(picture.reach, shape.hierarchy.max_extent);
  picture.body = [=, &crowd](std::uint32_t agent) {
    return body_of(shapes[crowd.shape[agent]], drawn.depth);
  };
  for (std::size_t p = 0; p < answers.pairs.size(); ++p)
    if (drawn.hits[p] != 0)
      picture.colliding.push_back(answers.pairs[p]);
    else if (single.hits[p] != 0)
      picture.cleared.push_back(answers.pairs[p]);
  picture.key = body_of(shapes.front(), std::min(drawn.depth, 4u));
  const double fraction =
      single.hit_count == 0 ? 0 : static_cast<double>(drawn.cleared) / static_cast<double>(single.hit_count);
  picture.title =
      fmt::format("{} agents, {:g} per m²: depth {} clears {} of {} collisions at depth 0 ({:.1f} %)",
                  grouped(crowd.size()), density, depth_name(drawn.depth), grouped(drawn.cleared),
                  grouped(single.hit_count), 100 * fraction);
  picture.parts_are = fmt::format("Discs and collisions at depth {}.", depth_name(drawn.depth));
  return picture;
}

std::string draw_crowd(const CrowdPicture& picture) {
  const Scene scene(picture);
  Svg svg(picture_width, picture_height, picture.title, style);
  svg.text({margin, 36}, "title", picture.title);
  svg.text({margin, 60}, "caption", caption_of(picture, scene.window));
  svg.rectangle({margin, view_top}, view_width, view_height, "view");
  svg.open_clipped_group("crowd", {margin, view_top}, view_width, view_height);
  scene.draw(svg);
  svg.close_group();
  svg.rectangle({margin, view_top}, view_width, view_height, "frame");
  draw_legend(svg, picture, scene.window);
  return std::move(svg).finish();
}

}  // namespace bch::cli
