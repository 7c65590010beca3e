// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cmath>

#include "tests/fuzz/c_api_program.hpp"

// What arguments are, by their types: draw() gives each a value from the bytes of the input, which makes sense more often than not. Arrays
// have room for all that counts may say, and outputs are looked at after the call.

namespace bch::fuzz {

/// Objects of the library, which callers know by their handles alone.
template <class Object>
concept Opaque = !requires {
  sizeof(Object);
};
/// Structs that may be those of a caller of another version.
template <class Struct>
concept Versioned = requires(Struct of) {
  of.size;
};

/// A caller whose arguments the input draws.
class Caller : public Program {
 public:
  using Program::Program;

  /// Calls a function with arguments that the input draws.
  template <class... Parameters>
  void run_query(bch_status (*call)(Parameters...)) {
    const std::tuple<Parameters...> arguments{drawn<Parameters>()...};
    finish(std::apply(call, arguments));
  }
  template <class Value>
  Value drawn() {
    Value value{};
    draw(value);
    return value;
  }
  /// Frees a handle.
  template <Opaque Object>
  void run_query(bch_status (*call)(Object*)) {
    free(call);
  }

  // ---- Numbers

  void draw(float& value) { value = number<float>(); }
  void draw(double& value) { value = number<double>(); }
  void draw(std::uint8_t& value) { value = static_cast<std::uint8_t>(index()); }
  void draw(std::uint32_t& value) { value = index(); }
  void draw(std::int32_t& value) { value = static_cast<std::int32_t>(index(2)); }
  void draw(std::size_t& value) { value = count(); }

  // ---- Values

  void draw(bch_vec2& of) { draw_all(of.x, of.y); }
  void draw(bch_vec3& of) { draw_all(of.x, of.y, of.z); }
  void draw(bch_pair& of) { of = {index(most), index(most)}; }
  void draw(bch_heights& of) { draw_all(of.bottom, of.top); }
  void draw(bch_pose& of) { of = {chance(8) ? index() : BCH_REST_POSE, std::abs(number<float>())}; }
  void draw(bch_pose_id& of) { draw_all(of.character, of.at); }
  void draw(bch_disc& of) { draw_all(of.x, of.y), of.radius = size(); }
  void draw(bch_sphere& of) { draw_all(of.x, of.y, of.z), of.radius = size(); }
  void draw(bch_capsule& of) { draw_all(of.a, of.b), of.radius = size(); }
  /// A radius, mostly.
  float size() { return chance(32) ? number<float>() : std::abs(number<float>()) + 0x1p-5f; }
  void draw(bch_influence& of) {
    of = {index(), chance(64) ? number<float>() : 1 / 3.0f};  // three a vertex
  }
  void draw(bch_affine3& of) {
    of = {{{1, 0, 0, number<float>()}, {0, 1, 0, number<float>()}, {0, 0, 1, number<float>()}}};
  }

  // ---- Arrays

