// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/row_sorter.hpp"

#include <algorithm>
#include <tuple>
#include <type_traits>
#include <utility>

namespace bch::detail::trajectory {
namespace {

static_assert(std::is_trivially_copyable_v<Row> && sizeof(Row) == 56);

bool before(const Row& a, const Row& b) {
  return std::tie(a.key, a.id, a.number) < std::tie(b.key, b.id, b.number);
}

/// Rows that all lie in memory.
class RowsInMemory final : public RowStream {
 public:
  explicit RowsInMemory(std::vector<Row> rows) : rows_(std::move(rows)) {}

  std::size_t read(std::span<Row> rows) override {
    const std::size_t count = std::min(rows.size(), rows_.size() - at_);
    std::copy_n(rows_.begin() + static_cast<std::ptrdiff_t>(at_), count, rows.begin());
    at_ += count;
    return count;
  }
  void rewind() override { at_ = 0; }

 private:
  std::vector<Row> rows_;
  std::size_t at_ = 0;
};

/// A sorted piece of a file, of which some rows are in memory.
struct Piece {
  std::uint64_t next = 0, end = 0;  ///< rows of the file that are not in memory yet
  std::vector<Row> rows;
  std::size_t at = 0;

  const Row& front() const { return rows[at]; }
};

/// Merges sorted pieces of a file.
class MergedPieces final : public RowStream {
 public:
  MergedPieces(std::unique_ptr<TemporaryFile> file, std::vector<std::uint64_t> ends, std::size_t memory_rows)
      : file_(std::move(file)),
        ends_(std::move(ends)),
        rows_a_piece_(std::max<std::size_t>(memory_rows / ends_.size(), 16)) {
    begin();
  }

  std::size_t read(std::span<Row> rows) override {
    std::size_t count = 0;
    for (; count < rows.size() && !heap_.empty(); ++count) {
      Piece& first = pieces_[heap_.front()];
      rows[count] = first.front();
      if (++first.at == first.rows.size() && !fill(first)) {
        heap_.front() = heap_.back();
        heap_.pop_back();
      }
      sift_down();
    }
    return count;
  }
  void rewind() override { begin(); }

 private:
  std::unique_ptr<TemporaryFile> file_;
  std::vector<std::uint64_t> ends_;
  std::size_t rows_a_piece_;
  std::vector<Piece> pieces_;
  std::vector<std::size_t> heap_;  ///< pieces with rows left, the one with the first row at the top

  void begin() {
    pieces_.resize(ends_.size());
    heap_.resize(ends_.size());
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      pieces_[i].next = i == 0 ? 0 : ends_[i - 1];
      pieces_[i].end = ends_[i];
      fill(pieces_[i]);
      heap_[i] = i;
    }
    std::sort(heap_.begin(), heap_.end(), [this](std::size_t a, std::size_t b) { return is_before(a, b); });
  }

  bool is_before(std::size_t a, std::size_t b) const {
    return before(pieces_[a].front(), pieces_[b].front());
  }

  /// Reads rows of a piece that has none left in memory.
  bool fill(Piece& piece) {
    piece.rows.resize(std::min<std::uint64_t>(rows_a_piece_, piece.end - piece.next));
    piece.at = 0;
    file_->read(piece.next, piece.rows);
    piece.next += piece.rows.size();
    return !piece.rows.empty();
  }

  /// Moves the top of the heap to its place.
  void sift_down() {
    for (std::size_t at = 0;;) {
      std::size_t below = 2 * at + 1;
      if (below >= heap_.size()) return;
      if (below + 1 < heap_.size() && is_before(heap_[below + 1], heap_[below])) ++below;
      if (!is_before(heap_[below], heap_[at])) return;
      std::swap(heap_[at], heap_[below]);
      at = below;
    }
  }
};

}  // namespace

RowSorter::RowSorter(std::size_t memory) : capacity_(std::max<std::size_t>(memory / sizeof(Row), 16)) {
  rows_.reserve(capacity_);
}

void RowSorter::add(std::span<const Row> rows) {
  while (!rows.empty()) {
    const std::size_t count = std::min(rows.size(), capacity_ - rows_.size());
    rows_.insert(rows_.end(), rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(count));
    rows = rows.subspan(count);
    if (rows_.size() == capacity_) write_piece();
  }
}

void RowSorter::write_piece() {
  if (!file_) file_ = std::make_unique<TemporaryFile>();
  std::sort(rows_.begin(), rows_.end(), before);
  file_->append(rows_);
  piece_ends_.push_back((piece_ends_.empty() ? 0 : piece_ends_.back()) + rows_.size());
  rows_.clear();
}

std::unique_ptr<RowStream> RowSorter::finish() && {
  if (!file_) {
    std::sort(rows_.begin(), rows_.end(), before);
    return std::make_unique<RowsInMemory>(std::move(rows_));
  }
  if (!rows_.empty()) write_piece();
  std::vector<Row>().swap(rows_);
  return std::make_unique<MergedPieces>(std::move(file_), std::move(piece_ends_), capacity_);
}

}  // namespace bch::detail::trajectory
