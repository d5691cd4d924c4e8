#include "calibrate/cli/progress.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <utility>

#include "calibrate/answers.h"
#include "calibrate/base/text.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/study/tests.h"

namespace pastefit {

StatusLine::StatusLine(Clock::duration first) : terminal_(pastefit::is_terminal()), next_(start_ + first) {}

void StatusLine::show(const std::string& line) {
  if (is_quiet() || line == shown_) return;
  next_ = Clock::now() + std::chrono::milliseconds(terminal_ ? 200 : 4000);
  shown_ = line;
  if (terminal_)
    std::fprintf(stderr, "\r%s\033[K", one_line(line).c_str());
  else
    note(line + "\n");
}

void StatusLine::clear() {
  const std::lock_guard lock(mutex_);
  if (!shown_.empty() && terminal_) std::fputs("\r\033[K", stderr);
  shown_.clear();
}

void StatusLine::keep() {
  const std::lock_guard lock(mutex_);
  if (!shown_.empty() && terminal_) note("\n");
  shown_.clear();
}

namespace {

/// Progress of a single simulation.
class SignOfLife {
 public:
  void show(const Snapshot& snapshot) {
    // Phases may repeat, in a world with an earlier time.
    if (snapshot.phase != phase_ || snapshot.time_s < last_s_) {
      phase_ = snapshot.phase;
      phase_start_wall_s_ = line_.gone_s();
      phase_start_s_ = snapshot.time_s;
    }
    last_s_ = snapshot.time_s;
    line_.look([&] {
      return fitted({phase_ + time_left(snapshot), format("%.4g s simulated", snapshot.time_s),
                     format("step %lld", static_cast<long long>(snapshot.step)),
                     format("%.0f s gone", line_.gone_s())});
    });
  }

 private:
  /// Remaining time as text; empty at the beginning of a phase.
  std::string time_left(const Snapshot& snapshot) const {
    constexpr double enough_s = 0.5;
    const double taken_s = line_.gone_s() - phase_start_wall_s_;
    const double simulated_s = snapshot.time_s - phase_start_s_;
    if (taken_s < enough_s || simulated_s <= 0) return "";
    const double pace = taken_s / simulated_s;
    return " (" + range_of_time(pace * snapshot.left.least_s, pace * snapshot.left.most_s) + " left)";
  }

  StatusLine line_;
  std::string phase_;
  double phase_start_wall_s_ = 0, phase_start_s_ = 0;  // the second is simulated time
  double last_s_ = 0;
};

}  // namespace

RunOptions shown_run(const std::atomic<bool>* stop) {
  RunOptions options;
  options.pulse = [sign = std::make_shared<SignOfLife>(), stop](const Snapshot& snapshot) {
    sign->show(snapshot);
    return !stop || !*stop;
  };
  return options;
}

void WorkLine::one_done() {
  ++done_;
  look();
}

void WorkLine::look() {
  line_.look([this] {
    const int done = done_, left = std::max(0, total_ - done);
    // Running pieces count as begun: lower limit without them, upper limit with all of them.
    const double each_s = done > 0 ? line_.gone_s() / done : 0;
    return fitted({format("%d of %d %s", done, total_, pieces_), format("%.0f s gone", line_.gone_s()),
                   done > 0 && left > 0 ? range_of_time(std::max(0, left - 1) * each_s, left * each_s) + " left" : ""});
  });
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

void ProgressLine::show(const Progress& progress) {
  const std::lock_guard lock(mutex_);
  const bool new_phase = progress.phase != phase_;
  if (new_phase) done_before_ = counts_.known();
  phase_ = progress.phase;
  best_error_ = progress.best_error;
  line_.look([this] { return text(); }, new_phase);
  if (!progress.note.empty()) note("%s%s\n", line_.is_terminal() ? "\n" : "", progress.note.c_str());
}

void ProgressLine::show(const EvaluationCounts& counts) {
  const std::lock_guard lock(mutex_);
  counts_ = counts;
  line_.look([this] { return text(); });
}

void ProgressLine::look() {
  const std::lock_guard lock(mutex_);
  line_.look([this] { return text(); });
}

std::string ProgressLine::time_left() const {
  const double elapsed = line_.gone_s();
  if (counts_.simulated == 0 || elapsed <= 0) return "";
  const SearchOptions& search = study_.search;
  const int each = static_cast<int>(tests_of(study_, false).size()), in_phase = counts_.known() - done_before_;
  const int budget = std::max(0, search.budget_simulations - counts_.known());
  const int examination = search.examination_simulations * each + hold_out_simulations(study_);
  const int confirmation = search.confirmation_packings * each;
  int least = examination, most = budget;
  if (phase_ == "examination")
    least = most = std::clamp(examination - in_phase, 0, budget);
  else
    least += phase_ == "confirmation" ? std::max(0, confirmation - in_phase) : confirmation;
  if (phase_ == "screening") least += std::max(0, search.screening * each - counts_.known());
  const double each_s = elapsed / counts_.simulated;
  return range_of_time(std::min(least, most) * each_s, most * each_s) + " left";
}

std::string ProgressLine::text() const {
  int failed = 0;
  for (const auto& [reason, count] : counts_.failures) failed += count;
  std::string line =
      fitted({format("%s %d of %d%s", phase_, counts_.known(), study_.search.budget_simulations,
                     line_.is_terminal() ? "" : " simulations"),
              best_error_ < 0 ? "no error yet" : "error " + error_unit_of(study_).words(best_error_, "%.2f"),
              format("%.0f s gone", line_.gone_s()), time_left(), failed > 0 ? format("%d failed", failed) : "",
              counts_.answered > 0 ? format("%d known", counts_.answered) : ""});
  if (line_.is_terminal()) line.insert(phase_.size(), bar(columns() - 1 - std::min(line.size(), columns() - 1)));
  return line;
}

/// Used fraction of the budget as a bar of at most `columns`; empty if there is too little room.
std::string ProgressLine::bar(std::size_t columns) const {
  constexpr std::size_t kMost = 24, kLeast = 6, kFrame = 3;  // a blank and the brackets
  if (columns < kLeast + kFrame || study_.search.budget_simulations <= 0) return "";
  const std::size_t length = std::min(kMost, columns - kFrame);
  const double share = std::clamp(static_cast<double>(counts_.known()) / study_.search.budget_simulations, 0.0, 1.0);
  const auto full = static_cast<std::size_t>(share * static_cast<double>(length));
  return " [" + std::string(full, '#') + std::string(length - full, '-') + "]";
}

void ProgressLine::end() {
  const std::lock_guard lock(mutex_);
  line_.look([this] { return text(); }, true);
  line_.keep();
}

}  // namespace pastefit
