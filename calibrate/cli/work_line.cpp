#include "calibrate/cli/work_line.h"

#include <algorithm>
#include <utility>

#include "calibrate/base/text.h"
#include "calibrate/cli/terminal.h"

namespace pastefit {

WorkLine::WorkLine(std::string pieces, int total) : pieces_(std::move(pieces)), total_(total) {}

WorkLine::~WorkLine() {
  clear();
}

void WorkLine::clear() {
  const std::lock_guard lock(mutex_);
  line_.clear();
}

void WorkLine::one_done() {
  {
    const std::lock_guard lock(mutex_);
    ++done_;
  }
  look();
}

void WorkLine::look() {
  const std::lock_guard lock(mutex_);
  if (line_.is_due()) line_.show(text());
}

std::string WorkLine::text() const {
  const int left = std::max(0, total_ - done_);
  // Those under way are as good as begun: at least what is left without them, at most all that is.
  const double each_s = done_ > 0 ? line_.gone_s() / done_ : 0;
  return fitted({format("%d of %d %s", done_, total_, pieces_.c_str()), format("%.0f s gone", line_.gone_s()),
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
