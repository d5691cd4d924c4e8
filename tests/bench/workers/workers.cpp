// What many workers bring to one search and to many, with a clock of its own (README.md of the folder above).
//
// usage: pastefit-workers [MAX_PENDING]   candidates that may be under way when the next one is proposed; default: 0

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <queue>
#include <string>
#include <vector>

#include "calibrate/base/machine.h"
#include "calibrate/search/search.h"
#include "tests/calibrate/search/fake_slump.h"

using namespace pastefit;
using namespace pastefit::synthetic;

namespace {

constexpr int kStudies = 20;
constexpr int kWorkers[] = {1, 4, 8, 16, 64};
constexpr double kRuns[] = {1, 600};  // [s]

/// A study of a heap: its heights from 110 to 205 mm, each with the spread that the fake heap has there.
Synthetic study(int number) {
  const double height = 110 + 5 * (number - 1);
  return fake_heap(height, 430 - 0.75 * height, static_cast<std::uint64_t>(number));
}

/// What one search took.
struct Course {
  double wall_s = 0, busy_s = 0, thought_s = 0;
  int simulations = 0;
  bool confirmed = false;
  std::map<std::string, double> phase_s;  ///< wall time by the phase that was waited for
};

/// Workers who simulate, each one run at a time, and the search, whose own processor time counts as it passes.
/// Runs last 0.7 to 1.3 of `run_s`, most of it the candidate's.
class Workers {
 public:
  Workers(int count, double run_s, int max_pending, std::uint64_t seed)
      : idle_(count), run_s_(run_s), max_pending_(max_pending), seed_(seed) {}

  Course calibrate(Synthetic objective) {
    SearchOptions options = options_with(seed_);
    options.budget_simulations = 150;
    options.max_pending = max_pending_;
    objective.budget = options.budget_simulations;
    const double before = processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
    Search search(objective, options, {.simulations = options.budget_simulations});
    think(before);
    while (!search.finished()) {
      while (idle_ > 0 && start(search)) {
      }
      if (!under_way_.empty()) end_one(search, objective);
    }
    course_.wall_s = now_;
    course_.simulations = search.result().simulations;
    course_.confirmed = search.result().status == CalibrationStatus::confirmed;
    return course_;
  }

 private:
  struct UnderWay {
    double end_s;
    Candidate candidate;
    bool operator<(const UnderWay& other) const { return end_s > other.end_s; }  // the first to end on top
  };

  /// The search has worked since `before`: meanwhile nothing new is started.
  void think(double before) {
    const double gone = processor_seconds(CLOCK_PROCESS_CPUTIME_ID) - before;
    now_ += gone;
    course_.thought_s += gone;
  }

  /// Whether there was something to start.
  bool start(Search& search) {
    const double before = processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
    const auto candidates = search.suggest(static_cast<std::size_t>(idle_));
    think(before);
    for (const Candidate& one : candidates) {
      const std::uint64_t at = digest(one.point);
      const double lasts = run_s_ * (0.7 + 0.5 * uniform(at, 5) + 0.1 * uniform(at, one.packing));
      course_.busy_s += lasts;
      under_way_.push({now_ + lasts, one});
      --idle_;
    }
    return !candidates.empty();
  }

  void end_one(Search& search, Synthetic& objective) {
    const UnderWay first = under_way_.top();
    under_way_.pop();
    ++idle_;
    const double waited = std::max(0.0, first.end_s - now_);
    now_ += waited;
    course_.phase_s[first.candidate.purpose] += waited;
    const Candidate& one = first.candidate;
    const auto answer = one.may_end_early ? &Objective::try_out : &Objective::evaluate;
    const Response response = (objective.*answer)({&one.point, 1}, {&one.packing, 1}).at(0);
    const CandidateResult result{one.number, response.evaluations.at(0)};
    const double before = processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
    search.ingest({&result, 1});
    think(before);
  }

  int idle_;
  const double run_s_;
  const int max_pending_;
  const std::uint64_t seed_;
  double now_ = 0;
  std::priority_queue<UnderWay> under_way_;
  Course course_;
};

/// Wall time of jobs that start in their order on so many places.
double wall_on(const std::vector<Course>& jobs, std::size_t places) {
  std::vector<double> free_at(places, 0.0);
  for (const Course& job : jobs) *std::ranges::min_element(free_at) += job.wall_s;
  return std::ranges::max(free_at);
}

std::vector<Course> courses(int workers, double run_s, int max_pending) {
  std::vector<Course> out;
  for (int number = 1; number <= kStudies; ++number)
    out.push_back(Workers(workers, run_s, max_pending, static_cast<std::uint64_t>(number)).calibrate(study(number)));
  return out;
}

/// A row of one search, means over the studies; returns its wall time.
double print_row(int workers, double run_s, const std::vector<Course>& all, double alone_s) {
  Course sum;
  int confirmed = 0;
  for (const Course& one : all) {
    sum.wall_s += one.wall_s / kStudies;
    sum.busy_s += one.busy_s / kStudies;
    sum.thought_s += one.thought_s / kStudies;
    sum.simulations += one.simulations;
    confirmed += one.confirmed ? 1 : 0;
    for (const auto& [phase, seconds] : one.phase_s) sum.phase_s[phase] += seconds / kStudies;
  }
  std::printf("| %g | %d | %.1f | %.1f | %.2f | %.2f | %.1f |", run_s, workers, sum.simulations / double{kStudies},
              sum.wall_s, alone_s > 0 ? alone_s / sum.wall_s : 1.0, sum.busy_s / (workers * sum.wall_s), sum.thought_s);
  for (const char* phase : {"screening", "search", "refinement", "confirmation"})
    std::printf(" %.1f |", sum.phase_s[phase]);
  std::printf(" %d |\n", confirmed);
  std::fflush(stdout);
  return sum.wall_s;
}

}  // namespace

int main(int argc, char** argv) {
  const int max_pending = argc > 1 ? std::atoi(argv[1]) : 0;
  std::printf(
      "| a run s | workers | simulations | wall s | times as fast | workers busy | search's own s | screening s | "
      "search s | "
      "refinement s | confirmation s | confirmed of %d |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      kStudies);
  std::string many = "| a run s | twenty studies on 64 workers | wall s |\n|---|---|---|\n";
  for (const double run_s : kRuns) {
    double alone_s = 0;
    const auto row = [&](const char* how, double wall_s) {
      char line[200];
      std::snprintf(line, sizeof line, "| %g | %s | %.0f |\n", run_s, how, wall_s);
      many += line;
    };
    for (const int workers : kWorkers) {
      const auto all = courses(workers, run_s, max_pending);
      const double wall_s = print_row(workers, run_s, all, alone_s);
      if (workers == 1) alone_s = wall_s;
      if (workers == 1) row("all at once, one worker each (20 in use)", wall_on(all, kStudies));
      if (workers == 4) row("sixteen at once, four workers each", wall_on(all, 16));
      if (workers == 8) row("eight at once, eight workers each", wall_on(all, 8));
      if (workers == 64) row("one after the other, 64 workers each", wall_on(all, 1));
    }
    row("all at once, three workers each (60 in use)", wall_on(courses(3, run_s, max_pending), kStudies));
  }
  std::printf("\n%s", many.c_str());
}
