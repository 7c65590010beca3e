// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/json.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "layout/import/scene.hpp"

namespace bch::detail::importing {

JsonValue::JsonValue(const JsonValue& parent, const nlohmann::json* value, std::string place)
    : file_(parent.file_), value_(value), place_(std::move(place)) {}

JsonValue JsonValue::operator[](const char* member) const {
  const std::string place = place_.empty() ? member : place_ + "." + member;
  if (value_ == nullptr) return {*this, nullptr, place};
  if (!value_->is_object()) reject("is no object");
  const auto found = value_->find(member);
  return {*this, found == value_->end() ? nullptr : &*found, place};
}

JsonValue JsonValue::operator[](std::size_t index) const {
  const std::size_t elements = size();
  if (index >= elements) reject("has " + count(elements, "element") + ", none " + std::to_string(index));
  return {*this, &(*value_)[index], place_ + "[" + std::to_string(index) + "]"};
}

std::size_t JsonValue::size() const {
  if (value_ == nullptr) return 0;
  if (!value_->is_array()) reject("is no array");
  return value_->size();
}

std::size_t JsonValue::integer(std::size_t largest) const {
  if (value_ == nullptr) reject("is missing");
  // Some programs write whole numbers as 3.0.
  const double number = value_->is_number() ? value_->get<double>() : -1;
  if (!(number >= 0 && number <= static_cast<double>(largest) && number == std::floor(number)))
    reject("is no whole number from 0 to " + std::to_string(largest));
  return static_cast<std::size_t>(number);
}

std::size_t JsonValue::integer(std::size_t largest, std::size_t if_absent) const {
  return value_ == nullptr ? if_absent : integer(largest);
}

float JsonValue::number() const {
  if (value_ == nullptr || !value_->is_number()) reject("is no number");
  const double number = value_->get<double>();
  if (!(std::abs(number) <= static_cast<double>(std::numeric_limits<float>::max())))
    reject("is beyond what a float holds");
  return static_cast<float>(number);
}

bool JsonValue::as_bool() const {
  if (value_ == nullptr) return false;
  if (!value_->is_boolean()) reject("is neither true nor false");
  return value_->get<bool>();
}

std::string JsonValue::text() const {
  if (value_ == nullptr) return {};
  if (!value_->is_string()) reject("is no text");
  return value_->get<std::string>();
}

void JsonValue::reject(const std::string& reason) const {
  importing::reject(*file_, (place_.empty() ? "JSON" : place_) + " " + reason);
}

}  // namespace bch::detail::importing
