// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "layout/import/collada.hpp"
#include "layout/import/collada_text.hpp"
#include "layout/import/scene.hpp"

namespace bch::detail::importing {
namespace {

constexpr double near_keys = 0.1;  // seconds up to which nobody asks what is between keys, as they are baked
constexpr double samples_per_second = 60;
constexpr std::size_t max_samples = 1000;  // between two keys

/// How long before a jump the value is the old one: more than a float's step.
double ramp(double seconds) {
  return std::max(1e-5, std::abs(seconds) * 1e-6);
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

  /// Returns whether nothing moves, whatever the kind: all keys are equal, and tangents, if there are any, are 0 or the keys' values.
  bool is_still() const {
    for (std::size_t key = 0; key + 1 < times.size(); ++key)
      if (!is_equal(key)) return false;
    const auto is_flat = [&](const std::vector<double>& tangents) {
      const bool has_times = tangents.size() == 2 * values.size();
      for (std::size_t i = has_times ? 1 : 0; i < tangents.size(); i += has_times ? 2 : 1)
        if (tangents[i] != 0 && tangents[i] != values[(has_times ? i / 2 : i) % values.size()]) return false;
      return true;
    };
    return is_flat(in_tangents) && is_flat(out_tangents);
  }
};

class CurveRewriter {
 public:
  explicit CurveRewriter(ColladaText& collada) : collada_(collada) {}

  /// Rewrites a sampler whose curve is not made of lines.
  void rewrite(const XmlElement& sampler) {
    Keys keys;
    if (const XmlElement* const kinds = collada_.source(sampler, "INTERPOLATION"))
      if (const XmlElement* const names = kinds->child("Name_array")) keys.kinds = words_of(names->content);
    const auto is_line = [](std::string_view kind) { return kind == "LINEAR"; };
    if (std::all_of(keys.kinds.begin(), keys.kinds.end(), is_line)) return;
    const XmlElement* const values = collada_.source(sampler, "OUTPUT");
    const std::string name(sampler.attribute("id"));
    keys.times = numbers(collada_.source(sampler, "INPUT"), name);
    keys.values = numbers(values, name);
    keys.in_tangents = numbers(collada_.source(sampler, "IN_TANGENT"), name);
    keys.out_tangents = numbers(collada_.source(sampler, "OUT_TANGENT"), name);
    if (keys.times.empty() || keys.values.empty()) return;
    if (keys.values.size() % keys.times.size() != 0)
      collada_.reject("Collada animation '" + name + "' has " + count(keys.values.size(), "number") +
                      " for " + count(keys.times.size(), "key"));
    keys.stride = keys.values.size() / keys.times.size();
    keys.kinds.resize(keys.times.size(), "LINEAR");

    Keys lines;
    const bool is_still = keys.is_still();
    bool changes = false;
    for (std::size_t k = 0; k < keys.times.size(); ++k) {
      if (k > 0) changes = add_between(keys, k - 1, is_still, name, lines) || changes;
      add(lines, keys.times[k], keys, k);
    }
    if (changes) write(sampler, name, *values, keys.stride, lines);
  }

 private:
  ColladaText& collada_;

  /// Returns all numbers of a source, which has to use them all.
  std::vector<double> numbers(const XmlElement* source, const std::string& name) const {
    std::vector<double> list;
    const XmlElement* const array = source == nullptr ? nullptr : source->child("float_array");
    if (array == nullptr) return list;
    const std::string what = "Collada animation '" + name + "' has ";
    for (const XmlElement* const accessor : all_of(*source, "accessor")) {
      const std::string_view offset = accessor->attribute("offset");
      const bool skips =
          std::any_of(accessor->children.begin(), accessor->children.end(), [&](const XmlElement& param) {
            return param.attribute("name").empty() && accessor->children.size() > 1;
          });
      if (skips || (!offset.empty() && offset != "0"))
        collada_.reject(what + "a source with an offset or with values that have no name, which is not read");
    }
    for (const std::string_view word : words_of(array->content)) {
      const std::optional<double> number = number_of(word);
      if (!number) collada_.reject(what + "'" + std::string(word) + "' for a number");
      list.push_back(*number);
    }
    return list;
  }

  static void add(Keys& lines, double time, const Keys& keys, std::size_t key) {
    lines.times.push_back(time);
    const auto value = keys.values.begin() + static_cast<std::ptrdiff_t>(key * keys.stride);
    lines.values.insert(lines.values.end(), value, value + static_cast<std::ptrdiff_t>(keys.stride));
  }

  /// Adds what a line from a key to the next one lacks.
  bool add_between(const Keys& keys, std::size_t key, bool is_still, const std::string& name,
                   Keys& lines) const {
    const std::string_view kind = keys.kinds[key];
    const double from = keys.times[key], to = keys.times[key + 1], jump = to - ramp(to);
    if (kind == "LINEAR" || (kind == "STEP" && keys.is_equal(key))) return false;
    if (kind == "STEP") {
      if (jump > from) add(lines, jump, keys, key);
      return true;
    }
    if (to - from <= near_keys || is_still) return false;
    const std::string what = "Collada animation '" + name + "' has keys of kind " + std::string(kind);
    if (kind != "BEZIER") collada_.reject(what + ", which is not read");
    if (keys.stride == 1) return add_curve(keys, key, what, lines);
    collada_.reject(what + " of " + count(keys.stride, "number") +
                    ", which is not read (of one number it is)");
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
        collada_.reject(what + " with " + count(tangents.size(), "number") + " for the tangents of " +
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
        std::clamp((to - from) * samples_per_second, 1.0, static_cast<double>(max_samples)));
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
    const std::string id = "bch-" + std::to_string(collada_.replaced()) + "-" + name;
    const XmlElement* const technique = values.child("technique_common");
    const XmlElement* const accessor = technique == nullptr ? nullptr : technique->child("accessor");
    if (accessor == nullptr)
      collada_.reject("Collada animation '" + name + "' has an output without an accessor");
    collada_.replace(sampler.whole.substr(0, 0),
                     source_text(id + "-in", lines.times, 1, "<param name=\"TIME\" type=\"float\"/>") +
                         source_text(id + "-out", lines.values, stride, accessor->content));
    collada_.replace(ColladaText::input(sampler, "INPUT")->attribute("source"), "#" + id + "-in");
    collada_.replace(ColladaText::input(sampler, "OUTPUT")->attribute("source"), "#" + id + "-out");
  }
};

}  // namespace

void rewrite_curves(ColladaText& collada) {
  CurveRewriter rewriter(collada);
  for (const XmlElement* const animations : all_of(collada.root(), "library_animations"))
    for (const XmlElement* const sampler : all_of(*animations, "sampler")) rewriter.rewrite(*sampler);
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
