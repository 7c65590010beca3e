// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/collada.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "layout/import/collada_text.hpp"
#include "layout/import/files.hpp"
#include "layout/import/scene.hpp"

namespace bch::detail::importing {
namespace {

void collect(const XmlElement& element, std::string_view name, XmlElements& list) {
  if (element.name == name) list.push_back(&element);
  for (const XmlElement& child : element.children) collect(child, name, list);
}

}  // namespace

XmlElements all_of(const XmlElement& element, std::string_view name) {
  XmlElements list;
  collect(element, name, list);
  return list;
}

ColladaText::ColladaText(const std::filesystem::path& path, std::string_view text)
    : path_(path), text_(text), root_(parse_xml(text)) {
  if (root_.name.empty()) reject("is no XML whose elements end");
  index(root_);
}

void ColladaText::index(const XmlElement& element) {
  if (const std::string_view id = element.attribute("id"); !id.empty()) by_id_.try_emplace(id, &element);
  for (const XmlElement& child : element.children) index(child);
}

const XmlElement* ColladaText::with_id(std::string_view id) const {
  const auto found = by_id_.find(id);
  return found == by_id_.end() ? nullptr : found->second;
}

const XmlElement* ColladaText::named_by(std::string_view url) const {
  return url.starts_with('#') ? with_id(url.substr(1)) : nullptr;
}

const XmlElement* ColladaText::input(const XmlElement& element, std::string_view semantic) {
  for (const XmlElement& child : element.children)
    if (child.name == "input" && child.attribute("semantic") == semantic) return &child;
  return nullptr;
}

const XmlElement* ColladaText::source(const XmlElement& element, std::string_view semantic) const {
  const XmlElement* const in = input(element, semantic);
  return in == nullptr ? nullptr : named_by(in->attribute("source"));
}

bool ColladaText::replace(std::string_view part, const std::string& by) {
  const auto place = static_cast<std::size_t>(part.data() - text_.data());
  return edits_.try_emplace(place, part.size(), by).first->second.second == by;
}

std::string ColladaText::rewritten() const {
  if (edits_.empty()) return {};
  std::string result;
  std::size_t done = 0;
  for (const auto& [begin, edit] : edits_) {
    result.append(text_.substr(done, begin - done)).append(edit.second);
    done = begin + edit.first;
  }
  return result.append(text_.substr(done));
}

void ColladaText::reject(const std::string& reason) const {
  importing::reject(path_, reason);
}

std::string rewritten_collada(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  char start[64] = {};
  stream.read(start, sizeof start);
  std::string_view beginning(start, static_cast<std::size_t>(stream.gcount()));
  if (beginning.starts_with(byte_order_mark)) beginning.remove_prefix(byte_order_mark.size());
  if (!beginning.substr(std::min(beginning.find_first_not_of(" \t\r\n"), beginning.size())).starts_with('<'))
    return {};
  stream.clear();
  stream.seekg(0);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  if (text.find("<COLLADA") == text.npos) return {};
  ColladaText collada(file, text);
  rewrite_curves(collada);
  rewrite_joints(collada);
  return collada.rewritten();
}

}  // namespace bch::detail::importing
