// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/xml.hpp"

#include <algorithm>

namespace bch::detail::importing {
namespace {

constexpr int deepest_element = 256;
constexpr std::string_view xml_blanks = " \t\r\n";

struct NoXml {};

class XmlReader {
 public:
  explicit XmlReader(std::string_view text) : text_(text) {}

  XmlElement read() {
    if (!next_tag()) throw NoXml();
    return element(0);
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;

  bool at(std::string_view word) const { return text_.substr(at_).starts_with(word); }

  void skip_past(std::string_view end) {
    at_ = text_.find(end, at_);
    if (at_ == text_.npos) throw NoXml();
    at_ += end.size();
  }

  std::string_view take_until(std::string_view ends) {
    const std::size_t begin = at_;
    at_ = text_.find_first_of(ends, at_);
    if (at_ == text_.npos) throw NoXml();
    return text_.substr(begin, at_ - begin);
  }

  void skip_blanks() { at_ = std::min(text_.find_first_not_of(xml_blanks, at_), text_.size()); }

  /// Goes to the next start or end tag, past comments and the like.
  bool next_tag() {
    while ((at_ = text_.find('<', at_)) != text_.npos) {
      if (at("<!--"))
        skip_past("-->");
      else if (at("<![CDATA["))
        skip_past("]]>");
      else if (at("<?"))
        skip_past("?>");
      else if (at("<!"))
        skip_past(">");
      else
        return true;
    }
    at_ = text_.size();
    return false;
  }

  /// Reads the element whose start tag is here.
  XmlElement element(int depth) {
    if (depth > deepest_element) throw NoXml();
    XmlElement result;
    const std::size_t begin = at_++;
    result.name = take_until(" \t\r\n/>");
    for (skip_blanks(); !at(">") && !at("/>"); skip_blanks()) {
      const std::string_view name = take_until(" \t\r\n=>");
      skip_past("=");
      skip_blanks();
      if (!at("\"") && !at("'")) throw NoXml();
      const std::string_view quote = text_.substr(at_++, 1);
      result.attributes.emplace_back(name, take_until(quote));
      ++at_;
    }
    const bool is_empty = at("/>");
    skip_past(">");
    const std::size_t content = at_;
    std::size_t end = at_;
    while (!is_empty) {
      if (!next_tag()) throw NoXml();
      end = at_;
      if (at("</")) {
        at_ += 2;
        if (take_until(" \t\r\n>") != result.name) throw NoXml();
        skip_past(">");
        break;
      }
      result.children.push_back(element(depth + 1));
    }
    result.content = text_.substr(content, end - content);
    result.whole = text_.substr(begin, at_ - begin);
    return result;
  }
};

}  // namespace

std::string_view XmlElement::attribute(std::string_view attribute_name) const {
  for (const auto& [known, value] : attributes)
    if (known == attribute_name) return value;
  return {};
}

const XmlElement* XmlElement::child(std::string_view child_name) const {
  for (const XmlElement& element : children)
    if (element.name == child_name) return &element;
  return nullptr;
}

XmlElement parse_xml(std::string_view text) {
  try {
    return XmlReader(text).read();
  } catch (const NoXml&) {
    return {};
  }
}

}  // namespace bch::detail::importing
