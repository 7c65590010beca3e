// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/page/check_page.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>
#include <string_view>

#include "kernel/recordings/page/embedding.hpp"
#include "layout/base/base64.hpp"
#include "layout/base/text.hpp"

namespace bch::detail {
namespace {

using Json = nlohmann::ordered_json;

/// Rounds to as many parts of one, so that JSON needs few digits.
double rounded_to(double parts, double value) {
  return std::round(value * parts) / parts;
}

/// Writes an id as a number, or as text where JavaScript has no such number.
Json json_id(std::int64_t id) {
  constexpr std::int64_t most = std::int64_t{1} << 53;
  return -most <= id && id <= most ? Json(id) : Json(std::to_string(id));
}

/// Of a pass it is 0.
float depth_of(const OverlapEvent& event) {
  return std::max(0.0f, event.depth);
}

/// Returns the numbers of the deepest events, in their order.
std::vector<std::size_t> listed(std::span<const OverlapEvent> events) {
  std::vector<std::size_t> order(events.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (order.size() <= CheckPage::max_events) return order;
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return depth_of(events[i]); });
  order.resize(CheckPage::max_events);
  std::ranges::sort(order);
  return order;
}

Json json_events(std::span<const OverlapEvent> events, double fps) {
  Json list = Json::array();
  for (const std::size_t i : listed(events)) {
    const OverlapEvent& event = events[i];
    Json row{json_id(event.first), event.is_wall ? Json() : json_id(event.second)};
    for (const double frame : {static_cast<double>(event.from), static_cast<double>(event.to), event.worst})
      row.push_back(rounded_to(1e6, frame / fps));
    for (const double metres : {static_cast<double>(depth_of(event)), event.x, event.y})
      row.push_back(rounded_to(1e4, metres));
    if (event.is_pass()) row.push_back(1);
    list.push_back(std::move(row));
  }
  return list;
}

Json json_facts(const PageResults& results, const PageFacts& facts) {
  Json list = Json::array();
  for (const auto* const some : {&results.facts, &facts.facts})
    for (const auto& fact : *some) list.push_back({printable_line(fact.first), printable_line(fact.second)});
  return list;
}

std::string wall_blocks(const PageFacts& facts, PagePoint corner) {
  std::vector<std::uint32_t> begin{0};
  std::vector<std::int32_t> points;
  for (const auto& wall : facts.walls) {
    for (const PagePoint point : wall)
      points.insert(points.end(), {rounded<std::int32_t>((point.x - corner.x) * 1000),
                                   rounded<std::int32_t>((point.y - corner.y) * 1000)});
    begin.push_back(static_cast<std::uint32_t>(points.size() / 2));
  }
  return number_block("walls-begin", begin) + number_block("walls", points);
}

/// Returns how a content security policy names a script or a style.
std::string policy_source(std::string_view hash) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hash.size(); i += 2)
    bytes += static_cast<char>(std::stoi(std::string(hash.substr(i, 2)), nullptr, 16));
  return "'sha256-" + to_base64(bytes) + "'";
}

/// Nothing is loaded, and no script runs but the page's own.
std::string policy() {
  return "default-src 'none'; img-src data:; script-src " + policy_source(check_page_script_hash()) +
         "; style-src " + policy_source(check_page_style_hash()) + "; base-uri 'none'; form-action 'none'";
}

std::string filled(std::string_view text,
                   std::span<const std::pair<std::string_view, std::string_view>> tags) {
  std::string html;
  for (;;) {
    const std::size_t begin = text.find("{{"), end = text.find("}}", begin);
    html += text.substr(0, begin);
    if (begin == std::string_view::npos) return html;
    const std::string_view name = text.substr(begin + 2, end - begin - 2);
    const auto tag = std::ranges::find(tags, name, &std::pair<std::string_view, std::string_view>::first);
    if (tag == tags.end()) throw std::logic_error("the page's template asks for " + std::string(name));
    html += tag->second;
    text.remove_prefix(end + 2);
  }
}

}  // namespace

CheckPage::CheckPage(PageFacts facts, PageShapeSource shapes, std::size_t max_bytes)
    : facts_(std::move(facts)), source_(std::move(shapes)), max_bytes_(max_bytes) {}

/// What does not become less by dropping frames.
std::string CheckPage::fixed_blocks() const {
  return shapes_.blocks() + series_.blocks() + wall_blocks(facts_, frames_.corner());
}

std::string CheckPage::meta_block(std::span<const OverlapEvent> events) const {
  Json ids = Json::array();
  for (const std::int64_t id : frames_.ids()) ids.push_back(json_id(id));
  return json_block("meta", {{"fps", facts_.fps},
                             {"step", frames_.step()},
                             {"frames", frames_.seen()},
                             {"corner", {frames_.corner().x, frames_.corner().y}},
                             {"facts", json_facts(results_, facts_)},
                             {"table", results_.table},
                             {"shapes", shapes_.names()},
                             {"ids", std::move(ids)},
                             {"allEvents", events.size()},
                             {"events", json_events(events, facts_.fps)}});
}

std::string CheckPage::html(std::string_view data) const {
  const std::string title = escaped(facts_.title), rules = policy();
  const std::pair<std::string_view, std::string_view> tags[] = {{"title", title},
                                                                {"policy", rules},
                                                                {"style", check_page_style()},
                                                                {"data", data},
                                                                {"script", check_page_script()}};
  return filled(check_page_template(), tags);
}

void CheckPage::add_frame(const CheckedFrame& frame) {
  const auto overlapping =
      std::ranges::count_if(frame.people, [](const CheckedPerson& p) { return p.overlaps || p.in_wall; });
  series_.add(frame.seconds, static_cast<std::uint32_t>(overlapping),
              static_cast<std::uint32_t>(frame.people.size()));
  if (!frames_.add(frame)) return;
  for (std::size_t i = shapes_.size(); i < frames_.shapes().size(); ++i)
    shapes_.add(source_(frames_.shapes()[i]));
  while (frames_.block_size() + shapes_.block_size() > max_bytes_ && frames_.halve()) {
  }
}

std::string CheckPage::finish(std::span<const OverlapEvent> events, PageResults results) && {
  results_ = std::move(results);
  const std::string fixed = fixed_blocks();
  std::string meta = meta_block(events);
  const std::size_t rest = fixed.size() + meta.size() + html("").size();
  while (rest + frames_.block_size() > max_bytes_ && frames_.halve()) {
  }
  meta = meta_block(events);  // tells the step
  return html(meta + frames_.blocks() + fixed);
}

}  // namespace bch::detail
