#include "calibrate/cli/work_line.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "calibrate/base/format.h"
#include "calibrate/cli/standard_output.h"
#include "calibrate/cli/terminal.h"

namespace pastefit {

namespace {

constexpr std::chrono::seconds kBeforeFirst{2}, kBetweenLines{10};
constexpr std::chrono::milliseconds kBetweenRewrites{500};

}  // namespace

WorkLine::WorkLine(std::string pieces, int total)
    : pieces_(std::move(pieces)), total_(total), terminal_(is_terminal()), next_(start_ + kBeforeFirst) {}

WorkLine::~WorkLine() {
  clear();
}

void WorkLine::clear() {
  const std::lock_guard lock(mutex_);
  if (shown_ && terminal_) std::fputs("\r\033[K", stderr);
  shown_ = false;
}

void WorkLine::one_done() {
  {
    const std::lock_guard lock(mutex_);
    ++done_;
  }
  look();
}

void WorkLine::look() {
  if (is_quiet()) return;
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + (terminal_ ? Clock::duration(kBetweenRewrites) : Clock::duration(kBetweenLines));
  shown_ = true;
  std::fprintf(stderr, terminal_ ? "\r%s\033[K" : "%s\n", text(now).c_str());
}

std::string WorkLine::text(Clock::time_point now) const {
  const double gone_s = std::chrono::duration<double>(now - start_).count();
  const int left = std::max(0, total_ - done_);
  // Those under way are as good as begun: at least what is left without them, at most all that is.
  const double each_s = done_ > 0 ? gone_s / done_ : 0;
  return fitted({format("%d of %d %s", done_, total_, pieces_.c_str()), format("%.0f s gone", gone_s),
                 done_ > 0 && left > 0 ? range_of_time(std::max(0, left - 1) * each_s, left * each_s) + " left" : ""});
}

CheckEngine counted(CheckEngine engine, WorkLine& line) {
  const auto seen = [&line](const RunOptions& asked) {
    RunOptions options = asked;
    options.pulse = [&line, pulse = asked.pulse](const Snapshot& snapshot) {
      line.look();
      return !pulse || pulse(snapshot);
    };
    return options;
  };
  engine.prepare = [prepare = std::move(engine.prepare), seen](const Test& test, const RunOptions& options) {
    return prepare(test, seen(options));
  };
  engine.run = [run = std::move(engine.run), seen, &line](const Test& test, const RunOptions& options) {
    Outcome outcome = run(test, seen(options));
    line.one_done();
    return outcome;
  };
  return engine;
}

}  // namespace pastefit
