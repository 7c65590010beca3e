// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <memory>
#include <mutex>
#include <vector>

namespace bch::detail {

/// Lends objects to threads. There are as many as were on loan at one time, or as were reserved.
template <class T>
class Spares {
  struct Return {
    Spares* to = nullptr;
    void operator()(T* object) const noexcept { to->take_back(object); }
  };

 public:
  /// Returns the object when it is destroyed, which has to be before the Spares are.
  using Loan = std::unique_ptr<T, Return>;

  /// Returns the object that came back last, or what make() returns where all are on loan.
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
    here_.reserve(++count_);  // so that no memory is needed when it comes back
    return Loan(made.release(), {this});
  }

  /// Makes objects until there are `count`, so that no more are made for as many threads. None may be on loan.
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
