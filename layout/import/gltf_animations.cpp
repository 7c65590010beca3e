// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <map>

#include "layout/import/gltf_parts.hpp"
#include "layout/import/scene.hpp"

namespace bch::detail::importing {
namespace {

/// assimp's time unit. Times are multiplied as floats, as in its reader, so that clips keep their bits.
constexpr float ticks_per_second = 1000.0f;

Interpolation interpolation_of(const JsonValue& sampler) {
  const JsonValue name = sampler["interpolation"];
  if (!name || name.text() == "LINEAR") return Interpolation::linear;
  if (name.text() == "STEP") return Interpolation::step;
  if (name.text() == "CUBICSPLINE") return Interpolation::cubic;
  name.reject("is '" + name.text() + "', none of LINEAR, STEP and CUBICSPLINE");
}

void make(const float* xyz, aiVector3D& value) {
  value = vector_from(xyz);
}
void make(const float* xyzw, aiQuaternion& value) {
  value = quaternion_from(xyzw);
}

template <class AiKey>
void make_one_key(AiKey*& keys, unsigned& size, const decltype(AiKey::mValue)& value) {
  keys = new AiKey[1]{AiKey(0, value)};
  size = 1;
}

/// Reads one animation.
class AnimationReader {
 public:
  AnimationReader(GltfReader& reader, const JsonValue& json, aiAnimation& animation)
      : reader_(reader), json_(json), animation_(animation) {}

  void read() {
    animation_.mName = json_["name"].text().substr(0, longest_name);
    animation_.mTicksPerSecond = static_cast<double>(ticks_per_second);
    collect_samplers();
    if (samplers_.empty()) return;  // assimp does not free an array of no channels
    animation_.mChannels = new aiNodeAnim* [samplers_.size()] {};
    animation_.mNumChannels = static_cast<unsigned>(samplers_.size());
    std::size_t next = 0;
    for (const auto& [node, parts] : samplers_)
      read_channel(node, parts, *(animation_.mChannels[next++] = new aiNodeAnim));
  }

 private:
  using Parts = std::map<std::string, JsonValue>;  ///< samplers by path

  GltfReader& reader_;
  const JsonValue json_;
  aiAnimation& animation_;
  std::map<std::size_t, Parts> samplers_;  ///< by node

  void collect_samplers() {
    const JsonValue channels = json_["channels"], samplers = json_["samplers"];
    std::size_t ignored = 0;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const JsonValue target = channels[c]["target"], node = target["node"];
      const std::string path = target["path"].text();
      const bool known = path == "translation" || path == "rotation" || path == "scale" || path == "weights";
      if (!node || !known) {
        ++ignored;
        continue;
      }
      reader_.file.named_by(node, "nodes");
      const std::size_t index = node.integer(reader_.names.size());
      const JsonValue sampler = samplers[channels[c]["sampler"].integer(samplers.size())];
      if (path == "weights")
        check_morphs(index, sampler);
      else
        samplers_[index].insert_or_assign(path, sampler);
    }
    if (ignored > 0)
      reader_.result.notes.push_back(json_.place() + ": " + count(ignored, "channel") +
                                     " of no node, or of nothing that is read, " +
                                     (ignored == 1 ? "is ignored" : "are ignored"));
  }

  void check_morphs(std::size_t node, const JsonValue& sampler) {
    GltfFile& file = reader_.file;
    const JsonValue mesh = file.root()["nodes"][node]["mesh"];
    if (!mesh || !has_morphs(file.named_by(mesh, "meshes"))) return;
    last_at(file.floats(file.named_by(sampler["input"], "accessors"), "SCALAR"));
    const std::vector<float> weights = file.floats(file.named_by(sampler["output"], "accessors"), "SCALAR");
    if (std::any_of(weights.begin(), weights.end(), [](float weight) { return weight != 0; }))
      reader_.result.posed_morphs = json_.place() + " animates morph targets of node '" +
                                    reader_.names[node] + "', which are not read (only weights of 0 are)";
  }

