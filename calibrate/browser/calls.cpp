#include "calibrate/browser/calls.h"

#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "calibrate/base/refusal.h"
#include "calibrate/browser/calibration_session.h"
#include "calibrate/evaluate/simulation.h"

namespace pastefit::browser {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

std::unique_ptr<CalibrationSession>& session() {
  static std::unique_ptr<CalibrationSession> one;
  return one;
}

CalibrationSession& open_session() {
  if (!session()) refuse({{"session", "no calibration is open", "call \"open\" first"}});
  return *session();
}

ordered_json open(const json& request) {
  session().reset();
  session() = std::make_unique<CalibrationSession>(request);
  return session()->description();
}

ordered_json result(const json&) {
  if (!open_session().progress().at("finished").get<bool>())
    refuse({{"session", "the calibration has not finished", "go on with \"suggest\" and \"ingest\", or \"stop\""}});
  return open_session().result();
}

ordered_json stop(const json&) {
  open_session().stop();
  return ordered_json::object();
}

ordered_json simulated(const json& request) {
  const auto task = request.at("task").get<std::string>();
  std::string answer;
  try {
    answer = simulate_task(task);
  } catch (const std::exception& error) {
    answer = failed_task(error.what());
  }
  const auto sketch = json::parse(answer).value("sketch", json());
  return {{"answer", answer}, {"outline", sketch}};
}

using Call = ordered_json (*)(const json& request);

const std::map<std::string_view, Call>& calls() {
  static const std::map<std::string_view, Call> all{
      {"version", [](const json&) { return version(); }},
      {"presets", [](const json&) { return presets(); }},
      {"new", new_files},
      {"export", exported},
      {"simulate", simulated},
      {"open", open},
      {"suggest", [](const json& request) { return open_session().suggest(request.at("count").get<std::size_t>()); }},
      {"ingest", [](const json& request) { return open_session().ingest(request); }},
      {"progress", [](const json&) { return open_session().progress(); }},
      {"stop", stop},
      {"result", result}};
  return all;
}

ordered_json faults_json(const Faults& faults) {
  ordered_json out = ordered_json::array();
  for (const Fault& fault : faults)
    out.push_back({{"where", fault.where}, {"what", fault.what}, {"remedy", fault.remedy}});
  return {{"faults", out}};
}

}  // namespace

std::string answer_to_call(const std::string& name, const std::string& request) {
  const auto text = [](const ordered_json& answer) {
    return answer.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  };
  try {
    const auto call = calls().find(name);
    if (call == calls().end())
      return text(faults_json({{name, "is no call of the module", "one of calibrate/browser/calls.cpp"}}));
    return text({{"ok", call->second(json::parse(request))}});
  } catch (const Refusal& refusal) {
    return text(faults_json(refusal.faults));
  } catch (const std::exception& error) {
    return text(faults_json({{name, error.what(), "this is an error of the program; report it"}}));
  }
}

}  // namespace pastefit::browser
