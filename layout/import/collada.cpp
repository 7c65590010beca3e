// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/collada.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <vector>

#include "layout/base/decimal.hpp"
#include "layout/import/scene.hpp"
#include "layout/import/xml.hpp"

namespace bch::detail::importing {
namespace {

constexpr double near_keys = 0.1;  // seconds up to which nobody asks what is between keys, as they are baked
constexpr double samples_per_second = 60;
constexpr std::size_t most_samples = 1000;  // between two keys

/// How long before a jump the value is the old one: more than a float's step.
double ramp(double seconds) {
  return std::max(1e-5, std::abs(seconds) * 1e-6);
}

using Elements = std::vector<const XmlElement*>;

/// Adds all elements of a name, in the order of the text.
void collect(const XmlElement& element, std::string_view name, Elements& list) {
  if (element.name == name) list.push_back(&element);
  for (const XmlElement& child : element.children) collect(child, name, list);
}
Elements all_of(const XmlElement& element, std::string_view name) {
  Elements list;
  collect(element, name, list);
  return list;
}

std::vector<std::string_view> words_of(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  std::vector<std::string_view> words;
  std::size_t at = 0;
  while ((at = text.find_first_not_of(blanks, at)) != text.npos) {
    const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

std::string digits(double number) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", number);
  return text;
}

/// The keys of a sampler, of so many numbers each.
struct Keys {
  std::vector<double> times, values, in_tangents, out_tangents;
  std::vector<std::string_view> kinds;
  std::size_t stride = 1;

  bool is_equal(std::size_t key) const {
    const auto value = values.begin() + static_cast<std::ptrdiff_t>(key * stride);
    return std::equal(value, value + static_cast<std::ptrdiff_t>(stride),
                      value + static_cast<std::ptrdiff_t>(stride));
  }
};

class ColladaRewriter {
 public:
  ColladaRewriter(const std::filesystem::path& path, std::string_view text)
      : path_(path), text_(text), root_(parse_xml(text)) {
    if (root_.name.empty()) importing::reject(path_, "is no XML whose elements end");
    index(root_);
  }

  std::string result() {
    for (const XmlElement* const animations : all_of(root_, "library_animations"))
      for (const XmlElement* const sampler : all_of(*animations, "sampler")) rewrite(*sampler);
    list_nodes();
    for (const XmlElement* const controller : all_of(root_, "controller")) rewrite_joints(*controller);
    if (edits_.empty()) return {};
    std::string rewritten;
    std::size_t done = 0;
    for (const auto& [begin, edit] : edits_) {
      rewritten.append(text_.substr(done, begin - done)).append(edit.second);
      done = begin + edit.first;
    }
    return rewritten.append(text_.substr(done));
  }

 private:
  const std::filesystem::path& path_;
  std::string_view text_;
  XmlElement root_;
  std::map<std::string_view, const XmlElement*> by_id_;
  std::map<std::size_t, std::pair<std::size_t, std::string>>
      edits_;  ///< by place: how many bytes, and what for them
  const XmlElement* scene_ = nullptr;
  Elements nodes_;  ///< of the scene, parents first

  [[noreturn]] void reject(const std::string& reason) const { importing::reject(path_, reason); }

  void index(const XmlElement& element) {
    if (const std::string_view id = element.attribute("id"); !id.empty()) by_id_.try_emplace(id, &element);
    for (const XmlElement& child : element.children) index(child);
  }

  void replace(std::string_view part, std::string by) {
    edits_[static_cast<std::size_t>(part.data() - text_.data())] = {part.size(), std::move(by)};
  }

  /// Returns the element that a "#id" names, or nullptr.
  const XmlElement* named_by(std::string_view url) const {
    if (!url.starts_with('#')) return nullptr;
    const auto found = by_id_.find(url.substr(1));
    return found == by_id_.end() ? nullptr : found->second;
  }

  static const XmlElement* input(const XmlElement& element, std::string_view semantic) {
    for (const XmlElement& child : element.children)
      if (child.name == "input" && child.attribute("semantic") == semantic) return &child;
    return nullptr;
  }

  const XmlElement* source(const XmlElement& sampler, std::string_view semantic) const {
    const XmlElement* const in = input(sampler, semantic);
    return in == nullptr ? nullptr : named_by(in->attribute("source"));
  }

  std::vector<double> numbers(const XmlElement* source) const {
    std::vector<double> list;
    const XmlElement* const array = source == nullptr ? nullptr : source->child("float_array");
    if (array == nullptr) return list;
    for (const std::string_view word : words_of(array->content)) {
      double number = 0;
      double_from_chars(word.data(), word.data() + word.size(), number);
      list.push_back(number);
    }
    return list;
  }

  /// Rewrites a sampler whose curve is not made of lines.
  void rewrite(const XmlElement& sampler) {
    Keys keys;
    if (const XmlElement* const kinds = source(sampler, "INTERPOLATION"))
      if (const XmlElement* const names = kinds->child("Name_array")) keys.kinds = words_of(names->content);
    const auto is_line = [](std::string_view kind) { return kind == "LINEAR"; };
    if (std::all_of(keys.kinds.begin(), keys.kinds.end(), is_line)) return;
    const XmlElement* const values = source(sampler, "OUTPUT");
    keys.times = numbers(source(sampler, "INPUT"));
    keys.values = numbers(values);
    keys.in_tangents = numbers(source(sampler, "IN_TANGENT"));
    keys.out_tangents = numbers(source(sampler, "OUT_TANGENT"));
    const std::string name(sampler.attribute("id"));
    if (keys.times.empty() || keys.values.empty() || keys.values.size() % keys.times.size() != 0) return;
    keys.stride = keys.values.size() / keys.times.size();
    keys.kinds.resize(keys.times.size(), "LINEAR");

    Keys lines;
    bool changes = false;
    for (std::size_t k = 0; k < keys.times.size(); ++k) {
      if (k > 0) changes = add_between(keys, k - 1, name, lines) || changes;
      add(lines, keys.times[k], keys, k);
    }
    if (changes) write(sampler, name, *values, keys.stride, lines);
  }

  static void add(Keys& lines, double time, const Keys& keys, std::size_t key) {
    lines.times.push_back(time);
    const auto value = keys.values.begin() + static_cast<std::ptrdiff_t>(key * keys.stride);
    lines.values.insert(lines.values.end(), value, value + static_cast<std::ptrdiff_t>(keys.stride));
  }

  /// Adds what a line from a key to the next one lacks.
  bool add_between(const Keys& keys, std::size_t key, const std::string& name, Keys& lines) const {
    const std::string_view kind = keys.kinds[key];
    const double from = keys.times[key], to = keys.times[key + 1], jump = to - ramp(to);
    if (kind == "LINEAR" || (keys.is_equal(key) && kind != "BEZIER")) return false;
    if (kind == "STEP") {
      if (jump > from) add(lines, jump, keys, key);
      return true;
    }
    if (to - from <= near_keys) return false;
    const std::string what = "Collada animation '" + name + "' has keys of kind " + std::string(kind);
    if (kind != "BEZIER") reject(what + ", which is not read");
    if (keys.stride == 1) return add_curve(keys, key, what, lines);
    if (!keys.is_equal(key))
      reject(what + " of " + count(keys.stride, "number") + ", which is not read (of one number it is)");
    return false;
  }

  bool add_curve(const Keys& keys, std::size_t key, const std::string& what, Keys& lines) const {
    const std::size_t size = keys.times.size();
    const double from = keys.times[key], to = keys.times[key + 1];
    // A tangent's end is a time and a value, or a value a third of the time away.
    double times[4] = {from, from + (to - from) / 3, to - (to - from) / 3, to};
    double values[4] = {keys.values[key], 0, 0, keys.values[key + 1]};
    for (const bool in : {false, true}) {
      const std::vector<double>& tangents = in ? keys.in_tangents : keys.out_tangents;
      const std::size_t k = in ? key + 1 : key, point = in ? 2 : 1;
      if (tangents.size() != size && tangents.size() != 2 * size)
        reject(what + " with " + count(tangents.size(), "number") + " for the tangents of " +
               count(size, "key"));
      const bool has_times = tangents.size() == 2 * size;
      if (has_times) times[point] = std::clamp(tangents[2 * k], from, to);
      values[point] = has_times ? tangents[2 * k + 1] : tangents[k];
    }
    const auto bezier = [](const double* p, double u) {
      const double v = 1 - u;
      return v * v * v * p[0] + 3 * v * v * u * p[1] + 3 * v * u * u * p[2] + u * u * u * p[3];
    };
    const auto samples = static_cast<std::size_t>(
        std::clamp((to - from) * samples_per_second, 1.0, static_cast<double>(most_samples)));
    for (std::size_t s = 1; s < samples; ++s) {
      const double u = static_cast<double>(s) / static_cast<double>(samples);
      lines.times.push_back(bezier(times, u));
      lines.values.push_back(bezier(values, u));
    }
    return true;
  }

  static std::string source_text(const std::string& id, const std::vector<double>& numbers,
                                 std::size_t stride, std::string_view params) {
    std::string list;
    for (const double number : numbers) list += digits(number) + " ";
    return "<source id=\"" + id + "\"><float_array id=\"" + id + "-array\" count=\"" +
           std::to_string(numbers.size()) + "\">" + list +
           "</float_array><technique_common><accessor source=\"#" + id + "-array\" count=\"" +
           std::to_string(numbers.size() / stride) + "\" stride=\"" + std::to_string(stride) + "\">" +
           std::string(params) + "</accessor></technique_common></source>";
  }

  /// Gives a sampler sources of its own, as others may share the file's.
  void write(const XmlElement& sampler, const std::string& name, const XmlElement& values, std::size_t stride,
             const Keys& lines) {
    const std::string id = "bch-" + std::to_string(edits_.size()) + "-" + name;
    const XmlElement* const technique = values.child("technique_common");
    const XmlElement* const accessor = technique == nullptr ? nullptr : technique->child("accessor");
    if (accessor == nullptr) reject("Collada animation '" + name + "' has an output without an accessor");
    replace(sampler.whole.substr(0, 0),
            source_text(id + "-in", lines.times, 1, "<param name=\"TIME\" type=\"float\"/>") +
                source_text(id + "-out", lines.values, stride, accessor->content));
    replace(input(sampler, "INPUT")->attribute("source"), "#" + id + "-in");
    replace(input(sampler, "OUTPUT")->attribute("source"), "#" + id + "-out");
  }

  void list_nodes() {
    const Elements scenes = all_of(root_, "visual_scene");
    if (scenes.empty()) return;
    scene_ = scenes.front();
    for (const XmlElement* const instance : all_of(root_, "instance_visual_scene"))
      if (const XmlElement* const named = named_by(instance->attribute("url"))) scene_ = named;
    nodes_ = all_of(*scene_, "node");
  }

  /// Returns the node that assimp takes for a joint, or nullptr.
  const XmlElement* taken_for(std::string_view joint) const {
    for (const XmlElement* const node : nodes_)
      if (node->attribute("name") == joint || node->attribute("id") == joint) return node;
    for (const XmlElement* const node : nodes_)
      if (node->attribute("sid") == joint) return node;
    return nullptr;
  }

  /// Returns the nodes that a joint's name may mean: below the skeletons of those who use the skin, by sid; else joints by name.
  std::set<const XmlElement*> meant(std::string_view joint, const Elements& skeletons) const {
    std::set<const XmlElement*> found;
    for (const XmlElement* const skeleton : skeletons)
      for (const XmlElement* const node : all_of(*skeleton, "node"))
        if (node->attribute("sid") == joint) found.insert(node);
    if (!found.empty()) return found;
    for (const XmlElement* const node : nodes_)
      if (node->attribute("name") == joint && node->attribute("type") == "JOINT") found.insert(node);
    return found;
  }

  void rewrite_joints(const XmlElement& controller) {
    const XmlElement* const skin = controller.child("skin");
    const XmlElement* const joints = skin == nullptr ? nullptr : skin->child("joints");
    const XmlElement* const names = joints == nullptr ? nullptr : source(*joints, "JOINT");
    if (names == nullptr) return;
    const Elements skeletons = skeletons_of(controller.attribute("id"));
    if (const XmlElement* const array = names->child("Name_array"))
      for (const std::string_view joint : words_of(array->content))
        rewrite_joint(joint, meant(joint, skeletons));
    if (const XmlElement* const array = names->child("IDREF_array"))
      for (const std::string_view joint : words_of(array->content))
        if (const auto node = by_id_.find(joint); node != by_id_.end()) rewrite_joint(joint, {node->second});
  }

  Elements skeletons_of(std::string_view controller) const {
    Elements skeletons;
    for (const XmlElement* const node : nodes_)
      for (const XmlElement& instance : node->children) {
        if (instance.name != "instance_controller" || instance.attribute("url").substr(0, 1) != "#" ||
            instance.attribute("url").substr(1) != controller)
          continue;
        for (const XmlElement& skeleton : instance.children) {
          const std::vector<std::string_view> url = words_of(skeleton.content);
          if (skeleton.name != "skeleton" || url.size() != 1) continue;
          if (const XmlElement* const named = named_by(url.front())) skeletons.push_back(named);
        }
      }
    if (skeletons.empty() && scene_ != nullptr) skeletons.push_back(scene_);
    return skeletons;
  }

  void rewrite_joint(std::string_view joint, const std::set<const XmlElement*>& nodes) {
    if (nodes.empty()) return;  // which is left to assimp
    const std::string what = "Collada joint '" + std::string(joint) + "'";
    if (nodes.size() > 1) reject(what + " may be any of " + count(nodes.size(), "node"));
    const XmlElement* const node = *nodes.begin();
    if (taken_for(joint) == node) return;
    const std::string_view id = node->attribute("id");
    if (id.empty() || taken_for(id) != node) reject(what + " cannot be told from another node of its name");
    const auto other = edits_.find(static_cast<std::size_t>(joint.data() - text_.data()));
    if (other != edits_.end() && other->second.second != id)
      reject(what + " is of skins on different skeletons");
    replace(joint, std::string(id));
  }
};

}  // namespace

std::string rewritten_collada(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text(4096, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.find("<COLLADA") == text.npos) return {};
  stream.clear();
  text.append(std::istreambuf_iterator<char>(stream), {});
  return ColladaRewriter(file, text).result();
}

void restore_jumps(aiScene& scene) {
  for (unsigned a = 0; a < scene.mNumAnimations; ++a) {
    const aiAnimation& animation = *scene.mAnimations[a];
    const double ticks = animation.mTicksPerSecond > 0 ? animation.mTicksPerSecond : 25;
    const auto restore = [&](auto* keys, unsigned size) {
      for (unsigned k = 1; k < size; ++k)
        if (keys[k].mTime - keys[k - 1].mTime < 2 * ticks * ramp(keys[k].mTime / ticks))
          keys[k - 1].mTime = keys[k].mTime;
    };
    for (unsigned c = 0; c < animation.mNumChannels; ++c) {
      const aiNodeAnim& channel = *animation.mChannels[c];
      restore(channel.mPositionKeys, channel.mNumPositionKeys);
      restore(channel.mRotationKeys, channel.mNumRotationKeys);
      restore(channel.mScalingKeys, channel.mNumScalingKeys);
    }
  }
}

}  // namespace bch::detail::importing