  /// Ascending, for planes and times; one that is not, at times.
  void fill(float* values, std::size_t count) {
    float at = std::abs(number<float>());
    for (std::size_t i = 0; i < count; ++i, at += 0.25f) values[i] = chance(64) ? number<float>() : at;
  }
  /// Coordinates of either sign, or distances.
  void fill(double* values, std::size_t count) {
    const bool positive = chance(2);
    for (std::size_t i = 0; i < count; ++i)
      values[i] = positive ? std::abs(number<double>()) : number<double>();
  }
  /// Where each part begins, of three entries mostly.
  void fill(std::uint64_t* offsets, std::size_t count) {
    std::uint64_t at = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (chance(64)) at = chance(4) ? ~std::uint64_t{0} - bytes.below(2) : bytes.below(room);
      offsets[i] = at;
      at = std::min<std::uint64_t>(at + (chance(16) ? bytes.below(6) : 3),
                                   std::max<std::uint64_t>(at, 3 * most));
    }
  }
  /// Parents of joints, mostly.
  void fill(std::int32_t* parents, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      parents[i] = chance(64) ? bytes.take<std::int32_t>() : i == 0 ? -1 : 0;
  }
  template <class Value>
  void fill(Value* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) draw(values[i]);
  }

  /// The first entries as the input says; the others repeat them, except for offsets.
  template <class Value>
  void draw(const Value*& values) {
    if (chance(128)) return void(values = nullptr);
    auto* const own = fresh<Value>(room);
    const std::size_t drawn = std::is_same_v<Value, std::uint64_t> ? most + 1 : most;
    fill(own, drawn);
    for (std::size_t i = drawn; i < room; ++i) own[i] = own[i - drawn];
    values = own;
  }

  /// An output: nothing is written on an error.
  template <class Value>
  void draw(Value*& values) {
    if (chance(128)) return void(values = nullptr);
    Value* const own = values = fresh<Value>(room);
    std::memset(static_cast<void*>(own), untouched, room * sizeof(Value));
    after([own](bool succeeded) {
      const auto* const bytes = reinterpret_cast<const std::uint8_t*>(own);
      const bool is_untouched = std::all_of(bytes, bytes + room * sizeof(Value),
                                            [](std::uint8_t byte) { return byte == untouched; });
      require(succeeded || is_untouched, "nothing is written on an error");
    });
  }
  /// The length of what was lent, if anything was.
  void draw(std::size_t*& count) {
    std::size_t* const own = count = fresh<std::size_t>();
    *own = untouched;
    after([this, own](bool succeeded) {
      require(succeeded || *own == untouched, "nothing is written on an error");
      if (succeeded) read_lent(*own);
    });
  }
  /// What is lent: an array, or a text.
  template <class Value>
  void draw(const Value**& values) {
    const Value** const own = values = fresh<const Value*>();
    lend(own);
    after([own](bool succeeded) { require(succeeded || *own == nullptr, "nothing is written on an error"); });
  }
  void draw(const char**& text) {
    const char** const own = text = fresh<const char*>();
    after([own](bool) { require(*own == nullptr || std::strlen(*own) < 1000, "names end"); });
  }
  void draw(const char*& text) {
    const std::string from = bytes.text();
    char* const own = fresh<char>(from.size() + 1);
    text = chance(64) ? nullptr : std::strcpy(own, from.c_str());
  }

  // ---- Handles

  template <Opaque Object>
  void draw(Object*& object) {
    object = handle<Object>();
  }
  template <Opaque Object>
  void draw(const Object*& object) {
    object = handle<Object>();
  }
  /// A new object.
  template <Opaque Object>
  void draw(Object**& made) {
    if (chance(128)) return void(made = nullptr);
    Object** const own = made = fresh<Object*>();
    after([this, own](bool succeeded) {
      require(succeeded == (*own != nullptr), "an object is handed out, and nothing on an error");
      if (succeeded) keep(*own, true);
    });
  }
  /// One that is lent.
  template <Opaque Object>
  void draw(const Object**& lent) {
    const Object** const own = lent = fresh<const Object*>();
    after([this, own](bool succeeded) {
      if (succeeded) keep(const_cast<Object*>(*own), false);
    });
  }

  // ---- Callbacks

  /// Cancels after so many calls. An older version has no user.
  inline static std::int32_t on_meeting(void* user, std::uint64_t, std::uint64_t) {
    return user != nullptr && (*static_cast<std::uint8_t*>(user))-- == 0;
  }
  void draw(bch_inconsistency& inconsistency) {
    inconsistency = [](void*, const char* line) { require(*line != '\0', "findings say something"); };
  }
  void draw(void*& user) {
    auto* const calls_left = fresh<std::uint8_t>();
    *calls_left = bytes.take<std::uint8_t>(), user = calls_left;
  }

  // ---- Structs

  void draw_numbers(const void*& of) {
    const double* numbers = nullptr;
    draw(numbers);
    of = numbers;
  }
  void draw(bch_work& of) {
    of.threads = 1, of.progress = chance(2) ? on_meeting : nullptr;
    draw(of.user);
  }
  void draw(bch_query_options& of) {
    of = BCH_QUERY_OPTIONS_INIT;
    draw_all(of.leaves, of.distance_leaves, of.overlap);
    of.threads = chance(32) ? 1025 + bytes.take<std::uint8_t>() : 1;
    if (chance(4)) draw(of.max_distance);
    if (chance(4)) of.implementation = bch_implementation_name(bytes.below(4));
    if (chance(32)) draw(of.implementation);
  }
  void draw(bch_agents& of) {
    draw_all(of.shape, of.count);
    draw_numbers(of.x), draw_numbers(of.y), draw_numbers(of.heading);
    if (chance(2)) draw(of.level);
    if (chance(4)) draw_numbers(of.z);
    // Floats are at most as far apart as the doubles whose memory they are in.
    if (chance(4)) of.numbers = BCH_FLOATS, of.x_stride = chance(2) ? 8 : 0, of.y_stride = chance(8) ? 6 : 4;
    if (chance(32)) of.numbers = index();
  }
  void draw(bch_pair_filter& of) {
    of = BCH_PAIR_FILTER_INIT;
    if (chance(2)) draw(of.category);
    if (chance(2)) draw(of.mask);
    if (chance(2)) draw(of.excluded), of.excluded_count = bytes.below(most + 1);
  }
  void draw(bch_crowd_options& of) {
    of = BCH_CROWD_OPTIONS_INIT;
    if (chance(4)) draw_all(of.period_x, of.period_y);
    if (chance(8)) of.max_pairs = bytes.below(8);
  }
  void draw(bch_clearance_out& of) {
    draw_all(of.distance, of.direction, of.discs, of.points);
    if (chance(2)) of.direction = nullptr, of.discs = nullptr;
  }
  void draw(bch_body_clearance_out& of) {
    draw_all(of.distance, of.direction, of.spheres, of.points);
    if (chance(2)) of.direction = nullptr, of.spheres = nullptr;
  }
  void draw(bch_outline& of) {
    draw(of.points), of.offsets = fresh<std::uint64_t>(room);
    of.point_capacity = count(), of.offset_capacity = count();
  }
  void draw(bch_plan& of) {
    of = BCH_PLAN_INIT;
    draw_all(of.outlines, of.culling, of.heights);
    if (chance(2)) {
      auto* const depths = fresh<std::uint32_t>(2);
      depths[0] = index(), depths[1] = chance(2) ? BCH_ALL_DEPTHS : index(8);
      of.depths = depths, of.depth_count = 1 + bytes.below(2);
    }
    of.threshold = chance(16) ? number<float>() : 0.25f;
  }
  void draw(bch_obstacle_arrays& of) {
    draw_all(of.x, of.y, of.polyline_offsets, of.polyline_count);
    if (chance(4)) draw_all(of.obstacle_offsets, of.obstacle_count);
    if (chance(2)) draw(of.is_area);
    if (chance(4)) draw_all(of.bottom, of.top);
  }
  void draw(bch_curve& of) {
    draw(of.times);
    auto* const values = fresh<float>(4 * most);  // no turn at all
    for (std::uint32_t i = 3; i < 4 * most; i += 4) values[i] = 1;
    values[bytes.below(4 * most)] = number<float>();
    of.values = values, of.tangents = chance(16) ? nullptr : fresh<float>(8 * most);
    of.count = chance(128) ? count() : bytes.below(3);
    of.interpolation = static_cast<std::int32_t>(index());
  }
  void draw(bch_channel& of) { draw_all(of.joint, of.positions, of.rotations, of.scales); }
  void draw(bch_clip& of) {
    draw_all(of.name, of.channels);
    of.seconds = chance(16) ? number<float>() : 8;
    of.channel_count = chance(128) ? count() : bytes.below(2);
  }
  void draw(bch_character_arrays& of) {
    of = BCH_CHARACTER_ARRAYS_INIT;
    draw_all(of.vertices, of.vertex_count, of.triangles, of.triangle_count);
    if (chance(2)) {
      draw_all(of.parents, of.joint_count, of.bone_joints, of.bone_count);
      of.root_joint = static_cast<std::int32_t>(index()) - 1;
      if (chance(2)) draw_all(of.rests, of.inverse_binds);
      if (chance(2)) draw_all(of.influence_offsets, of.influences);
      if (chance(2)) draw(of.clips), of.clip_count = bytes.below(3);
    }
    if (chance(4)) draw(of.to_ground);
  }
  void draw(bch_animated_arrays& of) {
    auto* const parts = fresh<std::uint32_t>(2);  // keys and discs, of one chunk
    parts[0] = 2 + bytes.below(3), parts[1] = 1 + bytes.below(3);
    auto* const times = fresh<double>(room);
    for (std::uint32_t i = 0; i < most; ++i) times[i] = chance(64) ? number<double>() : i;
    of.key_counts = parts, of.disc_counts = parts + 1;
    of.times = times, of.chunk_count = chance(32) ? 0 : 1;
    draw_all(of.loops, of.discs, of.z);
  }
  void draw(bch_scene_agents& of) {
    draw_all(of.poses, of.count);
    if (chance(2)) draw(of.character);
    if (chance(2)) draw(of.depth);
  }
  void draw(bch_scene_requirements& of) {
    of = BCH_SCENE_REQUIREMENTS_INIT;
    draw_all(of.outlines, of.heights);
    if (chance(4)) draw(of.pose_step);
  }
  /// What the library tells of an object.
  template <class Info>
  void draw(Info&) {}

  /// A struct of a caller of this version mostly, or of the past, of the future, absurd, or one that cuts a member.
  template <class Struct>
  Struct* sized() {
    struct AnyVersion {
      Struct known;
      std::uint8_t later[64];
    };
    auto* const of = fresh<AnyVersion>();
    draw(of->known);
    of->known.size = sizeof of->known;
    if (!chance(32)) return &of->known;
    const std::uint32_t kind = bytes.below(5);
    if (kind == 0) of->known.size = 4 + bytes.below(sizeof of->known - 4);
    if (kind == 1) of->known.size = bytes.below(4);
    if (kind == 2) of->known.size = 4097 + bytes.take<std::uint8_t>();
    if (kind >= 3) of->known.size = static_cast<std::uint32_t>(sizeof of->known) + bytes.below(65);
    if (kind == 4) of->later[bytes.below(64)] = bytes.take<std::uint8_t>();
    return &of->known;
  }
  template <Versioned Struct>
  void draw(const Struct*& of) {
    of = chance(32) ? nullptr : sized<Struct>();
  }
  template <Versioned Struct>
  void draw(Struct*& of) {
    of = chance(128) ? nullptr : sized<Struct>();
  }

  /// Rows that are lent.
  template <class Rows>
  requires requires(Rows of) { of.offsets, of.rows; }
  void draw_rows(Rows*& rows) {
    Rows* const own = rows = fresh<Rows>();
    after([own](bool succeeded) {
      if (!succeeded) return require(own->offsets == nullptr, "nothing is written on an error");
      if (own->offsets == nullptr) return;
      for (std::size_t i = 0; i < own->rows; ++i)
        require(own->offsets[i] <= own->offsets[i + 1], "rows follow each other");
      std::vector<std::uint8_t> copy(own->offsets[own->rows] * sizeof *own->values);
      if (!copy.empty()) std::memcpy(copy.data(), own->values, copy.size());
    });
  }
  void draw(bch_index_rows*& rows) { draw_rows(rows); }
  void draw(bch_contact_rows*& rows) { draw_rows(rows); }
  void draw(bch_sphere_contact_rows*& rows) { draw_rows(rows); }

  template <class... Fields>
  void draw_all(Fields&... fields) {
    (draw(fields), ...);
  }
};

}  // namespace bch::fuzz
