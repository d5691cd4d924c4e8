#include "calibrate/cli/progress_line.h"

#include <algorithm>
#include <chrono>

#include "calibrate/base/text.h"
#include "calibrate/cli/standard_output.h"
#include "calibrate/cli/terminal.h"

namespace pastefit {

ProgressLine::ProgressLine(const WorkAhead& work, const ErrorUnit& unit)
    : line_({.first = {}, .on_terminal = std::chrono::milliseconds(100), .elsewhere = std::chrono::seconds(5)}),
      work_(work),
      unit_(unit) {}

void ProgressLine::show(const Progress& progress) {
  const std::lock_guard lock(mutex_);
  const bool new_phase = progress.phase != phase_;
  if (new_phase) done_before_ = done();
  phase_ = progress.phase;
  best_error_ = progress.best_error;
  rewrite(new_phase);
  if (!progress.note.empty()) note("%s%s\n", line_.is_terminal() ? "\n" : "", progress.note.c_str());
}

void ProgressLine::show(const EvaluationCounts& counts) {
  const std::lock_guard lock(mutex_);
  counts_ = counts;
  rewrite(false);
}

std::string ProgressLine::time_left() const {
  const double elapsed = line_.gone_s();
  if (counts_.simulated == 0 || elapsed <= 0) return "";
  const int in_phase = done() - done_before_;
  const int budget = std::max(0, work_.budget - done());
  int least = work_.examination, most = budget;
  if (phase_ == "examination")
    least = most = std::clamp(work_.examination - in_phase, 0, budget);
  else
    least += phase_ == "confirmation" ? std::max(0, work_.confirmation - in_phase) : work_.confirmation;
  if (phase_ == "screening") least += std::max(0, work_.screening - done());
  const double each_s = elapsed / counts_.simulated;
  return range_of_time(std::min(least, most) * each_s, most * each_s) + " left";
}

std::string ProgressLine::text() const {
  int failed = 0;
  for (const auto& [reason, count] : counts_.failures) failed += count;
  std::string line =
      fitted({format("%s %d of %d%s", phase_.c_str(), done(), work_.budget, line_.is_terminal() ? "" : " simulations"),
              best_error_ < 0 ? "no error yet" : "error " + unit_.words(best_error_, "%.2f"), time_left(),
              failed > 0 ? format("%d failed", failed) : "",
              counts_.answered > 0 ? format("%d known", counts_.answered) : ""});
  if (line_.is_terminal()) line.insert(phase_.size(), bar(columns() - 1 - std::min(line.size(), columns() - 1)));
  return line;
}

/// How much of the budget is used, as a bar of at most so many columns; none where that is too few to be told.
std::string ProgressLine::bar(std::size_t columns) const {
  constexpr std::size_t kMost = 24, kLeast = 6, kFrame = 3;  // a blank and the brackets
  if (columns < kLeast + kFrame || work_.budget <= 0) return "";
  const std::size_t length = std::min(kMost, columns - kFrame);
  const double share = std::clamp(static_cast<double>(done()) / work_.budget, 0.0, 1.0);
  const auto full = static_cast<std::size_t>(share * static_cast<double>(length));
  return " [" + std::string(full, '#') + std::string(length - full, '-') + "]";
}

void ProgressLine::rewrite(bool now) {
  if (!now && !line_.is_due()) return;
  const auto line = text();
  if (line == last_) return;
  last_ = line;
  line_.show(line);
}

void ProgressLine::end() {
  const std::lock_guard lock(mutex_);
  rewrite(true);
  line_.keep();
}

}  // namespace pastefit
