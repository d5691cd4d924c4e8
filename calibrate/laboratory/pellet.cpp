#include "calibrate/laboratory/pellet.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "calibrate/base/object_schema.h"
#include "calibrate/base/object_writer.h"
#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/laboratory/specimen_json.h"

namespace pastefit {
namespace {

constexpr std::string_view pellet_lab =
    R"(// What a laboratory measured in a pellet crush: wet granules are pressed in a die, and the pellet is crushed between two
// plates. Lines like this one are comments; the unit is in each key.
{
  "format": "pastefit-lab-1",
  "test": "pellet",
  "title": "my granules, batch 1",

  %provenance%

  "apparatus": {
    "die_diameter_mm": 25,
    "fill_height_mm": 29,       // granules are poured in and struck off at this height
    "pressed_height_mm": 22,    // of the bed when the punch turns round
    "punch_speed_mm_s": 1.5,
    "press_speedup": 50,        // the simulation presses so many times as fast as that, and waits for rest
    "platen_speed_mm_s": 100,
    "final_strain": 0.2         // of the pellet, at which the platen stops
    // How the granules arrive in the die decides how densely they lie: "pour_speed_mm_s": 1000
    // Polished steel, to which nothing sticks: "tools": {"friction": 0, "rolling_friction": 0, "restitution": 0.2, "cohesion_factor": 0}
  },

  // Of a granule, not of the bed: how much of the die the granules fill is a reading.
  "material": {"bulk_density_kg_m3": 1000},

  // Granules may be coarser than the laboratory's: forces keep their share of R^2. At least six across the pellet.
  "grains": {"distribution": "normal", "radius_mm": 1.05, "standard_deviation_mm": 0.315, "smallest_mm": 1.05, "largest_mm": 1.5},

  // Either value and standard deviation of one reading, or all repeats. The strength is the peak of force over the die's
  // area. Besides: die.mass_g, of the granules that fill the die; pellet.height_mm, when the die is away;
  // pellet.strain_at_peak.
  "measurements": {
    "pellet.dynamic_yield_strength_pa": {"value": 3000, "standard_deviation": 300}
  }
}
)";

constexpr std::string_view pellet_study =
    R"(// Which contact parameters are fitted to a pellet crush, and how. Lines like this one are comments.
{
  "format": "pastefit-study-1",
  "title": "surface energy of my granules",
  "lab": "lab.json",  // path as seen from this file

  // Granules that stick where they touch. More laws: `pastefit template study`.
  "contact": {"normal": "jkr", "attraction": "none", "rolling_model": "constant_torque", "friction_basis": "elastic"},

  // Free: [lower, upper] bounds. Fixed: a value. Parameters that are not named have their default value.
  "parameters": {
    "adhesion_pa": {"free": [800, 12000]},  // surface energy over R, the mean radius
    "friction": {"value": 0.4},
    "rolling_friction": {"value": 0.01},
    "restitution": {"value": 0.2},
    "youngs_modulus_pa": {"value": 2400000},
    "poissons_ratio": {"value": 0.2}
  },

  "search": {
    "screening": 6,              // candidates spread over the bounds at the start
    "budget_simulations": 40,    // in all, confirmation included
    "packings": 2,               // random packings of a candidate with coarse grains
    "confirmation_packings": 6,  // fresh packings for the best candidate
    "examination_simulations": 6,
    "tolerance_mm": 1,           // good enough, for heights; for a strength the laboratory's deviation
    "seed": 1
  }
}
)";

template <class Fields>
void describe_pellet_apparatus(Fields& apparatus, PelletCrush& test, Need need) {
  read_dimensions(apparatus, test, pellet_dimensions, need);
  read_tools(apparatus, "the surface of die, punch, platen and floor", test.tools);
}

template <class Fields, class Test>
void describe_pellet(Fields& fields, Test& test) {
  describe_dimensions(fields, test, pellet_dimensions);
  describe_specimen(fields, test);
  fields.object({"tools", "surface of all tools"}, required, [&](auto& wall) { describe_wall(wall, test.tools); });
}

}  // namespace

std::vector<FilePlace> places_in_files(const PelletCrush&) {
  std::vector<FilePlace> places;
  add_places(places, pellet_dimensions);
  add_places(places, surface_dimensions, "tools", "apparatus.tools");
  return places;
}

double moved_time_s(const PelletCrush& test) {
  return (test.fill_height_m - test.pressed_height_m) / (test.punch_speed_m_s * test.press_speedup) +
         test.final_strain * test.pressed_height_m / test.platen_speed_m_s;
}

void read_apparatus(ObjectReader& apparatus, PelletCrush& test, Need need) {
  describe_pellet_apparatus(apparatus, test, need);
}

void tell_apparatus(ObjectSchema& schema, PelletCrush any, Need need) {
  describe_pellet_apparatus(schema, any, need);
}

nlohmann::json to_json(const PelletCrush& test) {
  nlohmann::json document;
  ObjectWriter writer(document);
  describe_pellet(writer, test);
  return document;
}

PelletCrush default_test(const PelletCrush&) {
  return {};
}

void read_test(ObjectReader& reader, PelletCrush& test) {
  describe_pellet(reader, test);
}

void tell_schema(ObjectSchema& schema, PelletCrush any) {
  describe_pellet(schema, any);
}

Templates templates_of(const PelletCrush&) {
  return {pellet_lab, pellet_study};
}

nlohmann::ordered_json conditions_of(const PelletCrush& test) {
  return {{"pressed_share", test.pressed_height_m / test.fill_height_m},
          {"platen_speed_m_s", test.platen_speed_m_s},
          {"press_speedup", test.press_speedup}};
}

std::string conditions_in_words(const PelletCrush& test) {
  return format(
             "  die                      %g mm across, filled to %g mm, pressed to %g mm at %g mm/s (simulated %g "
             "times "
             "as fast)\n",
             mm * test.die_diameter_m, mm * test.fill_height_m, mm * test.pressed_height_m, mm * test.punch_speed_m_s,
             test.press_speedup) +
         format("  platen                   %g mm/s\n", mm * test.platen_speed_m_s);
}

std::string remarks_on(const PelletCrush& test, std::span<const Readings> runs) {
  constexpr double close = 0.95;
  const auto rising = std::ranges::count_if(runs, [&](const Readings& run) {
    return run.find("pellet.strain_at_peak").value_or(0) > close * test.final_strain;
  });
  if (rising == 0) return {};
  return format("the stress of %d of %zu pellets still rose at the final strain of %g: their strength is not a peak",
                static_cast<int>(rising), runs.size(), test.final_strain);
}

std::vector<Drawing> drawings_of(const PelletCrush& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured) {
  Drawing drawing = drawing_of_curves("Crushing of the pellet", "strain", "stress [Pa]", runs);
  if (const auto* strength = find_measurement(measured, "pellet.dynamic_yield_strength_pa")) {
    drawing.lines.push_back({"laboratory, strength",
                             DrawnBy::laboratory,
                             {{0, strength->value}, {test.final_strain, strength->value}},
                             strength->standard_deviation});
    if (const auto* peak = find_measurement(measured, "pellet.strain_at_peak"))
      drawing.lines.push_back({"laboratory, strain at the peak",
                               DrawnBy::laboratory,
                               {{peak->value, 0}, {peak->value, strength->value}},
                               0});
  }
  return {drawing};
}

}  // namespace pastefit
