// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#if defined(__unix__)
#include <pthread.h>
#endif

#include "kernel/runtime/executor_tasks.hpp"

namespace bch::detail {
namespace {

thread_local bool is_in_task = false;
thread_local std::uint32_t max_threads = 0;  ///< for the calls of this thread; 0: all

/// Holds one thread less than the processor runs: the other one is the caller's. They work for one call at a time; the caller of another
/// call meanwhile, or of one from a task, runs its tasks alone. A call does not wait for threads that wake up after its last task has
/// begun.
class ThreadPool {
 public:
  ThreadPool() {
    const std::uint32_t wanted = std::clamp(std::thread::hardware_concurrency(), 1u, 256u) - 1;
    for (std::uint32_t i = 0; i < wanted; ++i) workers_.emplace_back([this] { serve(); });
  }
  ~ThreadPool() {
    {
      const std::lock_guard lock(mutex_);
      ends_all_ = true;
    }
    begins_.notify_all();
    for (std::thread& worker : workers_) worker.join();
  }

  std::uint32_t threads() const { return static_cast<std::uint32_t>(workers_.size()) + 1; }

  void run(std::size_t count, void (*task)(void*, std::size_t), void* data) {
    std::unique_lock<std::mutex> alone;
    if (!is_in_task) alone = std::unique_lock(call_, std::try_to_lock);
    if (!alone) {
      for (std::size_t i = 0; i < count; ++i) task(data, i);
      return;
    }
    {
      const std::lock_guard lock(mutex_);
      task_ = task, data_ = data, count_ = count, next_ = 0, ++call_number_;
      places_ = max_threads == 0 ? workers_.size() : max_threads - 1;
    }
    begins_.notify_all();
    work();
    std::unique_lock lock(mutex_);
    places_ = 0;
    ends_.wait(lock, [&] { return busy_ == 0; });
  }

 private:
  void work() {
    is_in_task = true;
    for (std::size_t i; (i = next_.fetch_add(1, std::memory_order_relaxed)) < count_;) task_(data_, i);
    is_in_task = false;
  }

  void serve() {
    std::uint64_t served = 0;
    for (;;) {
      {
        std::unique_lock lock(mutex_);
        begins_.wait(lock, [&] { return ends_all_ || (places_ > 0 && call_number_ != served); });
        if (ends_all_) return;
        served = call_number_, --places_, ++busy_;
      }
      work();
      const std::lock_guard lock(mutex_);
      if (--busy_ == 0) ends_.notify_one();
    }
  }

  std::mutex call_, mutex_;
  std::condition_variable begins_, ends_;
  void (*task_)(void*, std::size_t) = nullptr;
  void* data_ = nullptr;
  std::size_t count_ = 0, busy_ = 0;
  std::size_t places_ = 0;  ///< of workers that may still join the call
  std::atomic<std::size_t> next_ = 0;
  std::uint64_t call_number_ = 0;
  bool ends_all_ = false;
  std::vector<std::thread> workers_;
};

/// Holds the pool of this process. A forked process has none of its parent's threads, and makes its own pool.
class PoolOfProcess {
 public:
  PoolOfProcess() {
#if defined(__unix__)
    pthread_atfork(nullptr, nullptr, [] {
      static_cast<void>(instance().pool_.release());  // whose threads and locks are the parent's
      new (&instance().mutex_) std::mutex;
      is_in_task = false;
    });
#endif
  }
  static PoolOfProcess& instance() {
#if defined(_WIN32)
    static PoolOfProcess& all = *new PoolOfProcess;  // whose threads Windows ends before it leaves a library
#else
    static PoolOfProcess all;
#endif
    return all;
  }
  ThreadPool& pool() {
    const std::lock_guard lock(mutex_);
    if (pool_ == nullptr) pool_ = std::make_unique<ThreadPool>();
    return *pool_;
  }

 private:
  std::mutex mutex_;
  std::unique_ptr<ThreadPool> pool_;
};

}  // namespace

void run_ranges_by_default(std::size_t count, std::size_t grain, const RangeWork& work) {
  ThreadPool& pool = PoolOfProcess::instance().pool();
  const Executor executor{[](void* of, std::size_t tasks, void (*task)(void*, std::size_t), void* data) {
                            static_cast<ThreadPool*>(of)->run(tasks, task, data);
                          },
                          &pool, pool.threads()};
  run_ranges_on(executor, count, grain, work);
}

void run_isolated_by_default(const RangeWork& work) {
  work(0, 0);
}

void run_on_threads_by_default(std::uint32_t threads, const RangeWork& work) {
  struct Restore {
    const std::uint32_t before = max_threads;
    ~Restore() { max_threads = before; }
  } const restore;
  max_threads = threads;
  work(0, 0);
}

std::uint32_t task_threads_by_default() {
  const std::uint32_t all = PoolOfProcess::instance().pool().threads();
  return max_threads == 0 ? all : std::min(all, max_threads);
}

}  // namespace bch::detail
