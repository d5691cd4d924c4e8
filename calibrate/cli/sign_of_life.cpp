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

}  // namespace

SignOfLife::SignOfLife() : terminal_(is_terminal()), next_(start_ + kPatience) {}

SignOfLife::~SignOfLife() {
  if (shown_ && terminal_) std::fputs("\r\033[K", stderr);
}

void SignOfLife::show(const Moment& moment) {
  const auto now = Clock::now();
  if (now < next_ || is_quiet()) return;
  next_ = now + (terminal_ ? Clock::duration(kSign) : Clock::duration(kPlain));
  shown_ = true;
  const double gone_s = std::chrono::duration<double>(now - start_).count();
  const std::string line =
      fitted({"pastefit: " + std::string(moment.phase), format("%.4g s simulated", moment.time_s),
              format("step %lld", static_cast<long long>(moment.step)), format("%.0f s gone", gone_s)});
  std::fprintf(stderr, terminal_ ? "\r%s\033[K" : "%s\n", line.c_str());
}

}  // namespace pastefit
