// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/line_reader.hpp"

#include <cerrno>
#include <cstring>

namespace bch::detail::trajectory {
namespace {

constexpr std::size_t longest_line = std::size_t{1} << 16;
constexpr std::size_t buffer_size = std::size_t{1} << 18;

}  // namespace

LineReader::LineReader(const Places& places) : places_(places), file_(places.file, std::ios::binary) {
  if (!file_) places_.reject(std::string("cannot be opened: ") + std::strerror(errno));
  buffer_.resize(buffer_size);
}

void LineReader::rewind() {
  file_.clear();
  if (!file_.seekg(0)) places_.reject(std::string("cannot be read: ") + std::strerror(errno));
  begin_ = end_ = 0;
  number_ = 0;
  at_end_ = begun_ = has_nul_ = false;
}

void LineReader::fill() {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  file_.read(buffer_.data() + end_, static_cast<std::streamsize>(buffer_.size() - end_));
  if (file_.bad()) places_.reject(std::string("cannot be read: ") + std::strerror(errno));
  const auto got = static_cast<std::size_t>(file_.gcount());
  at_end_ = got == 0;
  has_nul_ = has_nul_ || std::memchr(buffer_.data() + end_, '\0', got) != nullptr;
  end_ += got;
}

void LineReader::begin_text() {
  begun_ = true;
  while (!at_end_ && end_ < 3) fill();
  const std::string_view start(buffer_.data(), end_);
  if (start.starts_with("\xff\xfe") || start.starts_with("\xfe\xff"))
    places_.reject(1, "is UTF-16, not UTF-8");
  if (start.starts_with("\xef\xbb\xbf")) begin_ = 3;
}

std::string_view LineReader::take(std::size_t length, std::size_t and_end) {
  std::string_view line(buffer_.data() + begin_, length);
  begin_ += length + and_end;
  has_end_ = and_end > 0;
  ++number_;
  if (line.size() > longest_line) places_.reject(number_, "is longer than 65536 bytes");
  if (has_nul_ && line.find('\0') != std::string_view::npos)
    places_.reject(number_, "has a NUL byte: is not text");
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

bool LineReader::next(std::string_view& line) {
  if (!begun_) begin_text();
  std::size_t searched = 0;
  for (;;) {
    const char* const from = buffer_.data() + begin_;
    const void* const end = std::memchr(from + searched, '\n', end_ - begin_ - searched);
    if (end != nullptr) {
      line = take(static_cast<std::size_t>(static_cast<const char*>(end) - from), 1);
      return true;
    }
    searched = end_ - begin_;
    if (at_end_ || searched > longest_line) break;
    fill();
  }
  if (searched == 0) return false;
  line = take(searched, 0);
  return true;
}

}  // namespace bch::detail::trajectory
