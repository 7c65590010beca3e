// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/csv_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <initializer_list>
#include <memory>
#include <string_view>

// The reader's own thread gains nothing here, and a program without threads may still fork.
#define CSV_IO_NO_THREAD
#include <libfccp/csv.h>

#include "bench/base/exit_codes.hpp"
#include "bench/base/number.hpp"
#include "layout/base/rounding.hpp"

namespace bch::cli {
namespace {

template <unsigned columns>
using Reader = io::CSVReader<columns, io::trim_chars<' ', '\t'>, io::double_quote_escape<',', '"'>,
                             io::throw_on_overflow, io::empty_line_comment>;

/// The bytes of a file for the reader, which takes a NUL byte for the end of a line and leaves out what follows.
class TextBytes : public io::ByteSourceBase {
 public:
  /// Errors of both: throw InputError naming the file, the reason, and the line of what is not text in UTF-8.
  explicit TextBytes(const std::string& file)
      : name_(file), file_(std::fopen(file.c_str(), "re"), std::fclose) {
    if (file_ == nullptr)
      throw InputError(fmt::format("{}: cannot be opened: {}", file, std::strerror(errno)));
  }

  int read(char* buffer, int size) override {
    const std::size_t got = std::fread(buffer, 1, static_cast<std::size_t>(size), file_.get());
    if (std::ferror(file_.get()) != 0)
      throw InputError(fmt::format("{}: cannot be read: {}", name_, std::strerror(errno)));
    check({buffer, got});
    return static_cast<int>(got);
  }

 private:
  std::string name_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  bool begun_ = false;
  std::size_t line_ = 1;  ///< of the next byte

