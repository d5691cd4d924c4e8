#include "calibrate/cli/sign_of_life.h"

#include "calibrate/base/text.h"
#include "calibrate/cli/terminal.h"

namespace pastefit {

std::string SignOfLife::time_left(const Snapshot& snapshot) const {
  constexpr double enough_s = 0.5;  // that a phase is looked at before its rate says anything
  const double taken_s = line_.gone_s() - phase_start_wall_s_;
  const double simulated_s = snapshot.time_s - phase_start_s_;
  if (taken_s < enough_s || simulated_s <= 0) return "";
  const double pace = taken_s / simulated_s;
  return " (" + range_of_time(pace * snapshot.left.least_s, pace * snapshot.left.most_s) + " left)";
}

void SignOfLife::show(const Snapshot& snapshot) {
  // A test may come to a phase again, in a world whose time is an earlier one.
  if (snapshot.phase != phase_ || snapshot.time_s < last_s_) {
    phase_ = snapshot.phase;
    phase_start_wall_s_ = line_.gone_s();
    phase_start_s_ = snapshot.time_s;
  }
  last_s_ = snapshot.time_s;
  if (!line_.is_due()) return;
  line_.show(
      fitted({phase_ + time_left(snapshot), format("%.4g s simulated", snapshot.time_s),
              format("step %lld", static_cast<long long>(snapshot.step)), format("%.0f s gone", line_.gone_s())}));
}

}  // namespace pastefit
