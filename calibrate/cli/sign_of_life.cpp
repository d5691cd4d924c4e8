#include "calibrate/cli/sign_of_life.h"

#include <unistd.h>

#include <cstdio>
#include <string>

namespace pastefit {

namespace {

constexpr std::chrono::seconds kPatience{2}, kPlain{10};
constexpr std::chrono::milliseconds kRewrite{500};

}  // namespace

SignOfLife::SignOfLife() : terminal_(isatty(STDERR_FILENO) == 1), next_(start_ + kPatience) {}

SignOfLife::~SignOfLife() {
  if (shown_ && terminal_) std::fputs("\r\033[K", stderr);
}

void SignOfLife::show(const Moment& moment) {
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + (terminal_ ? Clock::duration(kRewrite) : Clock::duration(kPlain));
  shown_ = true;
  std::fprintf(stderr, "%spastefit: %s, %.4g s simulated, step %lld, %.0f s gone%s", terminal_ ? "\r" : "",
               std::string(moment.phase).c_str(), moment.time_s, static_cast<long long>(moment.step),
               std::chrono::duration<double>(now - start_).count(), terminal_ ? "\033[K" : "\n");
}

}  // namespace pastefit