  void check(std::string_view bytes) {
    if (!begun_ && (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")))
      reject("is UTF-16, not UTF-8");
    begun_ = true;
    const std::string_view text = bytes.substr(0, bytes.find('\0'));
    line_ += static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    if (text.size() < bytes.size()) reject("has a NUL byte; is it UTF-16, not UTF-8?");
  }

  [[noreturn]] void reject(const char* reason) const {
    throw InputError(fmt::format("{}:{}: {}", name_, line_, reason));
  }
};

/// The longest way of an agent: two agents' ways apart are within the limit of time_of_impact().
constexpr double largest_way = detail::rounding::largest_position / 2;

/// A place in a file, for messages.
struct Place {
  const std::string& file;
  unsigned line;

  [[noreturn]] void reject(const char* column, std::string_view value, const std::string& reason) const {
    throw InputError(fmt::format("{}:{}: {} '{}' {}", file, line, column, value, reason));
  }
};

double number_within(const Place& place, const char* column, std::string_view text, double limit) {
  const auto value = parse_number(text);
  if (!value) place.reject(column, text, "is not a number");
  if (!(*value >= -limit && *value <= limit))
    place.reject(column, text, fmt::format("is not within +-{:g}", limit));
  return *value;
}

std::uint32_t index_below(const Place& place, const char* column, std::string_view text,
                          std::uint32_t bound) {
  std::uint32_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::invalid_argument || stop != text.data() + text.size())
    place.reject(column, text, "is not a whole number");
  if (error != std::errc() || value >= bound)
    place.reject(column, text, fmt::format("is not one of 0 to {}", bound - 1));
  return value;
}

/// What is wrong with a header that has this column. A file whose lines end with CR alone has a CR in the name of its
/// last column.
std::string unknown_column(std::string_view name) {
  if (name.find('\r') != std::string_view::npos) return "ends lines with CR alone, not with LF or CR LF";
  return fmt::format("column '{}' is not known", name);
}

/// Runs a reader; what it finds wrong becomes an InputError in this program's words.
template <class Body>
void with_csv_errors(const std::string& file, const Body& body) {
  try {
    body();
  } catch (const io::error::header_missing&) {
    throw InputError(file + ": is empty");
  } catch (const io::error::missing_column_in_header& e) {
    throw InputError(fmt::format("{}:1: has no column '{}'", file, e.column_name));
  } catch (const io::error::extra_column_in_header& e) {
    throw InputError(fmt::format("{}:1: {}", file, unknown_column(e.column_name)));
  } catch (const io::error::duplicated_column_in_header& e) {
    throw InputError(fmt::format("{}:1: column '{}' is there twice", file, e.column_name));
  } catch (const io::error::too_few_columns& e) {
    throw InputError(fmt::format("{}:{}: has fewer values than the header has columns", file, e.file_line));
  } catch (const io::error::too_many_columns& e) {
    throw InputError(fmt::format("{}:{}: has more values than the header has columns", file, e.file_line));
  } catch (const io::error::escaped_string_not_closed& e) {
    throw InputError(fmt::format("{}:{}: a quote is not closed", file, e.file_line));
  } catch (const io::error::line_length_limit_exceeded& e) {
    throw InputError(fmt::format("{}:{}: the line is too long", file, e.file_line));
  }
}

void add_agent(const Place& place, AgentTable& table, const char* id, std::uint32_t shape, double x, double y,
               double heading) {
  if (*id == '\0') place.reject("id", id, "is empty");
  if (!table.index_of.emplace(id, static_cast<std::uint32_t>(table.id.size())).second)
    place.reject("id", id, "is there twice");
  table.id.emplace_back(id);
  table.shape.push_back(shape);
  table.x.push_back(x);
  table.y.push_back(y);
  table.heading.push_back(heading);
}

}  // namespace

AgentTable read_agents(const std::string& file, std::uint32_t shapes, std::uint32_t levels, bool moving) {
  AgentTable table;
  with_csv_errors(file, [&] {
    Reader<9> reader(file, std::make_unique<TextBytes>(file));
    reader.read_header(io::ignore_missing_column, "id", "shape", "x", "y", "heading", "z", "level", "dx",
                       "dy");
    const auto require_columns = [&](std::initializer_list<const char*> names) {
      for (const char* name : names)
        if (!reader.has_column(name)) throw InputError(fmt::format("{}:1: has no column '{}'", file, name));
    };
    require_columns({"id", "shape", "x", "y", "heading"});
    const bool has_z = reader.has_column("z");
    const bool has_level = reader.has_column("level");
    const bool has_way = moving || reader.has_column("dx") || reader.has_column("dy");
    if (has_way) require_columns({"dx", "dy"});
    char *id = nullptr, *shape = nullptr, *x = nullptr, *y = nullptr, *heading = nullptr, *z = nullptr,
         *level = nullptr, *dx = nullptr, *dy = nullptr;
    while (reader.read_row(id, shape, x, y, heading, z, level, dx, dy)) {
      const Place place{file, reader.get_file_line()};
      add_agent(place, table, id, index_below(place, "shape", shape, shapes),
                number_within(place, "x", x, detail::rounding::largest_position),
                number_within(place, "y", y, detail::rounding::largest_position),
                number_within(place, "heading", heading, detail::rounding::largest_heading));
      if (has_z) table.z.push_back(number_within(place, "z", z, detail::rounding::largest_position));
      if (has_level)
        table.level.push_back(static_cast<std::uint8_t>(index_below(place, "level", level, levels)));
      if (!has_way) continue;
      table.dx.push_back(number_within(place, "dx", dx, largest_way));
      table.dy.push_back(number_within(place, "dy", dy, largest_way));
    }
  });
  return table;
}

std::vector<Pair> read_pairs(const std::string& file, const AgentTable& agents) {
  std::vector<Pair> pairs;
  with_csv_errors(file, [&] {
    Reader<2> reader(file, std::make_unique<TextBytes>(file));
    reader.read_header(io::ignore_no_column, "first", "second");
    char *first = nullptr, *second = nullptr;
    while (reader.read_row(first, second)) {
      const Place place{file, reader.get_file_line()};
      const auto index = [&](const char* column, const char* id) {
        const auto found = agents.index_of.find(id);
        if (found == agents.index_of.end()) place.reject(column, id, "is not the id of an agent");
        return found->second;
      };
      const std::uint32_t a = index("first", first);
      pairs.push_back({a, index("second", second)});
    }
  });
  return pairs;
}

void guard_ids(AgentTable& table) {
  for (std::string& id : table.id) {
    if (std::string_view("=+-@\t\r\n").find(id.front()) == std::string_view::npos) continue;
    const std::optional<double> number = parse_number(id);
    if (!number || !std::isfinite(*number)) id.insert(id.begin(), '\'');
  }
}

std::string csv_field(const std::string& text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  const bool trimmed = !text.empty() && (is_blank(text.front()) || is_blank(text.back()));
  if (!trimmed && text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace bch::cli
