#include "calibrate/cli/sign_of_life.h"

#include <cstdio>
#include <string>

#include "calibrate/base/format.h"
#include "calibrate/cli/standard_output.h"
#include "calibrate/cli/terminal.h"

namespace pastefit {

namespace {

constexpr std::chrono::seconds kPatience{2}, kPlain{10};
constexpr std::chrono::milliseconds kSign{500};
constexpr double kRate_s = 0.5;  // that a phase is looked at before its rate says anything

}  // namespace

SignOfLife::SignOfLife() : terminal_(is_terminal()), next_(start_ + kPatience) {}

SignOfLife::~SignOfLife() {
  if (shown_ && terminal_) std::fputs("\r\033[K", stderr);
}

std::string SignOfLife::time_left(const Snapshot& snapshot, Clock::time_point now) const {
  const double taken_s = std::chrono::duration<double>(now - phase_start_).count();
  const double simulated_s = snapshot.time_s - phase_start_s_;
  if (taken_s < kRate_s || simulated_s <= 0) return "";
  const double pace = taken_s / simulated_s;
  return " (" + range_of_time(pace * snapshot.left.least_s, pace * snapshot.left.most_s) + " left)";
}

void SignOfLife::show(const Snapshot& snapshot) {
  const auto now = Clock::now();
  // A test may come to a phase again, in a world whose time is an earlier one.
  if (snapshot.phase != phase_ || snapshot.time_s < last_s_) {
    phase_ = snapshot.phase;
    phase_start_ = now;
    phase_start_s_ = snapshot.time_s;
  }
  last_s_ = snapshot.time_s;
  if (now < next_ || is_quiet()) return;
  next_ = now + (terminal_ ? Clock::duration(kSign) : Clock::duration(kPlain));
  shown_ = true;
  const double gone_s = std::chrono::duration<double>(now - start_).count();
  const std::string line =
      fitted({phase_ + time_left(snapshot, now), format("%.4g s simulated", snapshot.time_s),
              format("step %lld", static_cast<long long>(snapshot.step)), format("%.0f s gone", gone_s)});
  std::fprintf(stderr, terminal_ ? "\r%s\033[K" : "%s\n", line.c_str());
}

}  // namespace pastefit
