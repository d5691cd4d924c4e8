#include "calibrate/cli/progress_line.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "calibrate/base/foreign_text.h"
#include "calibrate/base/format.h"
#include "calibrate/cli/standard_output.h"

namespace pastefit {

namespace {

constexpr std::chrono::milliseconds kRewrite{100};
constexpr std::chrono::seconds kPlain{5};

}  // namespace

ProgressLine::ProgressLine(int budget, const MisfitUnit& unit)
    : terminal_(isatty(STDOUT_FILENO) == 1), budget_(budget), unit_(unit) {}

void ProgressLine::show(const Progress& progress) {
  const std::lock_guard lock(mutex_);
  const bool new_phase = progress.phase != phase_;
  phase_ = progress.phase;
  best_miss_ = progress.best_miss;
  rewrite(new_phase);
  if (progress.note.empty()) return;
  print("%s%s\n", terminal_ ? "\n" : "", progress.note.c_str());
  std::fflush(stdout);
}

void ProgressLine::show(const EvaluationCounts& counts) {
  const std::lock_guard lock(mutex_);
  counts_ = counts;
  rewrite(false);
}

std::string ProgressLine::text() const {
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  const double rate = elapsed > 0 ? counts_.simulated / elapsed : 0;
  const int done = counts_.simulated + counts_.answered;
  int failed = 0;
  for (const auto& [reason, count] : counts_.failures) failed += count;

  std::string line = format("%-12s %d of %d simulations", phase_.c_str(), done, budget_);
  if (counts_.answered > 0) line += format(" (%d known)", counts_.answered);
  if (failed > 0) line += format(", %d failed", failed);
  line += best_miss_ < 0 ? ", no misfit yet" : ", best misfit " + unit_.words(best_miss_, "%.2f");
  line += format(", %.2f a second", rate);
  if (rate > 0) line += format(", at most %.0f s left", std::max(0, budget_ - done) / rate);
  return line;
}

void ProgressLine::rewrite(bool now) {
  const auto time = Clock::now();
  if (!now && time - printed_ < (terminal_ ? Clock::duration(kRewrite) : Clock::duration(kPlain))) return;
  const auto line = text();
  if (line == last_) return;
  printed_ = time;
  last_ = line;
  if (terminal_)
    std::printf("\r%s\033[K", one_line(line).c_str());
  else
    print("%s\n", line.c_str());
  std::fflush(stdout);
}

void ProgressLine::end() {
  const std::lock_guard lock(mutex_);
  rewrite(true);
  if (terminal_ && !last_.empty()) std::printf("\n");
  std::fflush(stdout);
}

}  // namespace pastefit
