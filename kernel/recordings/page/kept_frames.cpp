// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/page/kept_frames.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "kernel/recordings/page/embedding.hpp"
#include "layout/base/base64.hpp"

namespace bch::detail {
namespace {

std::int16_t kept_heading(float heading) {
  const double turns = std::remainder(static_cast<double>(heading) / (2 * std::numbers::pi), 1.0);
  // Half a turn either way is one heading.
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(rounded<std::int32_t>(turns * 65536)));
}

/// Writes one member of all as a block.
template <class Item, class Get>
auto column(const std::vector<Item>& items, Get get) {
  std::vector<decltype(get(items[0]))> values(items.size());
  std::transform(items.begin(), items.end(), values.begin(), get);
  return values;
}

/// Keeps every second of the ranges that `begin` bounds.
template <class Item>
void keep_every_second(std::vector<std::uint32_t>& begin, std::vector<Item>& items) {
  std::size_t ranges = 0;
  std::uint32_t out = 0;
  for (std::size_t i = 0; i + 1 < begin.size(); i += 2) {
    const std::uint32_t first = begin[i], last = begin[i + 1];
    std::copy(items.begin() + first, items.begin() + last, items.begin() + out);
    begin[ranges++] = out;
    out += last - first;
  }
  begin[ranges] = out;
  begin.resize(ranges + 1);
  items.resize(out);
}

void keep_every_second(std::vector<double>& items) {
  const std::size_t left = (items.size() + 1) / 2;
  for (std::size_t i = 0; i < left; ++i) items[i] = items[2 * i];
  items.resize(left);
}

}  // namespace

KeptFrames::Place KeptFrames::place_of(PagePoint at) {
  if (!has_origin_) origin_ = {std::round(at.x), std::round(at.y)};
  const Place place{rounded<std::int32_t>((at.x - origin_.x) * 1000),
                    rounded<std::int32_t>((at.y - origin_.y) * 1000)};
  if (!has_origin_) least_ = most_ = place;
  has_origin_ = true;
  least_ = {std::min(least_.x, place.x), std::min(least_.y, place.y)};
  most_ = {std::max(most_.x, place.x), std::max(most_.y, place.y)};
  return place;
}

KeptFrames::Person KeptFrames::kept(const CheckedPerson& person) {
  const Walker& walker = person.walker;
  return {ids_.number(walker.id),
          shapes_.number(person.pose),
          place_of({walker.x, walker.y}),
          kept_heading(static_cast<float>(walker.heading)),
          rounded<std::uint16_t>(static_cast<double>(static_cast<float>(walker.speed)) * 1000),
          static_cast<std::uint8_t>((person.overlaps ? 1 : 0) | (person.in_wall ? 2 : 0))};
}

bool KeptFrames::add(const CheckedFrame& frame) {
  if (seen_++ % step_ != 0) return false;
  numbers_.push_back(static_cast<double>(frame.frame));
  seconds_.push_back(frame.seconds);
  for (const CheckedPerson& person : frame.people) people_.push_back(kept(person));
  for (const CheckedPair& pair : frame.pairs)
    if (pair.overlap)
      overlaps_.push_back({ids_.number(pair.first), pair.is_wall ? wall_number : ids_.number(pair.second)});
  people_begin_.push_back(static_cast<std::uint32_t>(people_.size()));
  overlaps_begin_.push_back(static_cast<std::uint32_t>(overlaps_.size()));
  return true;
}

bool KeptFrames::halve() {
  if (size() < 2) return false;
  step_ *= 2;
  keep_every_second(numbers_);
  keep_every_second(seconds_);
  keep_every_second(people_begin_, people_);
  keep_every_second(overlaps_begin_, overlaps_);
  forget_unused_ids();
  return true;
}

