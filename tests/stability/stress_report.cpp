#include "tests/stability/stress_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "core/laws/constants.h"

namespace pastefit {

namespace {

using Coordinate = std::function<double(const StressCase&)>;

/// A coordinate of the box, cut into ranges: lower bounds of all but the first, or the names of its values.
struct Cut {
  const char* name;
  Coordinate value;
  std::vector<double> bounds;
  std::vector<const char*> names;
};

const std::vector<Cut>& cuts() {
  static const std::vector<Cut> all = {
      {"modulus [Pa]",
       [](const StressCase& s) { return s.test.contact.youngs_modulus_pa; },
       {1e6, 1e7, 1e8},
       {"1e5 .. 1e6", "1e6 .. 1e7", "1e7 .. 1e8", "1e8 .. 1e9"}},
      {"attraction [grain weights]",
       [](const StressCase& s) { return s.weights; },
       {1e-9, 1, 10, 30},
       {"0", "0.1 .. 1", "1 .. 10", "10 .. 30", "30 .. 100"}},
      {"attraction c/(E R^2)",
       [](const StressCase& s) {
         const Bridge& bridge = s.test.contact.bridge;
         const double c =
             std::max(s.test.contact.cohesion_n.value_or(0), attraction_at_touch(bridge, s.test.grains.radius_m));
         return c / (s.test.contact.youngs_modulus_pa * s.test.grains.radius_m * s.test.grains.radius_m);
       },
       {1e-4, 1e-3, 1e-2, 3e-2, 1e-1},
       {"< 1e-4", "1e-4 .. 1e-3", "1e-3 .. 0.01", "0.01 .. 0.03", "0.03 .. 0.1", "> 0.1"}},
      {"restitution",
       [](const StressCase& s) { return s.test.contact.restitution; },
       {0.1, 0.5, 0.9},
       {"0.01 .. 0.1", "0.1 .. 0.5", "0.5 .. 0.9", "0.9 .. 0.99"}},
      {"friction",
       [](const StressCase& s) { return s.test.contact.friction; },
       {0.1, 0.5, 1},
       {"0 .. 0.1", "0.1 .. 0.5", "0.5 .. 1", "1 .. 2"}},
      {"friction basis",
       [](const StressCase& s) { return static_cast<double>(s.test.contact.friction_basis); },
       {1},
       {"elastic", "total"}},
      {"rolling friction",
       [](const StressCase& s) { return s.test.contact.rolling_friction; },
       {0.1, 0.5},
       {"0 .. 0.1", "0.1 .. 0.5", "0.5 .. 1"}},
      {"rolling model",
       [](const StressCase& s) { return static_cast<double>(s.test.contact.rolling); },
       {1, 2},
       {"none", "spring-dashpot", "constant torque"}},
      {"bridge",
       [](const StressCase& s) { return static_cast<double>(s.test.contact.bridge.shape); },
       {1, 2, 3, 4},
       {"none", "polynomial", "linear", "exponential", "capillary"}},
      {"formation",
       [](const StressCase& s) { return static_cast<double>(s.test.contact.bridge.formation); },
       {1},
       {"film", "touch"}},
      {"rupture gap/R",
       [](const StressCase& s) { return s.gap_ratio; },
       {0.01, 0.1},
       {"0.001 .. 0.01", "0.01 .. 0.1", "0.1 .. 1"}},
      {"offset/R",
       [](const StressCase& s) { return s.test.contact.bridge.offset_m / s.test.grains.radius_m; },
       {0.3},
       {"0 .. 0.3", "0.3 .. 1"}},
      {"size ratio", [](const StressCase& s) { return s.size_ratio; }, {2, 5}, {"1 .. 2", "2 .. 5", "5 .. 10"}},
      {"lift velocity [m/s]",
       [](const StressCase& s) { return s.test.lift_velocity_m_s; },
       {0.03, 0.1, 0.3},
       {"0.01 .. 0.03", "0.03 .. 0.1", "0.1 .. 0.3", "0.3 .. 1"}},
      {"plate angle [deg]",
       [](const StressCase& s) { return s.plate_deg; },
       {0.5, 5, 15},
       {"no step 2", "1 .. 5", "5 .. 15", "15 .. 45"}},
      {"radii grown by [%]",
       [](const StressCase& s) { return 100 * s.enlarged; },
       {1e-9, 2, 5},
       {"0", "0 .. 2", "2 .. 5", "5 .. 10"}}};
  return all;
}

std::size_t range_of(const Cut& cut, double value) {
  return std::upper_bound(cut.bounds.begin(), cut.bounds.end(), value) - cut.bounds.begin();
}

/// All ends that occur, valid first.
std::vector<std::string> ends_of(const std::vector<StressResult>& results) {
  std::set<std::string> found;
  for (const StressResult& r : results) found.insert(r.verdict.end);
  found.erase("valid");
  std::vector<std::string> ends{"valid"};
  ends.insert(ends.end(), found.begin(), found.end());
  return ends;
}

void write_regions(std::ostream& out, const std::vector<StressResult>& results) {
  const std::vector<std::string> ends = ends_of(results);
  out << "| coordinate | range | runs |";
  for (const std::string& end : ends) out << ' ' << end << " |";
  out << "\n|---|---|";
  for (std::size_t k = 0; k <= ends.size(); ++k) out << "---:|";
  out << '\n';
  for (const Cut& cut : cuts())
    for (std::size_t range = 0; range < cut.names.size(); ++range) {
      std::map<std::string, int> count;
      int runs = 0;
      for (const StressResult& r : results)
        if (range_of(cut, cut.value(r.stress)) == range) {
          ++count[r.verdict.end];
          ++runs;
        }
      out << "| " << (range == 0 ? cut.name : "") << " | " << cut.names[range] << " | " << runs << " |";
      for (const std::string& end : ends) out << ' ' << count[end] << " |";
      out << '\n';
    }
}

void write_failures(std::ostream& out, const std::vector<StressResult>& results) {
  std::map<std::pair<std::string, std::string>, std::vector<const StressResult*>> groups;
  for (const StressResult& r : results)
    if (r.verdict.end != "valid" && r.verdict.end != "defect") groups[{r.verdict.end, r.verdict.phase}].push_back(&r);
  out << "| reason | phase | runs | a case | its message |\n|---|---|---:|---:|---|\n";
  for (const auto& [key, group] : groups)
    out << "| " << key.first << " | " << key.second << " | " << group.size() << " | " << group[0]->stress.number
        << " | " << group[0]->verdict.message << " |\n";
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1) + 0.5)];
}

