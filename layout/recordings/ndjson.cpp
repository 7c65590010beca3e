// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/ndjson.hpp"

#include <optional>
#include <string>
#include <string_view>

#include "layout/base/shortest.hpp"
#include "layout/recordings/fields.hpp"
#include "layout/recordings/json_cursor.hpp"
#include "layout/recordings/line_reader.hpp"
#include "layout/recordings/numbers.hpp"

namespace bch::detail::trajectory {
namespace {

class Ndjson final : public RowSource {
 public:
  Ndjson(const std::filesystem::path& file, const TrajectoryOptions& options)
      : places_{file, true}, lines_(places_), metres_(options.unit.value_or(1)) {}

  const Places& places() const override { return places_; }

  Recording recording() const override {
    Recording all;
    all.format = "TrajNet++ ndjson";
    all.clock = Clock::row_steps;
    all.rate = fps_;
    if (left_out_ > 0)
      all.assumptions.push_back("The first prediction of each scene counts: " + std::to_string(left_out_) +
                                " rows of others are left out.");
    return all;
  }

  std::size_t read(std::span<Row> rows) override {
    std::size_t count = 0;
    for (std::string_view line; count < rows.size() && lines_.next(line);)
      if (!trimmed(line).empty() && parse(line, rows[count])) ++count;
    return count;
  }

  void rewind() override {
    lines_.rewind();
    left_out_ = 0;
  }

 private:
  Places places_;
  LineReader lines_;
  double metres_;
  std::optional<double> fps_;
  std::uint64_t left_out_ = 0;

  [[noreturn]] void reject(const std::string& reason) const { places_.reject(lines_.number(), reason); }

  /// Returns whether the line is a row.
  bool parse(std::string_view line, Row& row) {
    JsonCursor json(line);
    std::string_view kind;
    if (!json.take('{') || !json.name(kind)) reject("is not an object of JSON: " + shown(line));
    if (kind != "track" && kind != "scene") reject(shown(kind) + " is neither a track nor a scene");
    row = Row();
    row.number = lines_.number();
    const bool is_row = kind == "track" ? track(json, line, row) : scene(json, line);
    if (!json.take('}') || !json.is_at_end()) reject("is not an object of JSON: " + shown(line));
    return is_row;
  }

  bool track(JsonCursor& json, std::string_view line, Row& row) {
    std::string_view frame, person, x, y, prediction;
    const bool whole = take_members(json, [&](std::string_view name, std::string_view value) {
      if (name == "f") frame = value;
      if (name == "p") person = value;
      if (name == "x") x = value;
      if (name == "y") y = value;
      if (name == "prediction_number" || name == "pred_number") prediction = value;
    });
    if (!whole) reject("is not an object of JSON: " + shown(line));
    row.key = integer("f", frame);
    if (row.key > largest_frame || row.key < -largest_frame)
      reject("f " + shown(frame) + " is not within +-1e15");
    row.id = integer("p", person);
    row.x = coordinate("x", x);
    row.y = coordinate("y", y);
    const bool is_other =
        !prediction.empty() && prediction != "null" && integer("prediction_number", prediction) != 0;
    left_out_ += is_other;
    return !is_other;
  }

  bool scene(JsonCursor& json, std::string_view line) {
    std::string_view fps;
    if (!take_members(json, [&](std::string_view name, std::string_view value) {
          if (name == "fps") fps = value;
        }))
      reject("is not an object of JSON: " + shown(line));
    if (fps.empty() || fps == "null") return false;
    const double rate = number("fps", fps);
    if (!(rate > 0 && rate <= largest_fps)) reject("fps " + shown(fps) + " is not above 0 and at most 10000");
    if (fps_ && *fps_ != rate)
      reject("fps " + shown(fps) + " differs from " + shortest(*fps_) + " of earlier scenes");
    fps_ = rate;
    return false;
  }

  double number(const char* name, std::string_view text) const {
    if (text.empty()) reject("has no " + shown(name));
    const std::optional<double> value = number_from(text);
    if (!value) reject(std::string(name) + " " + shown(text) + " is not a number");
    return *value;
  }

  std::int64_t integer(const char* name, std::string_view text) const {
    if (text.empty()) reject("has no " + shown(name));
    const std::optional<std::int64_t> value = whole_number_from(text);
    if (!value) reject(std::string(name) + " " + shown(text) + " is not a whole number");
    return *value;
  }

  double coordinate(const char* name, std::string_view text) const {
    const double metres = number(name, text) * metres_;
    if (!is_coordinate(metres))
      reject(std::string(name) + " " + shown(text) + " " + coordinate_fault(metres));
    return metres;
  }
};

}  // namespace

std::unique_ptr<RowSource> open_ndjson(const std::filesystem::path& file, const TrajectoryOptions& options) {
  return std::make_unique<Ndjson>(file, options);
}

}  // namespace bch::detail::trajectory
