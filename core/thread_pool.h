#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace pastefit {

/// Threads that share the work of one simulation. They poll for a short time between two pieces of work, because a step
/// has several and lasts less than it takes to wake a sleeping thread.
///
/// Requirement on the work: tasks write to different places, and sums are combined in the order of the tasks, not of
/// the threads; then every size of the pool gives the same bits.
class ThreadPool {
 public:
  /// Starts this many members, or as many as the system allows.
  explicit ThreadPool(int size = 1);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int size() const { return static_cast<int>(helpers_.size()) + 1; }

  /// Calls `work(task, member)` once for every task 0 .. tasks-1 and returns when all are done. Any member (0 ..
  /// size-1) may do any task. `work` must not throw.
  template <class Work>
  void each(int tasks, const Work& work) {
    if (helpers_.empty() || tasks <= 1) {
      for (int task = 0; task < tasks; ++task) work(task, 0);
      return;
    }
    call_ = [](const void* self, int task, int member) { (*static_cast<const Work*>(self))(task, member); };
    work_ = &work;
    tasks_ = tasks;
    share();
  }

 private:
  void share();
  void help(int member);
  void take_tasks(int member);

  std::vector<std::thread> helpers_;
  void (*call_)(const void*, int, int) = nullptr;
  const void* work_ = nullptr;
  int tasks_ = 0;
  alignas(64) std::atomic<int> next_{0};
  alignas(64) std::atomic<std::uint32_t> round_{0};  ///< incremented with every piece of work
  alignas(64) std::atomic<int> busy_{0};             ///< helpers that have not finished this round
  bool over_ = false;
};

}  // namespace pastefit
