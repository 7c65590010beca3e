// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "layout/base/number_class.hpp"
#include "layout/import/fbx.hpp"
#include "layout/import/fbx_channel.hpp"
#include "layout/import/scene.hpp"

namespace bch::detail::importing {
namespace {

constexpr double key_rounding = 1e-4;  // assimp computes in float
constexpr double kept = 5e-4;          // what a blend between keys of assimp's may miss
constexpr double made_anew = 1e-4;     // and one between keys of our own
constexpr double baked = 0.1;          // seconds between keys up to which nobody asks what is between them
constexpr int max_halvings = 8;

constexpr std::string_view axes[] = {"d|X", "d|Y", "d|Z"};  // of what an object animates

using Evaluation = std::function<FbxTransform(double)>;

/// Corrects one clip.
class ClipCorrector {
 public:
  ClipCorrector(FbxScene& file, aiAnimation& animation, FbxId stack)
      : file_(file),
        animation_(animation),
        ticks_(animation.mTicksPerSecond > 0 ? animation.mTicksPerSecond : 25),
        place_("FBX clip '" + to_string(animation.mName) + "'") {
    for (const FbxId layer : file.document.below(stack, "AnimationLayer"))
      for (const FbxId node : file.document.below(layer, "AnimationCurveNode")) read_motion(node);
    set_range(*file.document.object(stack));
  }

  /// Returns the length of the clip in ticks.
  double duration() const { return (last_ - first_) * ticks_; }

  void correct() {
    std::map<std::string, std::vector<const FbxModel*>> moved;
    std::set<std::string> names;
    for (const FbxModel& model : file_.models) {
      names.insert(model.name);
      if (!FbxChain::motions_of(model, motions_).empty()) moved[model.name].push_back(&model);
    }
    std::vector<aiNodeAnim*> channels, dropped;
    for (unsigned c = 0; c < animation_.mNumChannels; ++c) {
      aiNodeAnim* const channel = animation_.mChannels[c];
      const std::string name = channel == nullptr ? "" : to_string(channel->mNodeName);
      // Chains of helper nodes are there only where assimp is told to make them.
      const bool drops = name.find("_$AssimpFbx$_") != std::string::npos ||
                         (moved.contains(name) && !keep(*channel, moved[name]));
      (drops ? dropped : channels).push_back(channel);
    }
    std::vector<std::unique_ptr<aiNodeAnim>> made;
    for (const FbxModel& model : file_.models)
      if (const auto left = moved.find(model.name);
          left != moved.end() && std::erase(left->second, &model) > 0)
        if (std::unique_ptr<aiNodeAnim> channel = channel_of(model)) made.push_back(std::move(channel));
    // Nothing throws from here on but where memory ends, so that every channel is owned once.
    // assimp deletes no list without members.
    const std::size_t count = channels.size() + made.size();
    aiNodeAnim** const all = count == 0 ? nullptr : new aiNodeAnim*[count];
    aiNodeAnim** end = std::copy(channels.begin(), channels.end(), all);
    for (std::unique_ptr<aiNodeAnim>& channel : made) *end++ = channel.release();
    for (aiNodeAnim* const channel : dropped) delete channel;
    delete[] animation_.mChannels;
    animation_.mChannels = all;
    animation_.mNumChannels = static_cast<unsigned>(end - all);
  }

 private:
  /// Where a value jumps, what comes just before a time differs from what is there.
  struct Sample {
    double seconds;
    FbxTransform before, pose;
  };

  FbxScene& file_;
  aiAnimation& animation_;
  double ticks_;  // per second
  std::string place_;
  std::map<FbxId, FbxCurve> curves_;
  FbxMotions motions_;
  double first_ = std::numeric_limits<double>::infinity(), last_ = -first_;  // of all keys; then of the clip

