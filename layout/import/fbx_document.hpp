// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "layout/character/eigen.hpp"
#include "layout/import/fbx_record.hpp"

// Private to the importer: the objects of an FBX file, what connects them, and the curves that move them.

namespace bch::detail::importing {

using FbxId = std::int64_t;

constexpr double fbx_ticks_per_second = 46'186'158'000;

/// Holds the keys of one number over time.
struct FbxCurve {
  struct Key {
    double time;  ///< in seconds
    double value;
    std::uint32_t flags;         ///< how the value goes on to the next key
    double slope, next_slope;    ///< behind this key and before the next, per second, where the flags say so
    double weight, next_weight;  ///< the fraction of the time up to the next key that a tangent reaches
  };
  std::vector<Key> keys;

  /// Returns the value at a time, or just before it.
  double at(double time, bool before) const;
  /// Tells whether a value changes along a cubic curve whose slopes the file leaves to the reader, from a key to the next that is more
  /// than so many seconds away.
  bool lacks_slopes(double seconds) const;
};

/// Holds the objects of a file.
class FbxDocument {
 public:
  explicit FbxDocument(const std::filesystem::path& path);

  const FbxFile& file() const { return file_; }

  /// Returns the objects connected below another one (0: the scene), of one class and sort, in the order of the file.
  std::vector<FbxId> below(FbxId above, std::string_view object_class, std::string_view sort = {}) const;
  /// Returns all objects connected below one, each with the property to which it is bound, or without any.
  std::vector<std::pair<FbxId, std::string_view>> bound_to(FbxId object) const;
  /// Returns all objects that one is connected to, likewise.
  std::vector<std::pair<FbxId, std::string_view>> bindings_of(FbxId object) const;

  /// Returns the curves of a curve node, each with the number that it moves.
  std::vector<std::pair<FbxId, std::string_view>> curves_of(FbxId node) const;

  const FbxRecord* object(FbxId id) const;
  std::vector<FbxId> all(std::string_view object_class, std::string_view sort = {}) const;
  /// Returns the name of an object without its class.
  static std::string name_of(const FbxRecord& object);
  /// Returns up to three numbers of a property of an object, or of the template of its class; nothing where there is none.
  std::optional<Eigen::Vector3d> property(const FbxRecord& object, std::string_view name) const;
  /// Returns the first number of a property, or `otherwise`.
  double number(const FbxRecord& object, std::string_view name, double otherwise) const;

 private:
  struct Link {
    FbxId below, above;
    std::string_view property;
  };

  FbxFile file_;
  std::unordered_map<FbxId, const FbxRecord*> objects_;
  std::vector<FbxId> order_;
  std::vector<Link> links_;
  std::unordered_map<FbxId, std::vector<std::size_t>> links_below_, links_above_;
  std::map<std::string_view, const FbxRecord*> templates_;
};

/// Reads a curve.
FbxCurve read_curve(const FbxDocument& document, const FbxRecord& object);

}  // namespace bch::detail::importing
