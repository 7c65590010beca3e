// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/character_library.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>
#include <stdexcept>

#include "layout/base/number_class.hpp"
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
constexpr std::uint32_t max_phases = 65'535, max_clips = 65'535;
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

LibraryClip clip_of(const Clip& clip, const Movement& movement) {
  const double seconds = static_cast<double>(clip.seconds);
  const double phases = std::ceil(seconds * movement.fastest / (2 * half_step));
  return {clip.name, seconds, 0, static_cast<std::uint32_t>(std::clamp(phases, 1.0, double{max_phases}))};
}

double speed_of(const Movement& movement) {
  return std::sqrt(movement.x * movement.x + movement.y * movement.y);
}

bool walks(const Movement& movement) {
  return speed_of(movement) >= slowest_walk && speed_of(movement) >= straight * movement.speed;
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

std::vector<std::string> assumptions_of(const CharacterEntry& member, std::size_t left_out) {
  std::ostringstream speeds;
  speeds.setf(std::ios::fixed);
  speeds.precision(2);
  speeds << member.name << ": walks, by its feet, at ";
  for (std::size_t i = 0; i < member.walks.size(); ++i)
    speeds << (i > 0 ? ", " : "") << member.clips[member.walks[i]].speed;
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

void sort_walks(CharacterEntry& member) {
  std::stable_sort(member.walks.begin(), member.walks.end(), [&](std::uint32_t a, std::uint32_t b) {
    return member.clips[a].speed < member.clips[b].speed;
  });
}

CharacterEntry character_entry(Character character, const std::string& name) {
  CharacterEntry member{name, std::move(character), 0, {}, {}, {}, {}};
  Skinner skinner(member.character);
  const auto clips =
      static_cast<std::uint32_t>(std::min<std::size_t>(member.character.clips.size(), max_clips));
  std::vector<Movement> movements;
  double x = 0, y = 0;
  for (std::uint32_t k = 0; k < clips; ++k) {
    const Movement& movement = movements.emplace_back(movement_of(skinner, k));
    if (walks(movement)) x += movement.x, y += movement.y;
  }
  const double length = std::sqrt(x * x + y * y);
  for (std::uint32_t k = 0; k < clips; ++k) {
    const Movement& movement = movements[k];
    LibraryClip& clip = member.clips.emplace_back(clip_of(member.character.clips[k], movement));
    if (walks(movement) && x * movement.x + y * movement.y >= same_way * length * speed_of(movement))
      clip.speed = speed_of(movement), member.walks.push_back(k);
    else if (movement.speed < fastest_idle && movement.fastest > still)
      member.idles.push_back(k);
  }
  if (member.walks.empty())
    throw std::invalid_argument(name + ": none of its clips walks straight on, as people in recordings do");
  member.height = movements[member.walks[0]].height;
  sort_walks(member);
  turn(member.character.to_ground, x / length, -y / length, 1);
  member.assumptions =
      assumptions_of(member, member.character.clips.size() - member.walks.size() - member.idles.size());
  return member;
}

std::uint32_t member_by_id(std::int64_t id, CharacterLibraryView library) {
  Random random(0x2545f4914f6cdd1du ^ static_cast<std::uint64_t>(id));
  return random.below(static_cast<std::uint32_t>(library.size()));
}

namespace {

/// The clip of a walker whose row names none.
std::uint32_t clip_by_speed(const CharacterEntry& member, const Walker& walker, double size) {
  if (walker.speed < standing && !member.idles.empty())
    return member
        .idles[static_cast<std::size_t>(static_cast<std::uint64_t>(walker.id) % member.idles.size())];
  const auto speed = [&](std::size_t k) { return member.clips[member.walks[k]].speed; };
  std::size_t at = 0;
  while (at + 1 < member.walks.size() && walker.speed * 2 > size * (speed(at) + speed(at + 1))) ++at;
  return member.walks[at];
}

/// How often a walker has gone through a clip: by the time that his row says, else by the way, else by the time.
double turns_of(const LibraryClip& clip, const Walker& walker, double size) {
  const double seconds = std::max(1e-3, clip.seconds);
  if (!is_nan(walker.clip_seconds)) return static_cast<double>(walker.clip_seconds) / seconds;
  return clip.speed > 0 ? walker.way / (size * clip.speed * seconds) : walker.seconds / seconds;
}

/// The baked pose nearest to a share of a clip, behind whose last one the first follows.
std::uint32_t nearest_baked(const LibraryClip& clip, double share) {
  const auto seconds = static_cast<float>(share * clip.seconds);
  const auto& poses = clip.baked;
  const auto after = std::upper_bound(poses.begin(), poses.end(), seconds,
                                      [](float time, const BakedPose& pose) { return time < pose.seconds; });
  const auto period = static_cast<float>(clip.seconds);
  const bool is_last = after == poses.end(), is_first = after == poses.begin();
  const BakedPose& next = is_last ? poses.front() : *after;
  const BakedPose& before = is_first ? poses.back() : *(after - 1);
  const float to_next = next.seconds + (is_last ? period : 0) - seconds,
              to_before = seconds - before.seconds + (is_first ? period : 0);
  return static_cast<std::uint32_t>((to_next < to_before ? &next : &before) - poses.data());
}

}  // namespace

LibraryPose library_pose(CharacterLibraryView library, std::span<const LibraryMotion> motions,
                         const Walker& walker, std::uint32_t coarse) {
  const LibraryMotion* const motion =
      walker.motion == TrackedPerson::no_motion ? nullptr : &motions[walker.motion];
  const std::uint32_t member =
      motion != nullptr && motion->member ? *motion->member : member_by_id(walker.id, library);
  const CharacterEntry& body = library[member];
  const double size = body.height > 0 ? walker.stature / body.height : 1;
  const bool is_named = motion != nullptr && !motion->clips.empty();
  const std::uint32_t at = is_named ? motion->clips[member] : clip_by_speed(body, walker, size);
  const LibraryClip& clip = body.clips[at];
  const double turns = turns_of(clip, walker, size);
  const double share = turns - std::floor(turns);
  const auto exact = static_cast<float>(share * clip.seconds);
  if (!clip.baked.empty()) {
    const std::uint32_t phase = nearest_baked(clip, share);
    return {member, at, phase, clip.baked[phase].seconds, exact};
  }
  const std::uint32_t phases = std::max(1u, clip.phases / coarse);
  const std::uint32_t phase = std::min(static_cast<std::uint32_t>(share * phases), phases - 1);
  return {member, at, phase, static_cast<float>((phase + 0.5) / phases * clip.seconds), exact};
}

Character scaled(const CharacterEntry& member, double stature) {
  Character character = member.character;
  turn(character.to_ground, 1, 0, stature / member.height);
  return character;
}

}  // namespace bch::detail
