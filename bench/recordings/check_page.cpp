// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/recordings/check_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>
#include <string_view>

#include "bench/base/printable.hpp"
#include "bench/base/text.hpp"
#include "bench/recordings/embedded.hpp"
#include "bench/recordings/embedding.hpp"
#include "bench/recordings/kept_frames.hpp"
#include "bench/recordings/overlap_series.hpp"
#include "bench/recordings/page_shapes.hpp"
#include "bench/recordings/rounded.hpp"

namespace bch::cli {
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

/// Returns the numbers of the deepest events, in their order.
std::vector<std::size_t> listed(std::span<const PageEvent> events) {
  std::vector<std::size_t> order(events.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (order.size() <= CheckPage::most_events) return order;
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return events[i].depth; });
  order.resize(CheckPage::most_events);
  std::ranges::sort(order);
  return order;
}

Json json_events(std::span<const PageEvent> events) {
  Json list = Json::array();
  for (const std::size_t i : listed(events)) {
    const PageEvent& event = events[i];
    Json row{json_id(event.first), event.is_wall ? Json() : json_id(event.second)};
    for (const double seconds : {event.from, event.to, event.worst}) row.push_back(rounded_to(1e6, seconds));
    for (const double metres : {static_cast<double>(event.depth), event.at.x, event.at.y})
      row.push_back(rounded_to(1e4, metres));
    list.push_back(std::move(row));
  }
  return list;
}

Json json_facts(const PageFacts& facts) {
  Json list = Json::array();
  for (const auto& fact : facts.facts)
    list.push_back({printable_line(fact.first), printable_line(fact.second)});
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
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i + 1 < hash.size(); i += 2)
    bytes.push_back(static_cast<std::byte>(std::stoi(std::string(hash.substr(i, 2)), nullptr, 16)));
  return "'sha256-" + base64(bytes) + "'";
}

/// Nothing is loaded, and no script runs but the page's own.
std::string policy() {
  return fmt::format(
      "default-src 'none'; img-src data:; script-src {}; style-src {}; base-uri 'none'; form-action 'none'",
      policy_source(check_page_script_hash()), policy_source(check_page_style_hash()));
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

struct CheckPage::State {
  PageFacts facts;
  PageShapeSource source;
  std::size_t most_bytes;
  KeptFrames frames;
  PageShapes shapes;
  OverlapSeries series;

  std::string fixed_blocks() const;
  std::string meta_block(std::span<const PageEvent> events);
  std::string html(std::string_view data) const;
};

/// What does not become less by dropping frames.
std::string CheckPage::State::fixed_blocks() const {
  return shapes.blocks() + series.blocks() + wall_blocks(facts, frames.corner());
}

std::string CheckPage::State::meta_block(std::span<const PageEvent> events) {
  Json ids = Json::array();
  for (const std::int64_t id : frames.ids()) ids.push_back(json_id(id));
  return json_block("meta", {{"fps", facts.fps},
                             {"step", frames.step()},
                             {"frames", frames.seen()},
                             {"corner", {frames.corner().x, frames.corner().y}},
                             {"facts", json_facts(facts)},
                             {"shapes", shapes.names()},
                             {"ids", std::move(ids)},
                             {"allEvents", events.size()},
                             {"events", json_events(events)}});
}

std::string CheckPage::State::html(std::string_view data) const {
  const std::string title = escaped(facts.title), rules = policy();
  const std::pair<std::string_view, std::string_view> tags[] = {{"title", title},
                                                                {"policy", rules},
                                                                {"style", check_page_style()},
                                                                {"data", data},
                                                                {"script", check_page_script()}};
  return filled(check_page_template(), tags);
}

CheckPage::CheckPage(PageFacts facts, PageShapeSource shapes, std::size_t most_bytes)
    : state_(new State{std::move(facts), std::move(shapes), most_bytes, {}, {}, {}}) {}
CheckPage::CheckPage(CheckPage&&) noexcept = default;
CheckPage& CheckPage::operator=(CheckPage&&) noexcept = default;
CheckPage::~CheckPage() = default;

void CheckPage::add_frame(const PageFrame& frame) {
  State& s = *state_;
  const auto overlapping =
      std::ranges::count_if(frame.people, [](const PagePerson& p) { return p.overlaps || p.in_wall; });
  s.series.add(frame.seconds, static_cast<std::uint32_t>(overlapping),
               static_cast<std::uint32_t>(frame.people.size()));
  if (!s.frames.add(frame)) return;
  for (std::size_t i = s.shapes.size(); i < s.frames.shapes().size(); ++i)
    s.shapes.add(s.source(s.frames.shapes()[i]));
  while (s.frames.block_size() + s.shapes.block_size() > s.most_bytes && s.frames.halve()) {
  }
}

std::uint64_t CheckPage::step() const {
  return state_->frames.step();
}

std::string CheckPage::finish(std::span<const PageEvent> events) && {
  State& s = *state_;
  const std::string fixed = s.fixed_blocks();
  std::string meta = s.meta_block(events);
  const std::size_t rest = fixed.size() + meta.size() + s.html("").size();
  while (rest + s.frames.block_size() > s.most_bytes && s.frames.halve()) {
  }
  meta = s.meta_block(events);  // tells the step
  return s.html(meta + s.frames.blocks() + fixed);
}

}  // namespace bch::cli