void write_quantiles(std::ostream& out, const std::vector<StressResult>& results) {
  out << "| of valid runs | smallest | 5 % | median | 95 % | largest |\n|---|---:|---:|---:|---:|---:|\n";
  const auto row = [&](const char* name, const std::function<double(const StressVerdict&)>& value) {
    std::vector<double> values;
    for (const StressResult& r : results)
      if (r.verdict.end == "valid") values.push_back(value(r.verdict));
    out << "| " << name << " |";
    for (const double q : {0.0, 0.05, 0.5, 0.95, 1.0}) {
      char text[32];
      std::snprintf(text, sizeof text, " %.3g |", quantile(values, q));
      out << text;
    }
    out << '\n';
  };
  row("energy created over put in (negative: lost unexplained)", [](const StressVerdict& v) { return v.energy_error; });
  row("steps", [](const StressVerdict& v) { return static_cast<double>(v.steps); });
  row("simulated time [s]", [](const StressVerdict& v) { return v.simulated_s; });
  row("processor time [s]", [](const StressVerdict& v) { return v.cpu_s; });
  row("height after step 1 [mm]", [](const StressVerdict& v) { return v.height1_mm; });
  row("spread after step 1 [mm]", [](const StressVerdict& v) { return v.spread_mm; });
}

}  // namespace

void write_report(std::ostream& out, const std::vector<StressResult>& results) {
  std::map<std::string, int> count;
  int unsettled = 0;
  for (const StressResult& r : results) {
    ++count[r.verdict.end];
    if (r.verdict.end == "valid" && !r.verdict.settled) ++unsettled;
  }
  out << results.size() << " runs: ";
  for (const std::string& end : ends_of(results)) out << count[end] << ' ' << end << ", ";
  out << "of the valid " << unsettled << " not quite at rest at the end of the time allowed for it.\n\n";
  if (count["defect"] > 0) {
    out << "## Defects\n\n| case | what |\n|---:|---|\n";
    for (const StressResult& r : results)
      if (r.verdict.end == "defect") out << "| " << r.stress.number << " | " << r.verdict.message << " |\n";
    out << '\n';
  }
  out << "## By region\n\n";
  write_regions(out, results);
  out << "\n## Failures by reason and phase\n\n";
  write_failures(out, results);
  out << "\n## Energy, cost, readings\n\n";
  write_quantiles(out, results);
}

}  // namespace pastefit