  void read_motion(FbxId node) {
    const FbxDocument& document = file_.document;
    for (const auto& [target, property] : document.bindings_of(node)) {
      const FbxPart part = part_named(property);
      if (part == fbx_parts || document.object(target) == nullptr) continue;
      FbxMotion motion;
      bool moves = false;
      for (const auto& [id, axis] : document.curves_of(node)) {
        const auto place = std::find(std::begin(axes), std::end(axes), axis);
        if (place == std::end(axes)) continue;
        const auto [curve, added] = curves_.try_emplace(id);
        if (added) curve->second = read_curve(document, *document.object(id));
        if (curve->second.keys.empty()) continue;
        moves = true;
        motion.curves[static_cast<std::size_t>(place - axes)] = &curve->second;
        if (part > lcl_scaling) continue;  // assimp does not know that these move
        first_ = std::min(first_, curve->second.keys.front().time);
        last_ = std::max(last_, curve->second.keys.back().time);
      }
      const auto model = file_.by_id.find(target);
      if (model == file_.by_id.end()) continue;
      std::string what(property);
      what += " of node '" + model->second->name + "'";
      if (moves && part >= geometric_translation)
        document.file().reject(place_ + " moves " + what + ", which is not read");
      motion.value = model->second->parts[part];
      for (int axis = 0; axis < 3; ++axis)
        motion.value[axis] = document.number(*document.object(node), axes[axis], motion.value[axis]);
      std::optional<FbxMotion>& known = motions_[model->second][part];
      const bool moved = known && std::any_of(known->curves.begin(), known->curves.end(),
                                              [](const FbxCurve* curve) { return curve != nullptr; });
      if (moves && moved)
        document.file().reject(place_ + " blends layers that move " + what + ", which is not read");
      if (moves || !known) known = motion;
    }
  }

  /// Sets the range of the clip as assimp does.
  void set_range(const FbxRecord& stack) {
    const double start = file_.document.number(stack, "LocalStart", 0),
                 stop = file_.document.number(stack, "LocalStop", 0);
    if (start != 0 || stop != 0) {
      first_ = start / fbx_ticks_per_second;
      last_ = stop / fbx_ticks_per_second;
    }
    if (!is_finite(first_)) first_ = 0;
    if (!(last_ >= first_)) last_ = first_;
  }

  FbxTransform at(const FbxModel& model, double seconds, bool before = false) const {
    return file_.chain.local(model, {&motions_, seconds, before});
  }

  std::vector<Sample> samples(const FbxModel& model) {
    std::set<double> times{first_, last_};
    for (const FbxMotion* const motion : FbxChain::motions_of(model, motions_))
      for (const FbxCurve* const curve : motion->curves) {
        if (curve == nullptr) continue;
        for (const FbxCurve::Key& key : curve->keys)
          if (key.time > first_ && key.time < last_) times.insert(key.time);
      }
    std::vector<Sample> list;
    list.reserve(times.size());
    for (const double time : times) list.push_back({time, at(model, time, true), at(model, time)});
    return list;
  }

  /// Tells whether what would be shown is what the file has.
  bool is_right(const FbxModel& model, const std::vector<Sample>& samples, const Evaluation& shown) const {
    for (std::size_t m = 0; m < samples.size(); ++m) {
      const Sample& here = samples[m];
      const Eigen::Affine3d map = shown(here.seconds).map;
      if (!agree(map, here.pose.map, key_rounding)) return false;
      if (m == 0) continue;
      const Sample& last = samples[m - 1];
      if (!agree(map, here.before.map, key_rounding) || !passes(model, last, here, shown)) return false;
    }
    return true;
  }

  /// Tells the same of the time between two keys, of which nobody asks if they are near each other.
  bool passes(const FbxModel& model, const Sample& from, const Sample& to, const Evaluation& shown) const {
    const double seconds = to.seconds - from.seconds;
    if (seconds > baked) return follows(model, from, to, shown, kept);
    return agree(shown(from.seconds + seconds / 2).map, blend(from.pose, to.before, 0.5).map, kept);
  }

  bool follows(const FbxModel& model, const Sample& from, const Sample& to, const Evaluation& shown,
               double tolerance) const {
    for (const double fraction : {0.25, 0.5, 0.75}) {
      const double time = from.seconds + fraction * (to.seconds - from.seconds);
      if (!agree(shown(time).map, at(model, time).map, tolerance)) return false;
    }
    return true;
  }

  /// Keeps a channel of assimp's for the first model of its name that moves like that.
  bool keep(aiNodeAnim& channel, std::vector<const FbxModel*>& models) {
    for (const FbxModel* const model : models) {
      const FbxTransform rest = file_.chain.local(*model, {});
      const Evaluation shown = [&](double seconds) {
        return shown_by(channel, (seconds - first_) * ticks_, rest);
      };
      if (!is_right(*model, samples(*model), shown)) continue;
      channel.mNodeName = file_.node_of.at(model)->mName;
      std::erase(models, model);
      return true;
    }
    return false;
  }

