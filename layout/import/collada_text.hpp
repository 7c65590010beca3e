// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "layout/import/text.hpp"
#include "layout/import/xml.hpp"

// Private to the importer: the text of a Collada file, parts of which are replaced.

namespace bch::detail::importing {

using XmlElements = std::vector<const XmlElement*>;

/// Returns an element and all below it that have a name, in the order of the text.
XmlElements all_of(const XmlElement& element, std::string_view name);

class ColladaText {
 public:
  /// Takes views, which must outlive this.
  ColladaText(const std::filesystem::path& path, std::string_view text);

  const XmlElement& root() const { return root_; }

  /// Returns the element of an id, or nullptr; likewise the one that "#id" names.
  const XmlElement* with_id(std::string_view id) const;
  const XmlElement* named_by(std::string_view url) const;
  /// Returns the element that an input of an element names, or nullptr.
  const XmlElement* source(const XmlElement& element, std::string_view semantic) const;
  static const XmlElement* input(const XmlElement& element, std::string_view semantic);

  /// Puts something else in the place of a part of the text; an empty part is where it begins.
  /// Returns: false if that part is replaced by something else already.
  bool replace(std::string_view part, const std::string& by);
  std::size_t replaced() const { return edits_.size(); }
  /// Returns the text with what has been replaced; an empty one where nothing has.
  std::string rewritten() const;

  [[noreturn]] void reject(const std::string& reason) const;

 private:
  const std::filesystem::path& path_;
  std::string_view text_;
  XmlElement root_;
  std::map<std::string_view, const XmlElement*> by_id_;
  std::map<std::size_t, std::pair<std::size_t, std::string>>
      edits_;  ///< by place: how many bytes, and what for them

  void index(const XmlElement& element);
};

/// Rewrites samplers whose curves are not made of lines.
void rewrite_curves(ColladaText& collada);
/// Rewrites names of joints that assimp takes for other nodes' names.
void rewrite_joints(ColladaText& collada);

}  // namespace bch::detail::importing
