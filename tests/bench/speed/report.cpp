#include "tests/bench/speed/report.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "calibrate/base/atomic_file.h"

namespace pastefit {

namespace {

constexpr double kSlowDown = 1.1;
constexpr const char* kCsvHead =
    "machine,scene,grains,steps,engine,seconds,particle_steps_per_s,peak_bytes_per_grain,time_step_s,"
    "ratio_to_fastest_peer\n";

std::string text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

std::string scene_key(const SceneResult& r) {
  return r.scene + ',' + text("%.0f", r.grains) + ',' + text("%.0f", r.steps) + ',';
}

std::string row_of(const SceneResult& r, const TimedEngine& e) {
  std::string row = "| " + e.name + " | ";
  if (!e.measured()) return row + "failed: " + e.problem + " |\n";
  if (r.steps > 0) row += text("%.2f | ", 1e-6 * r.particle_steps_per_s(e));
  row += text("%.2f | ", e.median());
  if (&e != &r.ours() && r.ours().measured()) row += text("%.2f", e.median() / r.ours().median());
  row += " | ";
  if (r.grains > 0) row += text("%.0f", e.peak_bytes / r.grains);
  row += " | ";
  if (e.time_step_s > 0) row += text("%.3g", e.time_step_s);
  row += " | " + e.laws;
  for (const auto& [name, value] : e.notes) row += (row.ends_with("| ") ? "" : "; ") + name + ' ' + text("%.4g", value);
  return row + " |\n";
}

}  // namespace

std::string machine_name() {
  std::ifstream file("/proc/cpuinfo");
  std::string model = "unknown processor";
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) {
      model = line.substr(line.find(':') + 2);
      break;
    }
  std::replace(model.begin(), model.end(), '"', '\'');
  return model + ", " + std::to_string(std::thread::hardware_concurrency()) + " cores";
}

std::string table_of(const SceneResult& r) {
  std::string out = "\n### " + r.scene;
  if (r.grains > 0) out += text(", %.0f grains", r.grains);
  if (r.steps > 0) out += text(", %.0f steps", r.steps);
  out += "\n\n| engine | ";
  if (r.steps > 0) out += "M particle-steps/s | ";
  out += "processor s | ours is faster by | peak bytes/grain | time step s | laws and notes |\n|---|";
  out += r.steps > 0 ? "---:|---:|---:|---:|---:|---|\n" : "---:|---:|---:|---:|---|\n";
  for (const TimedEngine& e : r.engines) out += row_of(r, e);
  if (const auto ratio = r.ratio_to_fastest_peer()) out += text("\nAgainst the fastest peer: %.2f x\n", *ratio);
  for (const std::string& package : r.not_installed)
    out += "\n" + package + " is not installed; apt-get install " + package + "\n";
  return out;
}

std::string scaling_table(const std::vector<SceneResult>& boxes) {
  std::string out =
      "\n### cost of a grain's step\n\n| grains | ns | of the smallest | peak bytes/grain |\n|---:|---:|---:|---:|\n";
  double first = 0;
  for (const SceneResult& box : boxes) {
    if (!box.ours().measured()) continue;
    const double cost = 1e9 / box.particle_steps_per_s(box.ours());
    if (first == 0) first = cost;
    out += text("| %.0f | ", box.grains) + text("%.1f | ", cost) + text("%.2f | ", cost / first) +
           text("%.0f |\n", box.ours().peak_bytes / box.grains);
  }
  return out;
}

