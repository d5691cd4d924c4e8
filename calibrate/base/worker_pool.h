#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

namespace pastefit {

/// Pool of threads that process work in order of submission. It starts at most `threads` threads, as work arrives, and
/// ends them on destruction. Requirement: threads >= 1.
class WorkerPool {
 public:
  explicit WorkerPool(int threads) : threads_(static_cast<std::size_t>(threads)) {}
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  ~WorkerPool();  ///< completes running work and drops the rest

  /// Ready when the work is done; holds its exception, if any.
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
