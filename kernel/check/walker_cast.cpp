// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/check/walker_cast.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>
#include <stdexcept>

#include "layout/base/random.hpp"
#include "layout/character/skinning.hpp"

namespace bch::detail {
namespace {

constexpr double sample_step = 1.0 / 60;  ///< seconds
constexpr double slowest_walk = 0.3;      ///< metres a second, of a clip that walks
constexpr double fastest_idle = 0.2;      ///< of a foot on the ground, because hips sway
constexpr double straight = 0.8;          ///< the least share of the foot's speed that goes straight back
constexpr double same_way = 0.95;         ///< the least cosine between a walk and all of them
constexpr double still =
    0.02;  ///< metres a second of any vertex: a clip without motion, often of arms spread out
constexpr double half_step = 0.01;  ///< metres: no vertex moves by more
constexpr std::uint32_t most_phases = 65'535, most_clips = 65'535;
constexpr double standing = 0.15;  ///< metres a second: who is slower stands

/// How a clip moves.
struct Movement {
  double x = 0, y = 0;  ///< the body's velocity over the foot on the ground, metres a second: medians
  double speed = 0;     ///< the median of that foot's speeds
  double fastest = 0;   ///< of all vertices, seen from above, metres a second
  double height = 0;    ///< of the first pose, metres
};

bool is_lower(Vec3 a, Vec3 b) {
  return a.z < b.z;
}

double above_ground(std::span<const Vec3> pose) {
  const auto [low, high] = std::minmax_element(pose.begin(), pose.end(), is_lower);
  return static_cast<double>(high->z - low->z);
}

double square_way(Vec3 from, Vec3 to) {
  const double x = static_cast<double>(to.x - from.x), y = static_cast<double>(to.y - from.y);
  return x * x + y * y;
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Looks at a clip in steps. The lowest vertex is mostly of the foot on the ground; medians leave out when it is not.
Movement movement_of(Skinner& skinner, std::uint32_t clip) {
  const double seconds = static_cast<double>(skinner.character().clips[clip].seconds);
  const auto steps = std::max(1, static_cast<int>(seconds / sample_step));
  const double step = std::max(seconds / steps, 1e-3);
  Movement movement;
  std::vector<double> x, y, speed;
  const auto first = skinner.pose({clip, 0});
  movement.height = above_ground(first);
  std::vector<Vec3> before(first.begin(), first.end());
  for (int k = 1; k <= steps; ++k) {
    const auto now = skinner.pose({clip, static_cast<float>(seconds * k / steps)});
    for (std::size_t i = 0; i < before.size(); ++i)
      movement.fastest = std::max(movement.fastest, square_way(before[i], now[i]));
    const auto foot =
        static_cast<std::size_t>(std::min_element(before.begin(), before.end(), is_lower) - before.begin());
    x.push_back(static_cast<double>(before[foot].x - now[foot].x) / step);
    y.push_back(static_cast<double>(before[foot].y - now[foot].y) / step);
    speed.push_back(std::sqrt(square_way(before[foot], now[foot])) / step);
    before.assign(now.begin(), now.end());
  }
  movement.x = median(x), movement.y = median(y), movement.speed = median(speed);
  movement.fastest = std::sqrt(movement.fastest) / step;
  return movement;
}

CastClip clip_of(std::uint32_t clip, double seconds, const Movement& movement) {
  const double phases = std::ceil(seconds * movement.fastest / (2 * half_step));
  return {clip, std::sqrt(movement.x * movement.x + movement.y * movement.y),
          static_cast<std::uint32_t>(std::clamp(phases, 1.0, double{most_phases}))};
}

bool walks(const Movement& movement) {
  const double speed = std::sqrt(movement.x * movement.x + movement.y * movement.y);
  return speed >= slowest_walk && speed >= straight * movement.speed;
}

/// Turns what leads to the ground by the angle whose cosine and sine are c and s, and multiplies it by a factor.
void turn(Affine3& to_ground, double c, double s, double factor) {
  for (std::size_t column = 0; column < 4; ++column) {
    const double x = static_cast<double>(to_ground.rows[0][column]),
                 y = static_cast<double>(to_ground.rows[1][column]),
                 z = static_cast<double>(to_ground.rows[2][column]);
    to_ground.rows[0][column] = static_cast<float>(factor * (c * x - s * y));
    to_ground.rows[1][column] = static_cast<float>(factor * (s * x + c * y));
    to_ground.rows[2][column] = static_cast<float>(factor * z);
  }
}

std::vector<std::string> assumptions_of(const CastMember& member, std::size_t left_out) {
  std::ostringstream speeds;
  speeds.setf(std::ios::fixed);
  speeds.precision(2);
  speeds << member.name << ": walks, by its feet, at ";
  for (std::size_t i = 0; i < member.walks.size(); ++i)
    speeds << (i > 0 ? ", " : "") << member.walks[i].speed;
  speeds << " m/s, " << member.height << " m tall";
  std::vector<std::string> all{std::move(speeds).str()};
  if (member.idles.empty())
    all.push_back(member.name + ": has no clip that stands; who stands stops in the slowest walk");
  if (left_out > 0) {
    std::ostringstream text;
    text << member.name << ": clips that neither walk straight on nor stand are left out: " << left_out;
    all.push_back(std::move(text).str());
  }
  return all;
}

}  // namespace

CastMember cast_member(Character character, const std::string& name) {
  CastMember member{name, std::move(character), 0, {}, {}, {}};
  Skinner skinner(member.character);
  const auto clips =
      static_cast<std::uint32_t>(std::min<std::size_t>(member.character.clips.size(), most_clips));
  std::vector<Movement> movements;
  double x = 0, y = 0;
  for (std::uint32_t k = 0; k < clips; ++k) {
    const Movement& movement = movements.emplace_back(movement_of(skinner, k));
    if (walks(movement)) x += movement.x, y += movement.y;
  }
  const double length = std::sqrt(x * x + y * y);
  for (std::uint32_t k = 0; k < clips; ++k) {
    const Movement& movement = movements[k];
    const CastClip clip = clip_of(k, static_cast<double>(member.character.clips[k].seconds), movement);
    if (walks(movement) && x * movement.x + y * movement.y >= same_way * length * clip.speed)
      member.walks.push_back(clip);
    else if (movement.speed < fastest_idle && movement.fastest > still)
      member.idles.push_back(clip);
  }
  if (member.walks.empty())
    throw std::invalid_argument(name + ": none of its clips walks straight on, as people in recordings do");
  member.height = movements[member.walks[0].clip].height;
  std::stable_sort(member.walks.begin(), member.walks.end(),
                   [](const CastClip& a, const CastClip& b) { return a.speed < b.speed; });
  turn(member.character.to_ground, x / length, -y / length, 1);
  member.assumptions =
      assumptions_of(member, member.character.clips.size() - member.walks.size() - member.idles.size());
  return member;
}

std::uint32_t member_by_id(std::int64_t id, CastView cast) {
  Random random(0x2545f4914f6cdd1du ^ static_cast<std::uint64_t>(id));
  return random.below(static_cast<std::uint32_t>(cast.size()));
}

CastPose cast_pose(const CastMember& member, const Walker& walker, std::uint32_t coarse) {
  const bool stands = walker.speed < standing;
  const double size = walker.stature / member.height;
  const auto& clips = stands && !member.idles.empty() ? member.idles : member.walks;
  std::size_t at = 0;
  if (&clips == &member.idles)
    at = static_cast<std::size_t>(static_cast<std::uint64_t>(walker.id) % clips.size());
  else
    while (at + 1 < clips.size() && walker.speed * 2 > size * (clips[at].speed + clips[at + 1].speed)) ++at;
  const CastClip& clip = clips[at];
  const double seconds = std::max(1e-3, static_cast<double>(member.character.clips[clip.clip].seconds));
  const double turns =
      &clips == &member.idles ? walker.seconds / seconds : walker.way / (size * clip.speed * seconds);
  const std::uint32_t phases = std::max(1u, clip.phases / coarse);
  const double share = turns - std::floor(turns);
  const std::uint32_t phase = std::min(static_cast<std::uint32_t>(share * phases), phases - 1);
  return {clip.clip, phase, static_cast<float>((phase + 0.5) / phases * seconds)};
}

Character scaled(const CastMember& member, double stature) {
  Character character = member.character;
  turn(character.to_ground, 1, 0, stature / member.height);
  return character;
}

}  // namespace bch::detail
