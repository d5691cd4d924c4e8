#include "calibrate/base/worker_pool.h"

#include <system_error>
#include <utility>

namespace pastefit {

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  for (auto& worker : workers_) worker.join();
}

std::shared_future<void> WorkerPool::submit(std::function<void()> work) {
  std::packaged_task<void()> task(std::move(work));
  auto done = task.get_future().share();
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= idle_ && workers_.size() < threads_) {
      try {
        workers_.emplace_back([this] { take_work(); });
      } catch (const std::system_error&) {
        // Existing threads process the work; without any, the caller does.
      }
    }
    if (!workers_.empty()) {
      waiting_.push_back(std::move(task));
      changed_.notify_one();
      return done;
    }
  }
  task();
  return done;
}

void WorkerPool::take_work() {
  std::unique_lock lock(mutex_);
  while (true) {
    ++idle_;
    changed_.wait(lock, [this] { return closing_ || !waiting_.empty(); });
    --idle_;
    if (closing_) return;
    auto task = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    task();
    lock.lock();
  }
}

}  // namespace pastefit
