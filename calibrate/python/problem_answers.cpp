#include "calibrate/python/problem_answers.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "calibrate/base/content_hash.h"
#include "calibrate/base/statistics.h"
#include "calibrate/store/outcome_json.h"
#include "calibrate/study/parameters.h"

namespace pastefit::python {

using nlohmann::json;

Result<std::unique_ptr<Answers>> ProblemAnswers::open(CustomProblem problem, const std::string& file,
                                                      const std::string& engine) {
  json inputs = json::parse(problem.content);
  inputs.erase("title");
  if (inputs.contains("search")) inputs["search"].erase("budget_simulations");
  const std::string first_line = json{{"engine", engine}, {"problem", inputs}}.dump();
  std::unique_ptr<ProblemAnswers> answers(new ProblemAnswers(std::move(problem), file));
  if (auto faults = answers->read(first_line); !faults.empty()) return faults;
  return std::unique_ptr<Answers>(std::move(answers));
}

ProblemAnswers::ProblemAnswers(CustomProblem problem, std::string file)
    : problem_(std::move(problem)), file_(std::move(file)), scoring_(problem_.readings, problem_.parameters) {}

Faults ProblemAnswers::read(const std::string& first_line) {
  if (!std::filesystem::exists(file_)) return append(first_line);
  std::ifstream in(file_);
  std::string line;
  if (!std::getline(in, line) || line != first_line)
    return {{file_, "holds the answers of another problem or engine", "another file; nothing of it was changed"}};
  bool cut = in.eof();  // the last line of a run that was killed
  while (std::getline(in, line)) {
    cut = in.eof();
    try {
      const json kept = json::parse(line);
      if (is_answer(kept)) take(kept);  // what is damaged is asked again
    } catch (const json::exception&) {
    }
  }
  return cut ? append("") : Faults{};
}

Faults ProblemAnswers::append(const std::string& line) const {
  std::ofstream out(file_, std::ios::app);
  out << line << std::endl;
  if (out) return {};
  return {{file_, "cannot be written", "a file in a folder that can be written, on a disk with space"}};
}

namespace {

/// Of a line of the file, without the key itself.
std::string hash_of_line(json line) {
  line.erase("hash");
  return content_hash(line.dump());
}

bool are_numbers(const json& list, std::size_t count) {
  return list.is_array() && list.size() == count &&
         std::ranges::all_of(list, [](const json& one) { return one.is_number() && std::isfinite(one.get<double>()); });
}

}  // namespace

/// Whether a line of the file is what `keep` wrote for this problem.
bool ProblemAnswers::is_answer(const json& kept) const {
  if (!kept.is_object() || kept.value("hash", "") != hash_of_line(kept)) return false;
  const bool failed = kept.contains("failure") && !kept.at("failure").is_null();
  return kept.contains("point") && are_numbers(kept.at("point"), problem_.parameters.size()) && kept.contains("seed") &&
         (failed || (kept.contains("readings") && are_numbers(kept.at("readings"), problem_.readings.size())));
}

void ProblemAnswers::take(const json& kept) {
  const auto point = kept.at("point").get<std::vector<double>>();
  Evaluation evaluation;
  evaluation.point = Eigen::Map<const Eigen::VectorXd>(point.data(), static_cast<Eigen::Index>(point.size()));
  evaluation.packing = kept.at("seed").get<std::uint64_t>();
  evaluation.failure = failure_from_json(kept.at("failure"));
  if (!evaluation.failure) evaluation.observables = kept.at("readings").get<std::vector<double>>();
  const Key key{point, evaluation.packing};
  if (known_.emplace(key, std::move(evaluation)).second) order_.push_back(key);
}

std::vector<std::string> ProblemAnswers::readings() const {
  std::vector<std::string> names;
  for (const StudyReading& reading : problem_.readings) names.push_back(reading.name);
  return names;
}

std::optional<Evaluation> ProblemAnswers::find(const Candidate& candidate) const {
  const auto found = known_.find({{candidate.point.begin(), candidate.point.end()}, candidate.packing});
  return found == known_.end() ? std::nullopt : std::optional(found->second);
}

Result<Evaluation> ProblemAnswers::keep(const Candidate& candidate, const EngineAnswer& answer) {
  const auto names = readings();
  json line{{"point", std::vector<double>(candidate.point.begin(), candidate.point.end())},
            {"seed", candidate.packing},
            {"failure", to_json(failure_of(answer, names))}};
  if (line["failure"].is_null())
    for (const std::string& name : names) line["readings"].push_back(answer.readings.find(name).value());
  line["hash"] = hash_of_line(line);
  if (auto faults = append(line.dump()); !faults.empty()) return faults;
  take(line);
  return find(candidate).value();
}

TrainingData ProblemAnswers::evidence(std::span<const Response> history) const {
  TrainingData data;
  data.parameters = problem_.parameters;
  std::vector<const Evaluation*> good;
  std::set<Key> seen;
  for (const Response& response : history)
    for (const Evaluation& one : response.evaluations) {
      const bool cut_off = one.failure && one.failure->reason == FailureReason::stopped;
      if (cut_off || !seen.insert({{one.point.begin(), one.point.end()}, one.packing}).second) continue;
      (one.failure ? data.failed : data.points).push_back(one.point);
      if (!one.failure) good.push_back(&one);
    }
  for (std::size_t k = 0; k < problem_.readings.size(); ++k) {
    const StudyReading& reading = problem_.readings[k];
    ReadingTrainingData one;
    one.name = reading.name;
    one.measured = reading.measurement.value;
    one.deviation = reading.measurement.standard_deviation;
    one.repeats = reading.measurement.repeats;
    one.widening = widening(one.repeats);
    one.weight = reading.weight;
    one.simulated.resize(static_cast<Eigen::Index>(good.size()));
    for (std::size_t i = 0; i < good.size(); ++i) one.simulated[static_cast<Eigen::Index>(i)] = good[i]->observables[k];
    data.readings.push_back(std::move(one));
  }
  return data;
}

nlohmann::ordered_json ProblemAnswers::evaluations() const {
  auto out = nlohmann::ordered_json::array();
  for (const Key& key : order_) {
    const Evaluation& one = known_.at(key);
    nlohmann::ordered_json parameters, readings = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < problem_.parameters.size(); ++i)
      parameters[problem_.parameters[i].name] = value_between(problem_.parameters[i], key.first[i]);
    for (std::size_t k = 0; k < one.observables.size(); ++k) readings[problem_.readings[k].name] = one.observables[k];
    out.push_back({{"number", out.size()},
                   {"packing", one.packing},
                   {"parameters", std::move(parameters)},
                   {"readings", std::move(readings)},
                   {"failure", one.failure ? std::string(name_of(one.failure->reason)) : ""},
                   {"message", one.failure ? one.failure->message : ""},
                   {"ended_early", false}});
  }
  return out;
}

double ProblemAnswers::ProblemScoring::largest_error(const StudyReading& reading) const {
  return std::max(std::abs(reading.measurement.value), 10 * reading.measurement.standard_deviation);
}

}  // namespace pastefit::python
