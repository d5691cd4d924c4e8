#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "calibrate/base/statistics.h"
#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/laboratory/slump.h"

namespace pastefit {
namespace {

constexpr double pancake = 0.57735026918962576;  // 1/sqrt(3)
constexpr double paraboloid = 0.81649658092772603;
constexpr double explained = 2, sure = 3;  // in standard deviations

double error_of(const Measurement& one) {
  return one.standard_deviation / std::sqrt(one.repeats);
}

/// The first of these readings with a measurement.
const Measurement* first_of(std::span<const Measurement> measurements, std::initializer_list<std::string> names) {
  for (const std::string& name : names)
    if (const Measurement* one = find_measurement(measurements, name)) return one;
  return nullptr;
}

struct Heap {
  const Measurement& height;
  const Measurement& width;
};

double share_of_cone_width(const SlumpTest& test, const Heap& heap) {
  return heap.width.value / cone_width_mm(test, heap.height.value);
}

double deviation_of_share(const SlumpTest& test, const Heap& heap) {
  return share_of_cone_width(test, heap) *
         std::hypot(error_of(heap.width) / heap.width.value, 0.5 * error_of(heap.height) / heap.height.value);
}

/// Height of the cone closest to the readings, in their deviations; by bisection of the slope. Requirement: the
/// readings are wider than a cone.
double nearest_cone_mm(const SlumpTest& test, const Heap& heap) {
  const Measurement &height = heap.height, &width = heap.width;
  const auto falls = [&](double at_mm) {
    const double cone_mm = cone_width_mm(test, at_mm);
    return !((at_mm - height.value) / std::pow(error_of(height), 2) >
             (cone_mm - width.value) * cone_mm / (2 * at_mm) / std::pow(error_of(width), 2));
  };
  // Either end matches one reading exactly.
  return bisected(height.value / std::pow(share_of_cone_width(test, heap), 2), height.value, falls);
}

/// Width of the narrowest heap of this height, a flat cylinder.
double narrowest_mm(const SlumpTest& test, double height_mm) {
  return pancake * cone_width_mm(test, height_mm);
}

/// Likely mistakes in the readings of a heap that is too narrow: "; a radius of 236 mm, given as a width, is a width of
/// 472 mm". May be empty.
std::string slips_of(const SlumpTest& test, const Heap& heap) {
  constexpr double widest = 1.15;  // over the cone's width, for skirts
  const double mould_mm = 1e3 * test.mould.height_m, other_mm = mould_mm - heap.height.value;
  const double share = share_of_cone_width(test, heap);
  const auto is_heap = [](double one) { return one >= pancake && one <= widest; };
  std::string out;
  if (is_heap(2 * share))
    out += format("; if %.4g mm is a radius, the width is %.4g mm", heap.width.value, 2 * heap.width.value);
  if (other_mm > 0 && is_heap(heap.width.value / cone_width_mm(test, other_mm)))
    out += format("; if %.4g mm is a slump, the height is %.4g mm", heap.height.value, other_mm);
  return out;
}

/// Notes the shape; an unusual one is a doubt.
void check_shape(const SlumpTest& test, const Heap& heap, const std::string& when, ReadingCheck& check) {
  const double share = share_of_cone_width(test, heap), deviation = deviation_of_share(test, heap);
  const std::string size = format("%.4g mm high and %.4g mm wide (%.2f +- %.2f of a cone's width)", heap.height.value,
                                  heap.width.value, share, deviation);
  if (share > 1 + explained * deviation) {
    const double height_mm = nearest_cone_mm(test, heap);
    check.doubts.push_back(
        when + "no convex heap of this volume is " + size +
        ": check the readings, or the heap has a peak on a skirt; a cone, the nearest that can be, is " +
        format("%.4g mm high and %.4g mm wide", height_mm, cone_width_mm(test, height_mm)));
  } else if (share < pancake) {
    check.doubts.push_back(
        when + "check the readings: no heap of this volume is " + size +
        format("; the narrowest, a flat cylinder, is %.4g mm wide", narrowest_mm(test, heap.height.value)) +
        slips_of(test, heap));
  } else {
    check.notes.push_back(when + "a heap of this volume " + size + " is " +
                          (share > 1            ? "wider than a cone, by no more than the readings' noise"
                           : share < paraboloid ? "between a flat cylinder and a paraboloid"
                                                : "between a paraboloid and a cone"));
  }
}

/// Largest width of a peak on a skirt, over the cone's width; beyond it, no volume is left.
constexpr double widest_skirt = 1.5;

/// Fault of a height and a width that cannot belong to one heap.
Fault contradiction(const SlumpTest& test, const Heap& heap) {
  const bool wide = share_of_cone_width(test, heap) > 1;
  const std::string why = wide ? "the mould holds too little for it; a cone of this height, the widest"
                               : "what the mould holds does not fit in; a flat cylinder of this height, the narrowest";
  const double extreme_mm = wide ? cone_width_mm(test, heap.height.value) : narrowest_mm(test, heap.height.value);
  return {"measurements",
          heap.height.reading + format(" (%.4g) contradicts ", heap.height.value) + heap.width.reading +
              format(" (%.4g): ", heap.width.value) + why + format(" heap, is %.4g mm wide", extreme_mm) +
              slips_of(test, heap),
          std::string("look for a slump that was given as a height, for a ") +
              (wide ? "reading of another test" : "radius that was given as a width") + ", and at the mould"};
}

/// Note on a very small slump, which may be in inches or centimetres.
std::string small_slump(const SlumpTest& test, const Measurement& height) {
  constexpr double small = 0.08;  // of the mould's height
  const double mould_mm = 1e3 * test.mould.height_m, slump_mm = mould_mm - height.value;
  if (slump_mm <= 0 || slump_mm > small * mould_mm) return "";
  const std::string others = in_other_units(slump_mm, "mm", 0, mould_mm);
  return others.empty() ? "" : format("a slump of %.4g mm hardly is one; look at its unit: ", slump_mm) + others;
}

/// Checks the mass in the mould against the density.
void check_mass(const SlumpTest& test, std::span<const Measurement> measurements, ReadingCheck& check) {
  constexpr double differs = 0.1;
  const Measurement* mass = first_of(measurements, {"fill.mass_kg"});
  if (!mass) return;
  const double volume = volume_m3(test.mould), full_kg = test.bulk_density_kg_m3 * volume;
  if (std::abs(mass->value - full_kg) <= std::max(differs * full_kg, sure * error_of(*mass))) return;
  check.faults.push_back(
      {"measurements.fill.mass_kg",
       format("is %.4g kg, but the mould of %.3g l holds %.4g kg at material.bulk_density_kg_m3 %.4g", mass->value,
              1e3 * volume, full_kg, test.bulk_density_kg_m3),
       format("one of both is wrong: the mass would be a density of %.4g kg/m3", mass->value / volume)});
}

/// Reports angles that are probably in radians.
void check_angle(std::span<const Measurement> measurements, ReadingCheck& check) {
  constexpr double least_deg = 3, most_rad = 1.6;
  const Measurement* angle = first_of(measurements, {"step1.angle_of_repose_deg"});
  if (!angle || angle->value >= least_deg) return;
  check.faults.push_back({"measurements.step1.angle_of_repose_deg",
                          format("is %.3g degrees, flatter than any heap", angle->value),
                          angle->value <= most_rad ? "look at its unit: " + in_other_units(angle->value, "deg", 0, 90)
                                                   : "an angle of repose in degrees"});
}

/// Reports a time to a width that the final heap does not reach.
void check_time(const SlumpTest& test, std::span<const Measurement> measurements, ReadingCheck& check) {
  const Measurement* time = first_of(measurements, {"step1.t500_s"});
  const Measurement* width = first_of(measurements, {"step1.spread_mm", "step1.spread_orthogonal_mm"});
  const double circle_mm = test.reading.flow ? mm * test.reading.flow->diameter_m : 0;
  if (!time || !width || width->value + error_of(*width) >= circle_mm) return;
  check.faults.push_back({"measurements",
                          time->reading + format(" (%.4g) contradicts ", time->value) + width->reading +
                              format(" (%.4g): this heap is never %.4g mm wide", width->value, circle_mm),
                          "leave out the time, or look for a misread width, of the heap or of the time "
                          "(apparatus.reading.flow.diameter_mm)"});
}

/// Notes on a flow in per cent taken for a width, and on readings after only the first of several drops.
void check_flow(const SlumpTest& test, std::span<const Measurement> measurements, ReadingCheck& check) {
  const Measurement* flow = first_of(measurements, {"after_drops.spread_mm"});
  const double meant_mm = flow ? width_of_flow_mm(test, flow->value) : 0;
  if (flow && gives_flow_in_percent(test) && meant_mm <= mm * test.table_length_m)
    check.doubts.push_back(
        format("after_drops.spread_mm is taken for a width, %.4g mm; a flow of %.4g %% is a width of %.4g mm",
               flow->value, flow->value, meant_mm));
  for (const Measurement& one : measurements)
    if (!flow && test.drop && test.drop->drops > 1 && one.reading.starts_with("step2."))
      check.doubts.push_back(one.reading +
                             format(" is of the heap after the first of %d drops; the width after all of them is "
                                    "after_drops.spread_mm (--flow of pastefit new)",
                                    test.drop->drops));
}

/// Note on cakes with a thickness of few grains, which the grain size determines.
void check_cake(const SlumpTest& test, const Measurement& width, ReadingCheck& check) {
  constexpr double grains_thick = 1.5;
  const double cake_mm = 4e9 * volume_m3(test.mould) / (std::numbers::pi * width.value * width.value);
  const double grain_mm = 2e3 * std::max(test.grains.radius_m, test.grains.largest_m);
  if (cake_mm >= grains_thick * grain_mm) return;
  check.doubts.push_back(
      format("a heap %.4g mm wide is %.2g mm thick on the average, and the grains are up to %.2g mm: "
             "take grains of %.2g mm radius or less",
             width.value, cake_mm, grain_mm, 0.5 * cake_mm / grains_thick));
}

}  // namespace

double cone_width_mm(const SlumpTest& test, double height_mm) {
  return 2 * std::sqrt(3e9 * volume_m3(test.mould) / (std::numbers::pi * height_mm));
}

bool gives_flow_in_percent(const SlumpTest& test) {
  constexpr double drop_mm = 12.7;
  return test.drop && test.drop->motion == TableMotion::vertical &&
         std::abs(mm * test.drop->lift_height_m - drop_mm) < 0.1;
}

ReadingCheck check_readings(const SlumpTest& test, std::span<const Measurement> measurements) {
  ReadingCheck check;
  check_curves(test, check);
  check_mass(test, measurements, check);
  check_angle(measurements, check);
  check_time(test, measurements, check);
  check_flow(test, measurements, check);
  for (const std::string step : {"step1.", "step2.", "after_drops."}) {
    const Measurement* height =
        first_of(measurements, {step + "height_max_mm", step + "height_mm", step + "height_axis_mm"});
    const Measurement* width = first_of(measurements, {step + "spread_mm", step + "spread_orthogonal_mm"});
    if (height)
      if (std::string note = small_slump(test, *height); !note.empty()) check.doubts.push_back(std::move(note));
    if (width && width->value > 0) check_cake(test, *width, check);
    if (!height || !width || height->value <= 0) continue;
    const Heap heap{*height, *width};
    const double share = share_of_cone_width(test, heap), margin = sure * deviation_of_share(test, heap);
    if (share < pancake - margin || share > widest_skirt + margin)
      check.faults.push_back(contradiction(test, heap));
    else
      check_shape(test, heap,
                  step == "step1."   ? ""
                  : step == "step2." ? "after the drop, "
                                     : "after all drops, ",
                  check);
  }
  return check;
}

}  // namespace pastefit
