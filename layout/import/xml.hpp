// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string_view>
#include <utility>
#include <vector>

// Private to the importer: elements of an XML text as they stand in it, so that parts of the text can be replaced.

namespace bch::detail::importing {

/// Represents an element. All views are of the text, entities and all.
struct XmlElement {
  std::string_view whole;  ///< from the start tag to the end tag
  std::string_view name, content;
  std::vector<std::pair<std::string_view, std::string_view>> attributes;
  std::vector<XmlElement> children;

  /// Returns the value of an attribute; an empty one where there is none.
  std::string_view attribute(std::string_view attribute_name) const;
  /// Returns the first child of that name, or nullptr.
  const XmlElement* child(std::string_view child_name) const;
};

/// Returns the root element of a text; one without a name where the text is not of elements that end.
XmlElement parse_xml(std::string_view text);

}  // namespace bch::detail::importing
