#pragma once

#include <chrono>

#include "core/step/run.h"

namespace pastefit {

/// Tells on standard error where a single simulation is, once it has taken two seconds: rewritten in place on a
/// terminal, else a line every ten seconds. How much is left it cannot say: a heap rests when it does.
class SignOfLife {
 public:
  SignOfLife();
  ~SignOfLife();
  SignOfLife(const SignOfLife&) = delete;
  SignOfLife& operator=(const SignOfLife&) = delete;

  void show(const Moment& moment);

 private:
  using Clock = std::chrono::steady_clock;
  const bool terminal_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point next_;
  bool shown_ = false;
};

}  // namespace pastefit