  void last_at(const std::vector<float>& times) {
    if (!times.empty())
      animation_.mDuration =
          std::max(animation_.mDuration, static_cast<double>(times.back() * ticks_per_second));
  }

  template <class AiKey>
  void read_keys(const Parts& parts, const char* path, const char* type, AiKey*& keys, unsigned& size,
                 Interpolation& interpolation) {
    const auto part = parts.find(path);
    if (part == parts.end()) return;
    GltfFile& file = reader_.file;
    const JsonValue &sampler = part->second, output = sampler["output"];
    const std::vector<float> times = file.floats(file.named_by(sampler["input"], "accessors"), "SCALAR");
    const std::vector<float> values = file.floats(file.named_by(output, "accessors"), type);
    if (times.empty()) return;
    interpolation = interpolation_of(sampler);
    const std::size_t per_key = interpolation == Interpolation::cubic ? 3 : 1;
    const std::size_t components = std::is_same_v<AiKey, aiQuatKey> ? 4 : 3;
    if (values.size() < times.size() * per_key * components)
      output.reject("has " + count(values.size() / components, "value") + " for " +
                    count(times.size(), "key") + (per_key == 1 ? "" : ", not three times as many"));
    last_at(times);
    size = static_cast<unsigned>(times.size() * per_key);
    keys = new AiKey[size];
    for (std::size_t k = 0; k < size; ++k) {
      keys[k].mTime = static_cast<double>(times[k / per_key] * ticks_per_second);
      make(&values[k * components], keys[k].mValue);
    }
  }

  void read_channel(std::size_t node, const Parts& parts, aiNodeAnim& channel) {
    channel.mNodeName = reader_.names[node];
    ChannelInterpolation& how = reader_.result.interpolations[&channel];
    read_keys(parts, "translation", "VEC3", channel.mPositionKeys, channel.mNumPositionKeys, how.positions);
    read_keys(parts, "rotation", "VEC4", channel.mRotationKeys, channel.mNumRotationKeys, how.rotations);
    read_keys(parts, "scale", "VEC3", channel.mScalingKeys, channel.mNumScalingKeys, how.scales);
    keep_rest(node, channel);
  }

  /// Parts without keys get one, the node's own, rather than factors of the rest transform.
  void keep_rest(std::size_t node, aiNodeAnim& channel) {
    const JsonValue json = reader_.file.root()["nodes"][node];
    aiVector3D position, scale(1);
    aiQuaternion rotation;
    if (reader_.nodes[node] != nullptr)
      reader_.nodes[node]->mTransformation.Decompose(scale, rotation, position);
    if (json["translation"]) position = vector_from(numbers_of<3>(json["translation"]).data());
    if (json["rotation"]) rotation = quaternion_from(numbers_of<4>(json["rotation"]).data());
    if (json["scale"]) scale = vector_from(numbers_of<3>(json["scale"]).data());
    if (channel.mNumPositionKeys == 0)
      make_one_key(channel.mPositionKeys, channel.mNumPositionKeys, position);
    if (channel.mNumRotationKeys == 0)
      make_one_key(channel.mRotationKeys, channel.mNumRotationKeys, rotation);
    if (channel.mNumScalingKeys == 0) make_one_key(channel.mScalingKeys, channel.mNumScalingKeys, scale);
  }
};

}  // namespace

void read_gltf_animations(GltfReader& reader) {
  const JsonValue animations = reader.file.root()["animations"];
  aiScene& scene = *reader.result.scene;
  scene.mAnimations = new aiAnimation* [animations.size()] {};
  scene.mNumAnimations = static_cast<unsigned>(animations.size());
  for (std::size_t a = 0; a < animations.size(); ++a)
    AnimationReader(reader, animations[a], *(scene.mAnimations[a] = new aiAnimation)).read();
}

}  // namespace bch::detail::importing
