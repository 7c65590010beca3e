// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/fbx_document.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "layout/base/number_class.hpp"
#include "layout/import/scene.hpp"

namespace bch::detail::importing {
namespace {

// Flags of keys.
constexpr std::uint32_t constant = 0x2, linear = 0x4, cubic = 0x8;
constexpr std::uint32_t of_next_key = 0x100;  // of constant ones
constexpr std::uint32_t own_slopes = 0x400;   // of cubic ones
constexpr std::uint32_t own_weight = 0x0100'0000, own_next_weight = 0x0200'0000;

constexpr double usual_weight = 1.0 / 3;

/// Evaluates the cubic Bezier curve from a key to the next.
double between(const FbxCurve::Key& a, const FbxCurve::Key& b, double time) {
  const double seconds = b.time - a.time;
  const double fraction = (time - a.time) / seconds;
  const auto bezier = [](double p0, double p1, double p2, double p3, double u) {
    const double v = 1 - u;
    return v * v * v * p0 + 3 * v * v * u * p1 + 3 * v * u * u * p2 + u * u * u * p3;
  };
  double u = fraction;
  if (a.weight != usual_weight || a.next_weight != usual_weight) {
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
      u = (low + high) / 2;
      (bezier(0, a.weight, 1 - a.next_weight, 1, u) < fraction ? low : high) = u;
    }
  }
  return bezier(a.value, a.value + a.weight * seconds * a.slope,
                b.value - a.next_weight * seconds * a.next_slope, b.value, u);
}

std::uint32_t bits_of(double flags) {
  constexpr double beyond = 4294967296;
  return std::abs(flags) < beyond ? static_cast<std::uint32_t>(static_cast<std::int64_t>(flags)) : linear;
}

double weight_from(std::uint32_t bits) {
  return static_cast<double>(static_cast<std::int16_t>(bits)) / 9999;
}

}  // namespace

double FbxCurve::at(double time, bool before) const {
  if (keys.empty()) return 0;
  const auto after = std::partition_point(
      keys.begin(), keys.end(), [&](const Key& key) { return before ? key.time < time : key.time <= time; });
  if (after == keys.begin()) return keys.front().value;
  if (after == keys.end()) return keys.back().value;
  const Key &a = *(after - 1), &b = *after;
  if ((a.flags & constant) != 0) return (a.flags & of_next_key) != 0 ? b.value : a.value;
  if ((a.flags & cubic) != 0 && (a.flags & own_slopes) != 0) return between(a, b, time);
  return a.value + (b.value - a.value) * ((time - a.time) / (b.time - a.time));
}

bool FbxCurve::lacks_slopes(double seconds) const {
  for (std::size_t k = 1; k < keys.size(); ++k)
    if (const Key& a = keys[k - 1], &b = keys[k]; b.time - a.time > seconds && a.value != b.value &&
                                                  (a.flags & (constant | cubic | own_slopes)) == cubic)
      return true;
  return false;
}

FbxDocument::FbxDocument(const std::filesystem::path& path) : file_(path) {
  const FbxRecord& root = file_.root();
  if (const FbxRecord* const objects = root.child("Objects"))
    for (const FbxRecord& object : objects->children)
      if (objects_.try_emplace(object.whole(0), &object).second) order_.push_back(object.whole(0));
  if (const FbxRecord* const connections = root.child("Connections"))
    for (const FbxRecord& link : connections->children) {
      if (link.name != "C") continue;
      links_below_[link.whole(2)].push_back(links_.size());
      links_above_[link.whole(1)].push_back(links_.size());
      links_.push_back({link.whole(1), link.whole(2), link.text(3)});
    }
  if (const FbxRecord* const definitions = root.child("Definitions"))
    for (const FbxRecord& type : definitions->children)
      if (const FbxRecord* const defaults = type.child("PropertyTemplate"))
        templates_.try_emplace(type.text(0), defaults);
}

const FbxRecord* FbxDocument::object(FbxId id) const {
  const auto found = objects_.find(id);
  return found == objects_.end() ? nullptr : found->second;
}

std::vector<FbxId> FbxDocument::all(std::string_view object_class, std::string_view sort) const {
  std::vector<FbxId> list;
  for (const FbxId id : order_)
    if (const FbxRecord& record = *object(id);
        record.name == object_class && (sort.empty() || record.text(2) == sort))
      list.push_back(id);
  return list;
}

std::vector<FbxId> FbxDocument::below(FbxId above, std::string_view object_class,
                                      std::string_view sort) const {
  std::vector<FbxId> list;
  const auto links = links_below_.find(above);
  if (links == links_below_.end()) return list;
  for (const std::size_t l : links->second) {
    const FbxRecord* const record = object(links_[l].below);
    if (record != nullptr && links_[l].property.empty() && record->name == object_class &&
        (sort.empty() || record->text(2) == sort))
      list.push_back(links_[l].below);
  }
  return list;
}

