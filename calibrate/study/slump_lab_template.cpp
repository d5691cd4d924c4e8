#include <sstream>
#include <vector>

#include "calibrate/base/embedded_text.h"
#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/laboratory/slump.h"
#include "calibrate/study/apparatus.h"
#include "calibrate/study/slump_sheet.h"

namespace pastefit {
namespace {

std::string reading_line(const Measurement& one, bool last) {
  return "\"" + one.reading + "\": {\"value\": " + shown(one.value) +
         ", \"standard_deviation\": " + shown(one.standard_deviation) + "}" + (last ? "" : ",");
}

/// Assumed readings of a slump test: half of the height remains, in a shape between paraboloid and cone.
std::vector<Measurement> usual_readings(const SlumpTest& test) {
  constexpr double left = 0.5, cones = 0.85;
  const double height_mm = left * mm * test.mould.height_m;
  std::vector<Measurement> out{{"step1.height_mm", height_mm},
                               {"step1.spread_mm", cones * cone_width_mm(test, height_mm)}};
  const auto own_kinds = reading_kinds(test);
  for (Measurement& one : out) {
    one.value = rounded(one.value, 2);
    for (const ReadingKind& kind : own_kinds)
      if (kind.key == one.reading) one.standard_deviation = rounded(kind.published_deviation, 2);
  }
  return out;
}

std::string plate_line(const SlumpTest& test) {
  if (!test.drop) return "// \"drop_plate\": null,  // nothing drops this table";
  const DropPlate& plate = *test.drop;
  std::string line = "// \"drop_plate\": {";
  if (plate.motion == TableMotion::vertical) line += "\"motion\": \"vertical\", ";
  line += "\"length_mm\": " + shown(mm * plate.length_m) + ", \"mass_kg\": " + shown(plate.mass_kg) +
          ", \"lift_height_mm\": " + shown(mm * plate.lift_height_m);
  return line + ", \"drops\": " + std::to_string(plate.drops) + ", \"period_s\": " + shown(plate.period_s) + "},";
}

std::string grains_line(const GrainSizes& grains) {
  const bool mono = grains.distribution == SizeDistribution::mono;
  // +- 25 %: equal spheres form layers and shear off along them.
  const double smallest = mono ? 0.75 * grains.radius_m : grains.smallest_m;
  const double largest = mono ? 1.25 * grains.radius_m : grains.largest_m;
  return "\"grains\": {\"distribution\": \"uniform\", \"smallest_mm\": " + shown(mm * smallest) +
         ", \"largest_mm\": " + shown(mm * largest) + "},";
}

void fill_in(std::string& lab, const std::string& name, const Apparatus& preset) {
  const SlumpTest& test = std::get<SlumpTest>(preset.test);
  constexpr std::size_t width = 116;
  std::vector<std::string> told;
  const auto tell = [&](const std::string& sentence) {
    std::istringstream lines_of_it(wrapped(sentence, width));
    for (std::string line; std::getline(lines_of_it, line);) told.push_back("// " + line);
  };
  tell(preset.title + ". The preset brings its table, speed and grains: give what differs from it.");
  if (!preset.caution.empty()) tell("Note: " + preset.caution + ".");
  replace_lines(lab, "// Give only what differs", told, 2);
  replace_lines(lab, "\"preset\":", {"\"preset\": \"" + name + "\","});
  replace_lines(lab, "// \"mould\":",
                {"// \"mould\": {\"base_diameter_mm\": " + shown(2 * mm * test.mould.base_radius_m) +
                 ", \"top_diameter_mm\": " + shown(2 * mm * test.mould.top_radius_m) +
                 ", \"height_mm\": " + shown(mm * test.mould.height_m) + "},"});
  replace_lines(lab, "// \"table_length_mm\":", {"// \"table_length_mm\": " + shown(mm * test.table_length_m) + ","});
  replace_lines(lab, "// \"drop_plate\":", {plate_line(test)});
  const bool axis = test.reading.height == HeightReading::axis;
  replace_lines(lab, "// \"reading\":",
                {"// \"reading\": {\"height\": \"" + std::string(axis ? "axis" : "highest") +
                 "\", \"probe_diameter_mm\": " + shown(mm * test.reading.probe_diameter_m) +
                 "},  // axis, or highest: the highest point of the heap"});
  replace_lines(lab, "\"lift_velocity_mm_s\":", {"\"lift_velocity_mm_s\": " + shown(mm * test.lift_velocity_m_s)});
  replace_lines(lab,
                "\"material\":", {"\"material\": {\"bulk_density_kg_m3\": " + shown(test.bulk_density_kg_m3) + "},"});
  replace_lines(lab, "// Equal spheres,", {}, 2);  // examples for a tall cone
  replace_lines(lab, "\"grains\":", {grains_line(test.grains)});
  const auto readings = preset.readings.empty() ? usual_readings(test) : preset.readings;
  std::vector<std::string> measured;
  for (const Measurement& one : readings) measured.push_back(reading_line(one, &one == &readings.back()));
  replace_lines(lab, "\"step1.slump_mm\":", measured, 2);
}

}  // namespace

Result<std::string> slump_lab_template(const std::string& name, const std::filesystem::path& folder) {
  const Result<Apparatus> preset = find_preset(name, folder);
  if (!preset.ok()) return preset.faults();
  if (!std::holds_alternative<SlumpTest>(preset.value().test))
    return Fault{"apparatus.preset", in_quotes(name) + " is an apparatus for another test", "name one with a mould"};
  std::string lab = template_text("lab").value();
  fill_in(lab, name, preset.value());
  return lab;
}

}  // namespace pastefit
