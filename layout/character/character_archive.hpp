// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <bch/characters.hpp>

namespace bch::detail {

/// Takes all that a CharacterFields comes across as bytes.
class ByteWriter {
 public:
  void bytes(const void* from, std::size_t size) { bytes_.append(static_cast<const char*>(from), size); }
  void resize(std::string&, std::size_t) {}
  template <class Element>
  Element& element(std::vector<Element>& list, std::size_t i) {
    return list[i];
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Gives what a ByteWriter took, from bytes that are not trusted: what is read takes no more than a small multiple of their memory.
/// Errors:  all throw std::invalid_argument where bytes are not as many as they say.
class ByteReader {
 public:
  explicit ByteReader(std::span<const char> bytes) : left_(bytes) {}

  void bytes(void* to, std::size_t size) {
    require(size <= left_.size());
    if (size > 0) std::memcpy(to, left_.data(), size);
    left_ = left_.subspan(size);
  }
  void resize(std::string& text, std::size_t size) {
    require(size <= left_.size());
    text.resize(size);
  }
  /// One after the other, so that a list grows only as far as there are bytes.
  template <class Element>
  Element& element(std::vector<Element>& list, std::size_t) {
    return list.emplace_back();
  }
  void end() const { require(left_.empty()); }

 private:
  std::span<const char> left_;

  static void require(bool holds) {
    if (!holds) throw std::invalid_argument("a character's bytes are not as many as they say");
  }
};

/// Passes a character, or numbers, texts and lists of these, to an archive or from one: says once, for both directions, what it holds.
template <class Archive>
class CharacterFields {
 public:
  explicit CharacterFields(Archive& archive) : archive_(archive) {}

  template <class... Parts>
  void all(Parts&... parts) {
    (one(parts), ...);
  }

 private:
  Archive& archive_;

  template <class Number>
  requires std::is_arithmetic_v<Number>
  void one(Number& number) { archive_.bytes(&number, sizeof number); }
  void one(std::string& text) {
    std::uint64_t size = text.size();
    one(size);
    archive_.resize(text, size);
    archive_.bytes(text.data(), size);
  }
  template <class Element>
  void one(std::vector<Element>& list) {
    std::uint64_t size = list.size();
    one(size);
    for (std::uint64_t i = 0; i < size; ++i) one(archive_.element(list, i));
  }
  template <std::size_t size>
  void one(std::array<std::uint32_t, size>& numbers) {
    for (std::uint32_t& number : numbers) one(number);
  }
  void one(Vec3& vector) { archive_.bytes(&vector, sizeof vector); }
  void one(Quaternion& rotation) { archive_.bytes(&rotation, sizeof rotation); }
  void one(Affine3& transform) { archive_.bytes(&transform, sizeof transform); }
  template <class Value>
  void one(Key<Value>& key) {
    all(key.time, key.value);
  }
  void one(Influence& influence) { all(influence.bone, influence.weight); }
  void one(Joint& joint) { all(joint.name, joint.parent, joint.rest); }
  void one(Bone& bone) { all(bone.joint, bone.inverse_bind); }
  void one(Interpolation& interpolation) { archive_.bytes(&interpolation, sizeof interpolation); }
  void one(Curve<Vec3>::Tangents& tangents) { all(tangents.in, tangents.out); }
  void one(Curve<Quaternion>::Tangents& tangents) { all(tangents.in, tangents.out); }
  template <class Value>
  void one(Curve<Value>& curve) {
    all(curve.interpolation, curve.tangents);
  }
  void one(Channel& channel) {
    all(channel.joint, channel.positions, channel.rotations, channel.scales, channel.position_curve,
        channel.rotation_curve, channel.scale_curve);
  }
  void one(Clip& clip) { all(clip.name, clip.seconds, clip.channels); }
  void one(Character& c) {
    all(c.name, c.joints, c.bones, c.vertices, c.influence_begin, c.influences, c.triangles, c.clips,
        c.to_ground, c.root_joint);
  }
};

}  // namespace bch::detail