void KeptFrames::forget_unused_ids() {
  const Numbering<std::int64_t> all = std::exchange(ids_, {});
  const auto renumbered = [&](std::uint32_t number) { return ids_.number(all.keys()[number]); };
  for (Person& person : people_) person.who = renumbered(person.who);
  for (Overlap& overlap : overlaps_) {
    overlap.first = renumbered(overlap.first);
    if (overlap.second != wall_number) overlap.second = renumbered(overlap.second);
  }
}

PagePoint KeptFrames::corner() const {
  return {origin_.x + least_.x / 1000.0, origin_.y + least_.y / 1000.0};
}

bool KeptFrames::narrow_places() const {
  constexpr std::int64_t most = 0xffff;
  return std::int64_t{most_.x} - least_.x <= most && std::int64_t{most_.y} - least_.y <= most;
}

std::size_t KeptFrames::block_size() const {
  const std::size_t id = narrow_ids() ? 2 : 4, shape = narrow_shapes() ? 2 : 4,
                    place = narrow_places() ? 4 : 8;
  constexpr std::size_t heading_speed_marks = 5, frame = 2 * sizeof(double) + 2 * sizeof(std::uint32_t);
  constexpr std::size_t tag = 100, tags = 12, id_digits = 8;
  return base64_size(people_.size() * (id + shape + place + heading_speed_marks) + overlaps_.size() * 2 * id +
                     size() * frame) +
         tags * tag + ids().size() * id_digits;
}

std::string KeptFrames::people_blocks() const {
  const auto from_least = [](std::int32_t value, std::int32_t least) {
    return static_cast<std::uint32_t>(std::int64_t{value} - least);
  };
  std::string out = index_block("who", column(people_, [](const Person& p) { return p.who; }), narrow_ids());
  out += index_block("shape", column(people_, [](const Person& p) { return p.shape; }), narrow_shapes());
  out += index_block("x", column(people_, [&](const Person& p) { return from_least(p.at.x, least_.x); }),
                     narrow_places());
  out += index_block("y", column(people_, [&](const Person& p) { return from_least(p.at.y, least_.y); }),
                     narrow_places());
  out += number_block("heading", column(people_, [](const Person& p) { return p.heading; }));
  out += number_block("speed", column(people_, [](const Person& p) { return p.speed; }));
  out += number_block("marks", column(people_, [](const Person& p) { return p.marks; }));
  return out;
}

std::string KeptFrames::blocks() const {
  std::vector<std::uint32_t> pairs;
  pairs.reserve(2 * overlaps_.size());
  for (const Overlap& overlap : overlaps_) pairs.insert(pairs.end(), {overlap.first, overlap.second});
  std::string out = number_block("frame", numbers_) + number_block("seconds", seconds_);
  out += number_block("people-begin", people_begin_) + people_blocks();
  out += number_block("overlaps-begin", overlaps_begin_) + index_block("overlaps", pairs, narrow_ids());
  return out;
}

void OverlapSeries::add(double seconds, std::uint32_t overlapping, std::uint32_t people) {
  if (!seconds_.empty() && in_last_ < length_) {
    ++in_last_;
    overlapping_.back() = std::max(overlapping_.back(), overlapping);
    people_.back() = std::max(people_.back(), people);
    return;
  }
  if (seconds_.size() == max_stretches) {
    for (std::size_t i = 0; i < max_stretches / 2; ++i) {
      seconds_[i] = seconds_[2 * i];
      overlapping_[i] = std::max(overlapping_[2 * i], overlapping_[2 * i + 1]);
      people_[i] = std::max(people_[2 * i], people_[2 * i + 1]);
    }
    for (auto* const column : {&overlapping_, &people_}) column->resize(max_stretches / 2);
    seconds_.resize(max_stretches / 2);
    length_ *= 2;
  }
  in_last_ = 1;
  seconds_.push_back(seconds);
  overlapping_.push_back(overlapping);
  people_.push_back(people);
}

std::string OverlapSeries::blocks() const {
  return number_block("series-seconds", seconds_) + number_block("series-overlapping", overlapping_) +
         number_block("series-people", people_);
}

}  // namespace bch::detail
