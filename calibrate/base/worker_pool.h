#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

namespace pastefit {

/// Threads that take work in the order it is handed in. They start as work arrives, at most `threads` of them, and live
/// as long as the pool. Requirements: threads >= 1.
class WorkerPool {
 public:
  explicit WorkerPool(int threads) : threads_(static_cast<std::size_t>(threads)) {}
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  ~WorkerPool();  ///< waits for the work that has begun and drops the rest

  /// Ready when the work is done; holds what the work throws.
  std::shared_future<void> submit(std::function<void()> work);

 private:
  void take_work();

  const std::size_t threads_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::deque<std::packaged_task<void()>> waiting_;
  std::size_t idle_ = 0;
  bool closing_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace pastefit
