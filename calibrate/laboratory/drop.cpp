#include "calibrate/laboratory/drop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "calibrate/base/object_schema.h"
#include "calibrate/base/object_writer.h"
#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/laboratory/specimen_json.h"
#include "core/world/world.h"

namespace pastefit {
namespace {

constexpr std::string_view drop_lab =
    R"(// What a laboratory measured in a drop test: a ball of the material falls on a plate. Lines like this one are comments;
// the unit is in each key.
{
  "format": "pastefit-lab-1",
  "test": "drop",
  "title": "my gravel, batch 1",

  %provenance%

  // The plate is of the ball's material: a slab of it, or grains of it cast in and ground flat.
  "apparatus": {
    "drop_height_mm": 500,  // the ball falls so far until it touches the plate
    "plate_tilt_deg": 40    // in a second series of drops; leave it out if there is none
  },

  // Of the ball: there is nothing between grains.
  "material": {"bulk_density_kg_m3": 2650},

  // The ball: one grain. Others of its size, or nearly so, are the repeats.
  "grains": {"distribution": "mono", "radius_mm": 10},

  // Either value and standard deviation of one reading, or all repeats. Heights: the highest rise of the ball above where
  // it touched. Spin: after it left the plate. It tells the friction if the ball slides throughout the contact, as it does
  // where the tangent of the tilt is above 3.5 friction (1 + restitution); a ball that sticks may spin as much.
  "measurements": {
    "level.rebound_height_mm": {"repeats": [311, 324, 330, 318], "standard_deviation": 5},
    "tilted.rebound_height_mm": {"repeats": [8, 10, 7]},
    "tilted.spin_rad_s": {"value": 86, "standard_deviation": 4}
  }
}
)";

constexpr std::string_view drop_study =
    R"(// Which contact parameters are fitted to a drop test, and how. Lines like this one are comments.
{
  "format": "pastefit-study-1",
  "title": "restitution and friction of my gravel",
  "lab": "lab.json",  // path as seen from this file

  // A dry ball. The attraction of wet ones: as in the study of a slump test, `pastefit template study`.
  "contact": {"attraction": "none"},

  // Free: [lower, upper] bounds. Fixed: a value. Parameters that are not named have their default value.
  "parameters": {
    "restitution": {"free": [0.3, 1]},
    "friction": {"free": [0.02, 0.5]},
    "rolling_friction": {"value": 0},
    "youngs_modulus_pa": {"value": 5e10}
  },

  "search": {
    "screening": 8,              // candidates spread over the bounds at the start
    "budget_simulations": 300,   // in all, confirmation included; one takes milliseconds
    "packings": 1,               // nothing in this test is random
    "confirmation_packings": 2,
    "examination_simulations": 40,
    "tolerance_mm": 5,           // good enough, for heights; for a spin the laboratory's deviation
    "seed": 1
  }
}
)";

template <class Fields>
void describe_drop_apparatus(Fields& apparatus, DropTest& test, Need need) {
  read_dimensions(apparatus, test, drop_dimensions, need);
}

template <class Fields, class Test>
void describe_drop(Fields& fields, Test& test) {
  describe_dimensions(fields, test, drop_dimensions);
  describe_specimen(fields, test);
}

/// Half of a free flight that ends at `end_s`: from the top to touch (`half_s` < 0), or from touch to the top.
std::vector<DrawnPoint> flight(double height_m, double end_s, double half_s) {
  constexpr int kPoints = 40;
  std::vector<DrawnPoint> points;
  for (int k = 0; k <= kPoints; ++k) {
    const double share = static_cast<double>(k) / kPoints;   // of the way in time
    const double from_top = half_s < 0 ? share : 1 - share;  // in units of the half
    points.push_back({end_s - std::abs(half_s) * (1 - share), mm * height_m * (1 - from_top * from_top)});
  }
  return points;
}

}  // namespace

std::vector<Surface> surfaces_of(DropTest&) {
  return {};
}

double grains_needed(const DropTest&) {
  return 1;
}

std::vector<FilePlace> places_in_files(const DropTest&) {
  std::vector<FilePlace> places;
  add_places(places, drop_dimensions);
  return places;
}

void read_apparatus(ObjectReader& apparatus, DropTest& test, Need need) {
  describe_drop_apparatus(apparatus, test, need);
}

void tell_apparatus(ObjectSchema& schema, DropTest any, Need need) {
  describe_drop_apparatus(schema, any, need);
}

nlohmann::json to_json(const DropTest& test) {
  nlohmann::json document;
  ObjectWriter writer(document);
  describe_drop(writer, test);
  return document;
}

DropTest default_test(const DropTest&) {
  DropTest test;
  test.plate_tilt_rad = 0.5;
  return test;
}

void read_test(ObjectReader& reader, DropTest& test) {
  describe_drop(reader, test);
}

void tell_schema(ObjectSchema& schema, DropTest any) {
  describe_drop(schema, any);
}

Templates templates_of(const DropTest&) {
  return {drop_lab, drop_study};
}

std::optional<double> grain_density_of(const DropTest& test, const Readings&) {
  return test.bulk_density_kg_m3;
}

std::string_view why_of_that_size(const DropTest&) {
  return "the ball of a drop test is one grain, as large as the laboratory's";
}

nlohmann::ordered_json conditions_of(const DropTest& test) {
  return {{"drop_height_m", test.drop_height_m}, {"impact_speed_m_s", impact_speed_m_s(test)}};
}

std::string conditions_in_words(const DropTest& test) {
  std::string out = format("  drop                     from %g mm, %.3g m/s at touch", mm * test.drop_height_m,
                           impact_speed_m_s(test));
  if (test.plate_tilt_rad > 0)
    out += format(", on a level plate and on one tilted by %g deg", degrees * test.plate_tilt_rad);
  return out + "\n";
}

std::vector<Drawing> drawings_of(const DropTest& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured) {
  std::vector<Drawing> out;
  for (const std::string stage : {"level", "tilted"}) {
    if (stage == "tilted" && test.plate_tilt_rad == 0) continue;
    const std::string reading = stage + ".rebound_height_mm";
    Drawing drawing;
    drawing.name = stage == "level" ? "Drop on the level plate"
                                    : format("Drop on the plate tilted by %.3g degrees", degrees * test.plate_tilt_rad);
    drawing.x = "time [s]";
    drawing.y = "height of the ball above touch [mm]";
    const double touch_s = std::sqrt(2 * test.drop_height_m / kGravity);
    drawing.lines.push_back({"fall", DrawnBy::apparatus, flight(test.drop_height_m, touch_s, -touch_s)});
    const auto rebound = [&](DrawnBy by, const char* name, double height_mm, double deviation) {
      const double rise_s = std::sqrt(2 * std::max(height_mm, 0.0) / mm / kGravity);
      drawing.lines.push_back({name, by, flight(height_mm / mm, touch_s + rise_s, rise_s), 0});
      const double top_s = touch_s + rise_s;
      const double beside_s = top_s * (by == DrawnBy::laboratory ? 1.06 : 1.14);  // one beside the other
      drawing.lengths.push_back(
          {reading, by, {beside_s, 0}, {beside_s, height_mm}, {top_s, 0}, {top_s, height_mm}, height_mm, deviation});
    };
    if (const Measurement* one = find_measurement(measured, reading))
      rebound(DrawnBy::laboratory, "rebound, laboratory", one->value, one->standard_deviation);
    if (const auto mean = mean_reading(runs, reading)) rebound(DrawnBy::simulation, "rebound, simulated", *mean, 0);
    out.push_back(std::move(drawing));
  }
  return out;
}

}  // namespace pastefit
