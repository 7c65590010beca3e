// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include <bch/poses.hpp>

#include "bench/base/svg.hpp"
#include "bench/base/text.hpp"
#include "bench/cli/inspection.hpp"

namespace bch::cli {
namespace {

constexpr double edge_width = 20, views_top = 84, body_view = 360, view_gap = 20;
constexpr double side_height = 640, above_height = 330;  ///< panels: from the side, and from above
constexpr double body_picture_width = 2 * (edge_width + body_view) + view_gap,
                 body_picture_height = views_top + side_height + edge_width;
constexpr double second_view =
    edge_width + body_view + view_gap;  ///< of the view from above, and of the legend

constexpr const char* body_style = R"(.key { font-size: 17px }
.view { font-size: 17px; font-weight: bold }
.middle { text-anchor: middle }
.panel { fill: #f4f6f8 }
.ball { fill: url(#ball); stroke: #48647c; stroke-width: .5 }
.core { fill: url(#core); stroke: #7a2f06 }
.ball-lit { stop-color: #e3edf5 } .ball-shade { stop-color: #7d9db8 }
.core-lit { stop-color: #ffcfa3 } .core-shade { stop-color: #d2601a }
.skin { fill: none; stroke: #111a22; stroke-width: 1.6; stroke-linejoin: round }
.bone-edge { stroke: #111a22; stroke-width: 3.8; stroke-linecap: round }
.bone { stroke: #fff; stroke-width: 1.8; stroke-linecap: round }
.scale { fill: none; stroke: #1c2733; stroke-width: 2 }
@media (prefers-color-scheme: dark) {
.ground { fill: #12161b } .panel { fill: #1d242b } text, .caption { fill: #dde4ea }
.skin, .scale { stroke: #f2f5f8 }
.ball { stroke: #10181f } .ball-lit { stop-color: #9dbad2 } .ball-shade { stop-color: #3f5c74 }
.core-lit { stop-color: #ffb47a } .core-shade { stop-color: #b0480c }
}
)";

/// A direction to look in, by how it turns a point so that one who looks down sees what one who looks so does.
struct View {
  const char* name;
  Vec3 (*turn)(Vec3 point);
};

constexpr View from_side{"from the side", [](Vec3 p) { return Vec3{p.x, p.z, -p.y}; }};
constexpr View from_above{"from above", [](Vec3 p) { return p; }};

/// Bones as lines, from the joint of each to that of the next bone towards the root.
using Bones = std::vector<std::array<Vec3, 2>>;

Bones bones_of(const Character& character, PoseTime at) {
  if (character.root_joint < 0) return {};
  const std::vector<Affine3d> joints = joint_transforms(character, at, JointFrame::world);
  const auto& root = joints[static_cast<std::size_t>(character.root_joint)].rows;
  const auto point = [&](std::uint32_t joint) {
    const auto& rows = joints[joint].rows;
    return Vec3{static_cast<float>(rows[0][3] - root[0][3]), static_cast<float>(rows[1][3] - root[1][3]),
                static_cast<float>(rows[2][3])};
  };
  std::vector<bool> has_bone(joints.size());
  for (const Bone& bone : character.bones) has_bone[bone.joint] = true;
  Bones bones;
  for (std::uint32_t joint = 0; joint < joints.size(); ++joint) {
    const std::int32_t parent = character.joints[joint].parent;
    if (parent >= 0 && has_bone[joint] && has_bone[static_cast<std::size_t>(parent)])
      bones.push_back({point(static_cast<std::uint32_t>(parent)), point(joint)});
  }
  return bones;
}

/// What all views show.
struct Subject {
  const Character& character;
  std::span<const Sphere> spheres;
  std::vector<bool> are_core;
  std::vector<Vec3> skin;
  Bones bones;
};

Sphere turned(const View& view, const Sphere& s) {
  const Vec3 centre = view.turn({s.x, s.y, s.z});
  return {centre.x, centre.y, centre.z, s.radius};
}

Bounds bounds_of(const View& view, const Subject& subject) {
  Bounds bounds;
  for (const Sphere& s : subject.spheres) {
    const Sphere seen = turned(view, s);
    bounds.add(Disc{seen.x, seen.y, seen.radius});
  }
  return bounds;
}

/// The nearest are drawn last.
void draw_spheres(Svg& svg, const View& view, const Subject& subject, const Placement& placement) {
  std::vector<std::size_t> order(subject.spheres.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto height = [&](std::size_t i) { return turned(view, subject.spheres[i]).z; };
  std::ranges::stable_sort(order, {}, height);
  for (const std::size_t i : order) {
    const PixelDisc ball = placed(placement, turned(view, subject.spheres[i]));
    svg.circle(ball.centre, ball.radius, subject.are_core[i] ? "core" : "");
  }
}

void draw_skin(Svg& svg, const View& view, const Subject& subject, const Placement& placement) {
  std::vector<Vec3> seen;
  for (const Vec3& point : subject.skin) seen.push_back(view.turn(point));
  draw_outline(svg, placement, ShapeBuilder(subject.character).make_outline(PosedVertices{seen}).outline);
}

void draw_bones(Svg& svg, const View& view, const Bones& bones, const Placement& placement) {
  const auto seen = [&](Vec3 point) {
    const Vec3 turned_point = view.turn(point);
    return placement(Vec2{turned_point.x, turned_point.y});
  };
  for (const char* classes : {"bone-edge", "bone"})
    svg.group({}, classes, [&] {
      for (const auto& [from, to] : bones) svg.line(seen(from), seen(to));
    });
}

void draw_view(Svg& svg, const View& view, const Subject& subject, Pixel corner, double height,
               double scale) {
  const Bounds bounds = bounds_of(view, subject);
  const Placement placement{{corner.x + body_view / 2 - scale * (bounds.left + bounds.right) / 2,
                             corner.y + height / 2 + scale * (bounds.low + bounds.high) / 2},
                            1,
                            0,
                            scale};
  svg.rectangle(corner, body_view, height, "panel");
  svg.group({}, "ball", [&] { draw_spheres(svg, view, subject, placement); });
  svg.group({}, "skin", [&] { draw_skin(svg, view, subject, placement); });
  draw_bones(svg, view, subject.bones, placement);
  svg.text({corner.x + 12, corner.y + 26}, "view", view.name);
}

/// Pixels a metre, by which both views fit.
double scale_of(const Subject& subject) {
  const Bounds side = bounds_of(from_side, subject), above = bounds_of(from_above, subject);
  return 0.9 * std::min({body_view / (side.right - side.left), (side_height - 30) / (side.high - side.low),
                         (above_height - 30) / (above.high - above.low)});
}

void draw_body_legend(Svg& svg, const BodyFacts& facts, bool has_bones, double scale) {
  double y = views_top + above_height + 36;
  const double middle = second_view + 20, text = second_view + 56;
  const auto key = [&](const auto& draw, std::initializer_list<std::string> lines) {
    draw();
    for (const std::string& line : lines) {
      svg.text({text, y + 6}, "key", line);
      y += 24;
    }
    y += 12;
  };
  svg.group("legend", {}, [&] {
    key([&] { svg.group({}, "ball", [&] {
                svg.circle({middle, y}, 12);
              }); },
        {fmt::format("{} spheres, bound to the bones;", facts.spheres.size()), "in every pose each triangle",
         "of the skin is in one of them"});
    key([&] { svg.group({}, "ball", [&] {
                svg.circle({middle, y}, 12, "core");
              }); },
        {fmt::format("{} of them are tested first", std::ranges::count(facts.are_core(), true))});
    key([&] { svg.group({}, "skin", [&] {
                svg.line({middle - 16, y}, {middle + 16, y});
              }); },
        {"outline of the skin"});
    if (!has_bones) return;
    key(
        [&] {
          for (const char* classes : {"bone-edge", "bone"})
            svg.group({}, classes, [&] { svg.line({middle - 14, y}, {middle + 14, y}); });
        },
        {"bones"});
  });
  const double length = round_length(body_view / 2 / scale), end = second_view + 4 + length * scale;
  const double at = body_picture_height - edge_width - 28;
  svg.group("scale", "scale", [&] { svg.scale(second_view + 4, end, at); });
  svg.text({(second_view + 4 + end) / 2, at + 24}, "key middle", fmt::format("{:g} m", length));
}

}  // namespace

std::string draw_body(const LoadedCharacter& character, const BodyFacts& facts) {
  const Subject subject{character.character, facts.spheres, facts.are_core(),
                        pose_vertices(character.character, facts.source.at),
                        bones_of(character.character, facts.source.at)};
  const std::string title =
      fmt::format("{}, {}", character.character.name, pose_title(character, facts.source.at));
  Svg svg(body_picture_width, body_picture_height, title, body_style);
  svg.define_ball("ball");
  svg.define_ball("core");
  svg.text({edge_width, 38}, "title", title);
  svg.text({edge_width, 64}, "caption",
           fmt::format("A body of {} as queries see it: {:.1f} kB.", counted(facts.spheres.size(), "sphere"),
                       static_cast<double>(facts.bytes) / 1e3));
  const double scale = scale_of(subject);
  svg.group("side", {}, [&] {
    draw_view(svg, from_side, subject, {edge_width, views_top}, side_height, scale);
  });
  svg.group("above", {}, [&] {
    draw_view(svg, from_above, subject, {second_view, views_top}, above_height, scale);
  });
  draw_body_legend(svg, facts, !subject.bones.empty(), scale);
  return std::move(svg).finish();
}

}  // namespace bch::cli
