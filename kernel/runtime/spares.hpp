// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <memory>
#include <mutex>
#include <vector>

namespace bch::detail {

/// Lends objects to threads, and makes a new one only if all are on loan.
template <class T>
class Spares {
  struct Return {
    Spares* to = nullptr;
    void operator()(T* object) const noexcept { to->take_back(object); }
  };

 public:
  /// Gives the object back when destroyed; it must not outlive the Spares.
  using Loan = std::unique_ptr<T, Return>;

  /// Returns the object that came back last, or make() if all are on loan.
  template <class Make>
  Loan borrow(const Make& make) {
    {
      const std::lock_guard lock(mutex_);
      if (!here_.empty()) {
        Loan loan(here_.back().release(), {this});
        here_.pop_back();
        return loan;
      }
    }
    std::unique_ptr<T> made(new T(make()));
    const std::lock_guard lock(mutex_);
    here_.reserve(++count_);  // so that take_back() allocates nothing
    return Loan(made.release(), {this});
  }

  /// Makes objects until there are `count`, enough for as many threads. None may be on loan.
  template <class Make>
  void reserve(std::size_t count, const Make& make) {
    std::vector<Loan> loans;
    while (loans.size() < count) loans.push_back(borrow(make));
  }

 private:
  void take_back(T* object) noexcept {
    const std::lock_guard lock(mutex_);
    here_.emplace_back(object);
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> here_;
  std::size_t count_ = 0;
};

}  // namespace bch::detail
