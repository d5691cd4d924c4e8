#include "core/thread_pool.h"

#include <system_error>

#include "core/target.h"

namespace pastefit {

namespace {

constexpr int kPolls = 20000;  // polls before a thread sleeps: some tens of microseconds

/// Waits until `value` is no longer `old`.
template <class T>
void wait_for_change(const std::atomic<T>& value, T old) {
  for (int poll = 0; poll < kPolls; ++poll) {
    if (value.load(std::memory_order_acquire) != old) return;
    PASTEFIT_PAUSE();
  }
  value.wait(old, std::memory_order_acquire);
}

}  // namespace

ThreadPool::ThreadPool(int size) {
  try {
    for (int member = 1; member < size; ++member) helpers_.emplace_back([this, member] { help(member); });
  } catch (const std::system_error&) {
    // Continue with as many as the system allows: the bits are the same.
  }
}

ThreadPool::~ThreadPool() {
  over_ = true;
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

void ThreadPool::share() {
  next_.store(0, std::memory_order_relaxed);
  busy_.store(static_cast<int>(helpers_.size()), std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  take_tasks(0);
  for (int busy = busy_.load(std::memory_order_acquire); busy > 0; busy = busy_.load(std::memory_order_acquire))
    wait_for_change(busy_, busy);
}

void ThreadPool::help(int member) {
  for (std::uint32_t seen = 0;;) {
    wait_for_change(round_, seen);
    seen = round_.load(std::memory_order_acquire);
    if (over_) return;
    take_tasks(member);
    if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_.notify_one();
  }
}

void ThreadPool::take_tasks(int member) {
  for (int task; (task = next_.fetch_add(1, std::memory_order_relaxed)) < tasks_;) call_(work_, task, member);
}

}  // namespace pastefit