std::vector<std::pair<FbxId, std::string_view>> FbxDocument::bound_to(FbxId object) const {
  std::vector<std::pair<FbxId, std::string_view>> list;
  if (const auto links = links_below_.find(object); links != links_below_.end())
    for (const std::size_t l : links->second) list.emplace_back(links_[l].below, links_[l].property);
  return list;
}

std::vector<std::pair<FbxId, std::string_view>> FbxDocument::bindings_of(FbxId object) const {
  std::vector<std::pair<FbxId, std::string_view>> list;
  if (const auto links = links_above_.find(object); links != links_above_.end())
    for (const std::size_t l : links->second) list.emplace_back(links_[l].above, links_[l].property);
  return list;
}

std::vector<std::pair<FbxId, std::string_view>> FbxDocument::curves_of(FbxId node) const {
  std::vector<std::pair<FbxId, std::string_view>> list = bound_to(node);
  std::erase_if(list, [&](const auto& bound) {
    const FbxRecord* const record = object(bound.first);
    return record == nullptr || record->name != "AnimationCurve";
  });
  return list;
}

std::string FbxDocument::name_of(const FbxRecord& object) {
  const std::string_view text = object.text(1);
  // "Hips", two bytes and "Model" in binary files, "Model::Hips" in text.
  if (const std::size_t end = text.find(std::string_view("\0\1", 2)); end != std::string_view::npos)
    return std::string(text.substr(0, end));
  for (const std::string_view start : {"Model::", "AnimStack::", "SubDeformer::"})
    if (text.starts_with(start)) return std::string(text.substr(start.size()));
  return std::string(text);
}

std::optional<Eigen::Vector3d> FbxDocument::property(const FbxRecord& object, std::string_view name) const {
  const auto defaults = templates_.find(object.name);
  for (const FbxRecord* const holder : {&object, defaults == templates_.end() ? nullptr : defaults->second}) {
    const FbxRecord* const properties = holder == nullptr ? nullptr : holder->child("Properties70");
    if (properties == nullptr) continue;
    for (const FbxRecord& property : properties->children)
      if (property.text(0) == name && property.values.size() > 4)
        return Eigen::Vector3d(property.number(4), property.number(5), property.number(6));
  }
  return std::nullopt;
}

double FbxDocument::number(const FbxRecord& object, std::string_view name, double otherwise) const {
  const std::optional<Eigen::Vector3d> found = property(object, name);
  return found ? found->x() : otherwise;
}

FbxCurve read_curve(const FbxDocument& document, const FbxRecord& object) {
  const FbxFile& file = document.file();
  const std::vector<double> times = file.numbers(object, "KeyTime"),
                            values = file.numbers(object, "KeyValueFloat");
  const std::vector<double> flags = file.numbers(object, "KeyAttrFlags"),
                            counts = file.numbers(object, "KeyAttrRefCount"),
                            data = file.float_bits(object, "KeyAttrDataFloat");
  if (values.size() != times.size()) file.reject("an FBX curve has not as many times as values");
  FbxCurve curve;
  std::size_t attribute = 0;
  double left = counts.empty() ? 0 : counts[0];  // keys of that attribute
  for (std::size_t k = 0; k < times.size(); ++k) {
    while (left < 1 && attribute + 1 < counts.size()) left = counts[++attribute];
    --left;
    FbxCurve::Key key{times[k] / fbx_ticks_per_second, values[k], linear, 0, 0, usual_weight, usual_weight};
    if (attribute < flags.size()) key.flags = bits_of(flags[attribute]);
    if (data.size() >= 4 * attribute + 4) {
      key.slope = data[4 * attribute];
      key.next_slope = data[4 * attribute + 1];
      const auto weights = std::bit_cast<std::uint32_t>(static_cast<float>(data[4 * attribute + 2]));
      if ((key.flags & own_weight) != 0) key.weight = std::clamp(weight_from(weights), 0.0, 1.0);
      if ((key.flags & own_next_weight) != 0)
        key.next_weight = std::clamp(weight_from(weights >> 16), 0.0, 1.0);
    }
    if (!is_finite(key.time) || !is_finite(key.value))
      file.reject("an FBX curve has a key that is no number");
    if (k > 0 && !(key.time >= curve.keys.back().time))
      file.reject("an FBX curve has keys that are not in order of time");
    curve.keys.push_back(key);
  }
  return curve;
}

}  // namespace bch::detail::importing
