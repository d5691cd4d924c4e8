#include "tests/bench/ladder_csv.h"

#include <istream>
#include <ostream>
#include <sstream>

namespace pastefit {

namespace {

std::string key_of(const Setting& setting) {
  std::ostringstream key;
  key << setting.scene << ',' << setting.ladder << ",\"" << setting.name << "\"," << 1e3 * setting.radius_m << ',';
  return key.str();
}

}  // namespace

void write_csv(std::ostream& csv, const std::vector<Row>& rows) {
  csv << "scene,ladder,setting,radius_mm,packing_seed,time_step_s,cpu_s,energy_error,failure";
  for (const char* name : kReadings) csv << ',' << name;
  csv << '\n';
  for (const Row& row : rows)
    for (const Run& run : row.runs) {
      csv << key_of(row.setting) << run.packing_seed << ',' << run.time_step_s << ',' << run.cpu_s << ','
          << run.energy_error << ',' << run.failure;
      for (std::size_t k = 0; k < kReadings.size(); ++k) {
        csv << ',';
        if (run.readings) csv << (*run.readings)[k];
      }
      csv << '\n';
    }
}

std::vector<Run> read_csv(std::istream& csv, const Setting& setting) {
  const std::string key = key_of(setting);
  std::vector<Run> runs;
  for (std::string line; std::getline(csv, line);) {
    if (!line.starts_with(key)) continue;
    std::istringstream in(line.substr(key.size()));
    std::vector<std::string> fields;
    for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
    if (fields.size() < 5) continue;
    Run run{std::stoull(fields[0]), {}, fields[4], std::stod(fields[1]), std::stod(fields[2]), std::stod(fields[3])};
    if (run.failure.empty() && fields.size() == 5 + kReadings.size()) {
      run.readings.emplace();
      for (std::size_t k = 0; k < kReadings.size(); ++k) (*run.readings)[k] = std::stod(fields[5 + k]);
    }
    if (static_cast<int>(runs.size()) < setting.packings) runs.push_back(run);
  }
  return runs;
}

}  // namespace pastefit
