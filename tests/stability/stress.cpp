// pastefit-stress: runs slump tests all over the admissible box and judges how each ends. See README.md beside it.

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "tests/stability/attraction_case.h"
#include "tests/stability/parameter_case.h"
#include "tests/stability/stress_csv.h"

using namespace pastefit;

namespace {

// A run that ignores its bounds is killed after this many times the processor time it was allowed.
constexpr double kPatience = 3;

std::string packed(const StressVerdict& v) {
  std::ostringstream text;
  text.precision(17);
  text << v.end << '\t' << v.phase << '\t' << v.message << '\t' << v.particles << '\t' << v.steps << '\t'
       << v.simulated_s << '\t' << v.cpu_s << '\t' << v.energy_error << '\t' << v.settled << '\t' << v.height1_mm
       << '\t' << v.height2_mm << '\t' << v.spread_mm;
  return text.str();
}

/// Empty unless the text is complete.
std::optional<StressVerdict> unpacked(const std::string& text) {
  std::istringstream in(text);
  StressVerdict v;
  std::getline(in, v.end, '\t');
  std::getline(in, v.phase, '\t');
  std::getline(in, v.message, '\t');
  in >> v.particles >> v.steps >> v.simulated_s >> v.cpu_s >> v.energy_error >> v.settled >> v.height1_mm >>
      v.height2_mm >> v.spread_mm;
  if (!in) return {};
  return v;
}

/// A run in a process of its own, so that a crash or a hang is a finding and not the end of the campaign.
struct Job {
  StressCase stress;
  int answer = -1;  ///< read end of the pipe
};

std::pair<pid_t, Job> launch(const StressCase& stress, const Bounds& bounds) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe for a run");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process for a run");
  if (child == 0) {
    const auto limit = static_cast<rlim_t>(kPatience * bounds.cpu_s) + 1;
    const rlimit cpu{limit, limit};
    setrlimit(RLIMIT_CPU, &cpu);
    const std::string answer = packed(judge(stress, bounds));
    const bool written = write(ends[1], answer.data(), answer.size()) == static_cast<ssize_t>(answer.size());
    _exit(written ? 0 : 1);
  }
  close(ends[1]);
  return {child, {stress, ends[0]}};
}

StressVerdict collect(const Job& job, int status) {
  // An answer is far smaller than a pipe holds, so that it lies there whole when the process has ended.
  char answer[4096];
  const ssize_t length = read(job.answer, answer, sizeof answer);
  close(job.answer);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && length > 0)
    if (const auto verdict = unpacked({answer, static_cast<std::size_t>(length)})) return *verdict;
  StressVerdict verdict;
  verdict.end = "defect";
  if (!WIFSIGNALED(status))
    verdict.message = "the process ended with status " + std::to_string(WEXITSTATUS(status));
  else if (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)
    verdict.message = "hang: the run ignored its bounds and was killed";
  else
    verdict.message = std::string("crash: ") + strsignal(WTERMSIG(status));
  return verdict;
}

void print_inputs(std::ostream& out, const StressCase& stress) {
  for (const auto& [name, value] : inputs_of(stress)) out << "  " << name << " = " << value << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  int runs = 40, first = 0, at_once = 1;
  double minutes = 1e9;
  std::uint64_t seed = 1;
  Bounds bounds;
  std::string csv_path, report_path;
  bool parameters = false, attraction = false;
  CLI::App app{"Slump tests all over the admissible box: each has to end with valid readings or a classified failure."};
  app.add_option("--runs", runs, "number of runs")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--first", first, "number of the first case; with --runs 1 it is printed in full")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  app.add_flag("--parameters", parameters, "corners and points of the box of a study's parameters instead");
  app.add_flag("--attraction", attraction, "a grid over cohesion_ratio and the cohesion factors instead")
      ->excludes("--parameters");
  app.add_option("--seed", seed, "shift of the Sobol points, or of the random ones")->capture_default_str();
  app.add_option("--threads", at_once, "runs at the same time")->capture_default_str()->check(CLI::Range(1, 1024));
  app.add_option("--steps", bounds.steps, "bound on the steps of a run")->capture_default_str();
  app.add_option("--cpu-s", bounds.cpu_s, "bound on the processor time of a run")->capture_default_str();
  app.add_option("--minutes", minutes, "no run starts after this time");
  app.add_option("--csv", csv_path, "file for one row per run; cases that it has already are not run again");
  app.add_option("--report", report_path, "file for the report; otherwise it is printed");
  CLI11_PARSE(app, argc, argv);

  const auto start = std::chrono::steady_clock::now();
  const auto minutes_gone = [&] {
    return std::chrono::duration<double, std::ratio<60>>(std::chrono::steady_clock::now() - start).count();
  };
  const auto cases_of = attraction ? attraction_cases : parameters ? parameter_cases : stress_cases;
  const std::vector<StressCase> cases = cases_of(first, runs, seed);
  std::vector<StressResult> results;
  std::vector<StressCase> to_run;
  std::ifstream before(csv_path);
  const std::map<int, StressVerdict> known = read_csv(before);
  for (const StressCase& stress : cases) {
    const auto done = known.find(stress.number);
    if (done == known.end())
      to_run.push_back(stress);
    else
      results.push_back({stress, done->second});
  }
  std::ofstream csv(csv_path, std::ios::app);
  if (!csv_path.empty() && known.empty()) write_csv_head(csv, cases[0]);

  std::map<pid_t, Job> running;
  auto next = to_run.begin();
  while (true) {
    while (next != to_run.end() && static_cast<int>(running.size()) < at_once && minutes_gone() < minutes)
      running.insert(launch(*next++, bounds));
    if (running.empty()) break;
    int status = 0;
    const pid_t ended = wait(&status);
    const auto job = running.find(ended);
    if (job == running.end()) continue;
    results.push_back({job->second.stress, collect(job->second, status)});
    running.erase(job);
    const StressResult& result = results.back();
    if (!csv_path.empty()) write_csv_row(csv, result);
    if (result.verdict.end == "defect" || runs == 1) {
      std::cout << "case " << result.stress.number << " ("
                << (attraction   ? "--attraction "
                    : parameters ? "--parameters "
                                 : "")
                << "--first " << result.stress.number << " --runs 1 --seed " << seed << "): " << result.verdict.end
                << ' ' << result.verdict.phase << ' ' << result.verdict.message << '\n';
      print_inputs(std::cout, result.stress);
    }
  }

  std::sort(results.begin(), results.end(),
            [](const StressResult& a, const StressResult& b) { return a.stress.number < b.stress.number; });
  std::ofstream report_file(report_path);
  write_report(report_path.empty() ? std::cout : report_file, results);
  const bool clean =
      std::none_of(results.begin(), results.end(), [](const StressResult& r) { return r.verdict.end == "defect"; });
  return clean ? 0 : 1;
}
