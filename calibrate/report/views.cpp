#include "calibrate/report/views.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/json_reader.h"
#include "calibrate/base/machine.h"
#include "calibrate/base/text.h"
#include "calibrate/base/worker_pool.h"
#include "calibrate/store/outcome_json.h"
#include "calibrate/store/program.h"
#include "calibrate/store/store.h"

namespace pastefit {

namespace {

SeenSimulation look_at(const Test& test, bool filmed, const std::function<bool()>& goes_on) {
  SeenSimulation look;
  look.seen.packing = specimen_of(test).packing_seed;
  if (filmed) look.film.emplace();
  RunOptions options;
  options.watch_interval_s = RunRecorder::kInterval;
  options.watch = [&](const Snapshot& snapshot) {
    look.see(test, snapshot);
    return goes_on();
  };
  look.end(simulate(test, options));
  return look;
}

}  // namespace

TestView view_of(const CardTest& test, std::span<const std::uint64_t> packings, int threads,
                 const std::function<bool()>& goes_on, RunRecordings* seen) {
  std::vector<SeenSimulation> looks(packings.size());
  TestView view;
  view.program = program_identity();
  {
    WorkerPool pool(threads > 0 ? threads : processors());
    std::vector<std::shared_future<void>> done;
    for (std::size_t i = 0; i < packings.size(); ++i) {
      Test one = test.test;
      specimen_of(one).packing_seed = packings[i];
      const bool filmed = i == 0;
      if (auto known = seen ? seen->take(one) : std::nullopt; known && (known->film || !filmed))
        looks[i] = std::move(*known);
      else if (goes_on())
        done.push_back(pool.submit([&, i, one, filmed] { looks[i] = look_at(one, filmed, goes_on); }));
    }
    for (auto& one : done) one.get();
  }
  for (SeenSimulation& look : looks) {
    if (!look.ended || (look.failure && look.failure->reason == FailureReason::stopped && !goes_on()))
      ++view.lacking;
    else if (look.failure)
      view.failures.push_back("packing " + std::to_string(look.seen.packing) + ": " + look.failure->message);
    else
      view.runs.push_back(std::move(look.seen));
  }
  if (!looks.empty() && looks.front().film) view.film = coded(std::move(*looks.front().film).film());
  return view;
}

namespace {

using nlohmann::json;

constexpr const char* kFormat = "pastefit-views-1";

std::vector<std::string> simulations_of(const CardTest& test, std::span<const std::uint64_t> packings,
                                        const std::string& program) {
  std::vector<std::string> names;
  Test one = test.test;
  for (const std::uint64_t packing : packings) {
    specimen_of(one).packing_seed = packing;
    names.push_back(evaluation_key(program, one));
  }
  return names;
}

json json_of_run(const SeenRun& run) {
  json out{{"packing", run.packing}, {"readings", to_json(run.readings)}, {"outlines", json::object()}};
  for (const auto& [name, outline] : run.outlines)
    out["outlines"][name] = {
        {"first_x_m", outline.first_x_m}, {"spacing_m", outline.spacing_m}, {"height_m", outline.height_m}};
  if (!run.curve) return out;
  auto points = json::array();
  for (const CurvePoint& point : run.curve->points) points.push_back({point.x, point.y});
  out["curve"] = {{"name", run.curve->name}, {"x", run.curve->x}, {"y", run.curve->y}, {"points", std::move(points)}};
  return out;
}

/// Limits the length of an outline, which is drawn point by point.
Outline outline_of(const json& in) {
  constexpr double kFar = 10;  // [m]
  Outline out{in.at("first_x_m").get<double>(), in.at("spacing_m").get<double>(),
              in.at("height_m").get<std::vector<double>>()};
  const double length = out.spacing_m * static_cast<double>(out.height_m.size());
  if (!(out.spacing_m > 0) || !(std::fabs(out.first_x_m) < kFar) || !(length < 2 * kFar))
    throw std::invalid_argument("an outline is not that of a heap");
  return out;
}

SeenRun run_of(const json& in) {
  SeenRun out{static_cast<std::uint64_t>(whole_number_from_json(in.at("packing"))),
              readings_from_json(in.at("readings")),
              {},
              {}};
  for (const auto& [name, outline] : in.at("outlines").items()) out.outlines[name] = outline_of(outline);
  if (!in.contains("curve")) return out;
  const json& curve = in.at("curve");
  out.curve = {
      curve.at("name").get<std::string>(), curve.at("x").get<std::string>(), curve.at("y").get<std::string>(), {}};
  for (const json& point : curve.at("points"))
    out.curve->points.push_back({point.at(0).get<double>(), point.at(1).get<double>()});
  return out;
}

/// Accepts base64 only: the film is inserted into the page unescaped.
std::string grains_of(const json& in) {
  auto grains = in.get<std::string>();
  constexpr const char* kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/=";
  if (grains.find_first_not_of(kLetters) != std::string::npos) throw std::invalid_argument("its film is not base64");
  return grains;
}

TestView view_in(const json& in, const std::string& program) {
  TestView view;
  view.program = program;
  if (in.contains("film")) view.film = {in.at("film").at("index").dump(), grains_of(in.at("film").at("grains"))};
  for (const json& run : in.at("runs")) view.runs.push_back(run_of(run));
  view.failures = in.at("failures").get<std::vector<std::string>>();
  return view;
}

/// Removes the checksum from the document and compares it with that of the rest.
bool take_checksum(json& document) {
  if (!document.is_object() || !document.contains("checksum")) return false;
  const json told = document.at("checksum");
  document.erase("checksum");
  return told == content_hash(document.dump());
}

}  // namespace

Faults write_views(const std::filesystem::path& file, const Card& card, std::span<const std::uint64_t> packings,
                   const std::vector<TestView>& views) {
  json document{{"format", kFormat}, {"program", views.at(0).program}, {"tests", json::array()}};
  for (std::size_t i = 0; i < views.size(); ++i) {
    const TestView& view = views[i];
    json test{{"simulations", simulations_of(card.tests.at(i), packings, view.program)}, {"failures", view.failures}};
    auto& runs = test["runs"] = json::array();
    for (const SeenRun& run : view.runs) runs.push_back(json_of_run(run));
    if (!view.film.empty()) test["film"] = {{"index", json::parse(view.film.index)}, {"grains", view.film.grains}};
    document["tests"].push_back(std::move(test));
  }
  document["checksum"] = content_hash(document.dump());
  return write_atomically(file, document.dump() + "\n");
}

Result<std::vector<TestView>> read_views(const std::filesystem::path& file, const Card& card,
                                         std::span<const std::uint64_t> packings) {
  const std::string remedy = "the one that was written with the card";
  Faults faults;
  auto document = read_json(file, faults);
  if (!document) return faults;
  if (!take_checksum(*document)) return Fault{file.string(), "is damaged: it does not agree with its checksum", remedy};
  try {
    if (document->at("format") != kFormat)
      return Fault{file.string(), "is of format " + text_of(document->at("format")), kFormat};
    const auto program = document->at("program").get<std::string>();
    const json& tests = document->at("tests");
    bool same = tests.size() == card.tests.size();
    for (std::size_t i = 0; same && i < tests.size(); ++i)
      same = tests[i].at("simulations") == simulations_of(card.tests[i], packings, program);
    if (!same)
      return Fault{file.string(), "is of another material, other tests or other packings than the card", remedy};
    std::vector<TestView> views;
    for (const json& test : tests) views.push_back(view_in(test, program));
    return views;
  } catch (const std::exception& error) {
    return Fault{file.string(), std::string("cannot be understood: ") + error.what(), remedy};
  }
}

namespace {

/// "_pa" of "stress_pa".
std::string_view suffix_of(std::string_view name) {
  const auto last = name.rfind('_');
  return last == std::string_view::npos ? std::string_view{} : name.substr(last);
}

}  // namespace

std::optional<std::string> curve_csv(const CardTest& test, const TestView& view) {
  const auto& runs = view.runs;
  const auto drawn = std::ranges::find_if(runs, [](const SeenRun& run) { return run.curve.has_value(); });
  if (drawn == runs.end()) return std::nullopt;
  const Curve& curve = *drawn->curve;
  const Drawing drawing = drawing_of_curves(curve.name, curve.x, curve.y, runs);
  std::string out = curve.x + "," + curve.y + "," + curve.y + "_lowest," + curve.y + "_highest";
  std::string of_laboratory;
  for (const CardReading& one : test.readings) {
    if (!one.measured || suffix_of(one.name) != suffix_of(curve.y)) continue;
    out += "," + one.name + "," + one.name + "_deviation";
    of_laboratory += format(",%.6g,%.6g", *one.measured, one.standard_deviation);
  }
  out += "\n";
  const auto& mean = drawing.lines.front().points;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    const double low = drawing.bands.empty() ? mean[i][1] : drawing.bands.front().points[i][1];
    const double high = drawing.bands.empty() ? mean[i][1] : drawing.bands.front().points[i][2];
    out += format("%.6g,%.6g,%.6g,%.6g", mean[i][0], mean[i][1], low, high) + of_laboratory + "\n";
  }
  return out;
}

std::string curve_file(const std::string& test_name) {
  return "curve" + (test_name.empty() ? "" : "-" + test_name) + ".csv";
}

}  // namespace pastefit
