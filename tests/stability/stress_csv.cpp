#include "tests/stability/stress_csv.h"

#include <istream>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

namespace pastefit {

namespace {

// Columns after the inputs; the message comes last, in quotes, because it may hold commas.
constexpr int kVerdictColumns = 11;

std::vector<std::string> fields_of(const std::string& row) {
  std::vector<std::string> fields;
  std::istringstream in(row);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

}  // namespace

void write_csv_head(std::ostream& csv, const StressCase& any) {
  csv << "case";
  for (const auto& [name, value] : inputs_of(any)) csv << ',' << name;
  csv << ",end,phase,particles,steps,simulated_s,cpu_s,energy_error,settled,height1_mm,height2_mm,spread_mm,message\n";
}

void write_csv_row(std::ostream& csv, const StressResult& r) {
  const StressVerdict& v = r.verdict;
  csv << r.stress.number;
  for (const auto& [name, value] : inputs_of(r.stress)) csv << ',' << value;
  csv << ',' << v.end << ',' << v.phase << ',' << v.particles << ',' << v.steps << ',' << v.simulated_s << ','
      << v.cpu_s << ',' << v.energy_error << ',' << v.settled << ',' << v.height1_mm << ',' << v.height2_mm << ','
      << v.spread_mm << ",\"" << v.message << "\"\n"
      << std::flush;
}

std::map<int, StressVerdict> read_csv(std::istream& csv) {
  std::map<int, StressVerdict> verdicts;
  std::string row;
  std::getline(csv, row);
  while (std::getline(csv, row)) {
    const std::size_t quote = row.find(",\"");
    if (quote == std::string::npos || row.back() != '"') continue;
    const std::vector<std::string> fields = fields_of(row.substr(0, quote));
    if (fields.size() <= kVerdictColumns) continue;
    const std::string* field = &fields[fields.size() - kVerdictColumns];
    StressVerdict v;
    v.end = field[0];
    v.phase = field[1];
    v.particles = std::stoll(field[2]);
    v.steps = std::stoll(field[3]);
    v.simulated_s = std::stod(field[4]);
    v.cpu_s = std::stod(field[5]);
    v.energy_error = std::stod(field[6]);
    v.settled = field[7] == "1";
    v.height1_mm = std::stod(field[8]);
    v.height2_mm = std::stod(field[9]);
    v.spread_mm = std::stod(field[10]);
    v.message = row.substr(quote + 2, row.size() - quote - 3);
    verdicts[std::stoi(fields[0])] = v;
  }
  return verdicts;
}

}  // namespace pastefit