nlohmann::ordered_json json_of(const std::vector<SceneResult>& results) {
  using Json = nlohmann::ordered_json;
  Json scenes = Json::object();
  for (const SceneResult& r : results) {
    const auto engine = [&](const TimedEngine& e) {
      Json json = Json::object();
      if (!e.laws.empty()) json["laws"] = e.laws;
      if (!e.measured()) {
        json["problem"] = e.problem;
        return json;
      }
      if (r.steps > 0) json["particle_steps_per_s"] = r.particle_steps_per_s(e);
      json["seconds"] = e.median();
      json["seconds_of_runs"] = e.seconds;
      if (r.grains > 0) json["peak_bytes_per_grain"] = e.peak_bytes / r.grains;
      if (e.time_step_s > 0) json["time_step_s"] = e.time_step_s;
      for (const auto& [name, value] : e.notes) json[name] = value;
      return json;
    };
    Json scene = Json::object();
    if (r.grains > 0) scene["grains"] = static_cast<std::int64_t>(r.grains);
    if (r.steps > 0) scene["steps"] = static_cast<std::int64_t>(r.steps);
    scene["ours"] = engine(r.ours());
    Json peers = Json::object();
    for (std::size_t k = 1; k < r.engines.size(); ++k) peers[r.engines[k].name] = engine(r.engines[k]);
    scene["peers"] = peers;
    if (const auto ratio = r.ratio_to_fastest_peer()) scene["ratio_to_fastest_peer"] = *ratio;
    if (!r.not_installed.empty()) scene["not_installed"] = r.not_installed;
    scenes[r.scene] = scene;
  }
  return {{"format", "pastefit-bench-1"}, {"machine", machine_name()}, {"scenes", scenes}};
}

std::vector<Comparison> compared_with(const std::filesystem::path& csv, const std::vector<SceneResult>& results) {
  struct Line {
    std::string machine;
    double seconds;
  };
  std::map<std::string, std::map<std::string, Line>>
      last;  // by scene, grains and steps; by machine, "" for the last one
  std::ifstream file(csv);
  for (std::string line; std::getline(file, line);) {
    const std::size_t scene = line.rfind("\","), engine = line.find(",ours,");
    if (!line.starts_with('"') || scene == std::string::npos || engine == std::string::npos) continue;
    const Line read{line.substr(1, scene - 1), std::strtod(line.c_str() + engine + 6, nullptr)};
    if (!(read.seconds > 0)) continue;
    auto& lines = last[line.substr(scene + 2, engine - scene - 1)];
    lines[read.machine] = lines[""] = read;
  }
  std::vector<Comparison> comparisons;
  for (const SceneResult& r : results) {
    if (!r.ours().measured() || r.ours().name != "ours") continue;
    const auto lines = last.find(scene_key(r));
    if (lines == last.end()) continue;
    const auto own = lines->second.find(machine_name());
    const Line& then = own != lines->second.end() ? own->second : lines->second.at("");
    comparisons.push_back({r.scene, then.machine, then.machine == machine_name(), r.ours().median(), then.seconds});
  }
  return comparisons;
}

std::string sentence_of(const Comparison& c) {
  return c.scene + ": " + text("%.3g s, ", c.now_s) + text("%.2f times ", c.now_s / c.then_s) +
         text("the %.3g s on record for ", c.then_s) + (c.same_machine ? "this machine" : "another one, " + c.machine);
}

bool is_slow_down(const Comparison& c) {
  return c.same_machine && c.now_s > kSlowDown * c.then_s;
}

Faults append_csv(const std::filesystem::path& csv, const std::vector<SceneResult>& results) {
  std::ifstream file(csv);
  std::stringstream known;
  known << file.rdbuf();
  std::string content = known.str().empty() ? kCsvHead : known.str();
  for (const SceneResult& r : results)
    for (const TimedEngine& e : r.engines) {
      if (!e.measured()) continue;
      content += '"' + machine_name() + "\"," + scene_key(r) + e.name + ',' + text("%.6g,", e.median());
      if (r.steps > 0) content += text("%.6g", r.particle_steps_per_s(e));
      content += ',';
      if (r.grains > 0) content += text("%.0f", e.peak_bytes / r.grains);
      content += text(",%.6g,", e.time_step_s);
      if (const auto ratio = r.ratio_to_fastest_peer(); ratio && &e == &r.ours()) content += text("%.3f", *ratio);
      content += '\n';
    }
  return write_atomically(csv, content);
}

}  // namespace pastefit