  /// Returns a channel that moves a model as the file has it; none if it rests.
  std::unique_ptr<aiNodeAnim> channel_of(const FbxModel& model) {
    const std::vector<Sample> list = samples(model);
    FbxTransform rest = file_.chain.local(model, {});
    if (is_right(model, list, [&](double) { return rest; })) return nullptr;
    ChannelMaker maker(file_.document.file(), place_ + ", node '" + model.name + "':");
    const auto add = [&](double seconds, const FbxTransform& pose) {
      maker.add((seconds - first_) * ticks_, pose);
    };
    add(list.front().seconds, list.front().pose);
    for (std::size_t m = 1; m < list.size(); ++m) {
      const Sample& here = list[m];
      if (here.seconds - list[m - 1].seconds > baked)
        add_between(model, list[m - 1], here, max_halvings, add);
      add(here.seconds, here.before);
      if (!agree(here.before.map, here.pose.map, 1e-9)) add(here.seconds, here.pose);
    }
    std::unique_ptr<aiNodeAnim> channel = maker.channel();
    channel->mNodeName = file_.node_of.at(&model)->mName;
    return channel;
  }

  template <class Add>
  void add_between(const FbxModel& model, const Sample& from, const Sample& to, int halvings,
                   const Add& add) const {
    const double seconds = to.seconds - from.seconds;
    const Evaluation shown = [&](double time) {
      return blend(from.pose, to.before, (time - from.seconds) / seconds);
    };
    if (halvings == 0 || follows(model, from, to, shown, made_anew)) return;
    const double middle = from.seconds + seconds / 2;
    const Sample between{middle, at(model, middle), at(model, middle)};
    add_between(model, from, between, halvings - 1, add);
    add(middle, between.pose);
    add_between(model, between, to, halvings - 1, add);
  }
};

/// Notes that a clip has curves whose shape this file does not tell.
void note_missing_slopes(FbxScene& file, FbxId stack, const std::string& clip) {
  const FbxDocument& document = file.document;
  for (const FbxId layer : document.below(stack, "AnimationLayer"))
    for (const FbxId node : document.below(layer, "AnimationCurveNode"))
      for (const auto& [id, axis] : document.curves_of(node))
        if (read_curve(document, *document.object(id)).lacks_slopes(baked)) {
          file.notes.push_back("clip '" + clip +
                               "': cubic keys without tangents of their own are blended linearly");
          return;
        }
}

}  // namespace

/// assimp leaves out clips that move nothing that it knows, and keeps the order of the others.
void correct_fbx_clips(FbxScene& file, aiScene& scene) {
  std::vector<aiAnimation*> animations;
  std::vector<std::unique_ptr<aiAnimation>> made;
  unsigned next = 0;
  for (const FbxId stack : file.document.all("AnimationStack")) {
    const std::string name = FbxDocument::name_of(*file.document.object(stack)).substr(0, 1023);
    aiAnimation* animation = next < scene.mNumAnimations ? scene.mAnimations[next] : nullptr;
    if (animation != nullptr && to_string(animation->mName) == name) {
      ++next;
    } else {
      animation = made.emplace_back(std::make_unique<aiAnimation>()).get();
      animation->mName.Set(name);
      animation->mTicksPerSecond = 1;
    }
    ClipCorrector corrector(file, *animation, stack);
    corrector.correct();
    if (!made.empty() && made.back().get() == animation) {
      if (animation->mNumChannels == 0) continue;
      animation->mDuration = corrector.duration();
    }
    note_missing_slopes(file, stack, name);
    animations.push_back(animation);
  }
  if (next < scene.mNumAnimations) file.document.file().reject("FBX clips are not those of the file");
  aiAnimation** const all = animations.empty() ? nullptr : new aiAnimation*[animations.size()];
  std::copy(animations.begin(), animations.end(), all);
  for (std::unique_ptr<aiAnimation>& animation : made)
    if (animation->mNumChannels > 0) static_cast<void>(animation.release());  // `all` owns it
  delete[] scene.mAnimations;
  scene.mAnimations = all;
  scene.mNumAnimations = static_cast<unsigned>(animations.size());
}

}  // namespace bch::detail::importing
