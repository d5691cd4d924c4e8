#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/laboratory/slump.h"
#include "calibrate/laboratory/test.h"

namespace pastefit {

namespace {

constexpr double kStep = 2;  // [mm] between two points of an outline
// Distances of dimension lines [share of the mould's height], below the table and beside the heap.
constexpr double kBelow = 0.09, kBeside = 0.12;

/// Drawing of the heap after one step, with its readings.
class HeapDrawing {
 public:
  HeapDrawing(const SlumpTest& test, std::string step, std::span<const SeenRun> runs,
              std::span<const Measurement> measured)
      : test_(test), step_(std::move(step)), accepted_(accepted(test, runs)), measured_(measured) {
    for (const SeenRun& run : runs)
      if (const auto seen = run.outlines.find(step_); seen != run.outlines.end())
        outlines_.push_back({&seen->second, run.packing,
                             std::ranges::find(accepted_, run.packing, &SeenRun::packing) != accepted_.end(),
                             is_rejected(test, run.readings)});
    half_width_ = diameter_at_base() / 2;
    for (const Seen& seen : outlines_) {
      const Outline& outline = *seen.outline;
      const double end = outline.first_x_m + outline.spacing_m * static_cast<double>(outline.height_m.size());
      half_width_ = std::max({half_width_, -mm * outline.first_x_m, mm * end});
    }
  }

  Drawing drawn() {
    const std::string after = step_ == "after_drops" ? "all drops" : "step " + step_.substr(4);
    drawing_.name = "Heap after " + after + ", seen from the side";
    drawing_.x = "from the middle of the table [mm]";
    drawing_.y = "height [mm]";
    drawing_.to_scale = true;
    draw_apparatus();
    draw_simulations();
    draw_measured_outline();
    draw_heights();
    draw_widths();
    draw_top();
    draw_flanks();
    return drawing_;
  }

 private:
  double diameter_at_base() const { return 2 * mm * test_.mould.base_radius_m; }
  double rim() const { return mm * test_.mould.height_m; }

  void draw_apparatus() {
    const double base = mm * test_.mould.base_radius_m, top = mm * test_.mould.top_radius_m;
    drawing_.lines.push_back({"mould", DrawnBy::apparatus, {{-base, 0}, {-top, rim()}, {top, rim()}, {base, 0}}});
    const double table = std::min(mm * test_.table_length_m / 2, 1.25 * half_width_);
    drawing_.lines.push_back({"table", DrawnBy::apparatus, {{-table, 0}, {table, 0}}});
  }

  /// Draws every heap, and the mean of the accepted ones.
  void draw_simulations() {
    if (outlines_.empty()) return;
    for (const Seen& seen : outlines_) {
      DrawnLine line{seen.sheared ? "sheared off: a laboratory would repeat the test" : "simulated, each heap",
                     seen.sheared ? DrawnBy::rejected : DrawnBy::run,
                     {}};
      line.packing = seen.packing;
      for (double x = -half_width_; x <= half_width_; x += kStep)
        line.points.push_back({x, mm * seen.outline->at(x / mm)});
      drawing_.lines.push_back(std::move(line));
    }
    if (std::ranges::none_of(outlines_, &Seen::accepted)) return;
    DrawnLine mean{"simulated, mean", DrawnBy::simulation, {}};
    for (double x = -half_width_; x <= half_width_; x += kStep) mean.points.push_back({x, mean_height_at(x)});
    drawing_.lines.push_back(std::move(mean));
  }

  void draw_measured_outline() {
    if (step_ == "after_drops") return;
    const auto& points = step_ == "step1" ? test_.reading.outline_step1 : test_.reading.outline_step2;
    DrawnLine line{"laboratory, outline", DrawnBy::laboratory, {}};
    for (const auto& [x, z] : points) line.points.push_back({mm * x, mm * z});
    if (points.empty()) return;
    if (const Measurement* known = measurement("profile_mm")) line.deviation = known->standard_deviation;
    drawing_.lines.push_back(std::move(line));
  }

  /// Draws heights at both sides of the heap, measured ones on the left.
  void draw_heights() {
    double beside = 1.1 * half_width_;
    for (const char* name : {"height_mm", "height_axis_mm", "height_max_mm"}) {
      if (!measurement(name)) continue;
      each_value(name, [&](DrawnBy by, double value, double deviation) {
        const double x = by == DrawnBy::laboratory ? -beside : beside;
        add(name, by, {x, 0}, {x, value}, {0, 0}, {0, value}, value, deviation);
      });
      beside += kBeside * rim();
    }
  }

  /// Draws widths below the table, measured ones above simulated ones.
  void draw_widths() {
    double z = 0;
    for (const char* name : {"spread_mm", "spread_orthogonal_mm"}) {
      each_value(name, [&](DrawnBy by, double value, double deviation) {
        z -= kBelow * rim();
        add(name, by, {-value / 2, z}, {value / 2, z}, {-value / 2, 0}, {value / 2, 0}, value, deviation);
      });
    }
  }

  /// Draws the sag of the plateau over its window, and its width at 0.8 of the height of the middle.
  void draw_top() {
    const double window = mm * test_.reading.sag_window_m;
    each_value("plateau_sag_mm", [&](DrawnBy by, double sag, double deviation) {
      const double height = mean_of_runs("height_mm").value_or(0);
      const char* whose = by == DrawnBy::laboratory ? "laboratory" : "simulated";
      drawing_.lines.push_back({std::string(whose) + format(", top sags by %.1f mm over %g mm", sag, window),
                                by,
                                {{-window / 2, height + sag / 2}, {window / 2, height - sag / 2}},
                                deviation});
    });
    each_value("plateau_width_mm", [&](DrawnBy by, double width, double deviation) {
      const double level = 0.8 * mean_of_runs("height_mm").value_or(0);
      const double z = level + (by == DrawnBy::laboratory ? 0.02 : -0.02) * rim();
      add("plateau_width_mm", by, {-width / 2, z}, {width / 2, z}, {-width / 2, level}, {width / 2, level}, width,
          deviation);
    });
  }

  /// Draws two straight lines at the angle of repose along the part of the flank on which it is read: through its
  /// middle on the mean heap, or, before any simulation, on the cone with the mould's volume.
  void draw_flanks() {
    const auto& flank = test_.reading.flank;
    if (!flank) return;
    each_value("angle_of_repose_deg", [&](DrawnBy by, double angle, double deviation) {
      const double slope = std::tan(angle / degrees);
      if (!(slope > 0) || angle >= 90) return;
      const double cone = std::cbrt(3e9 * volume_m3(test_.mould) * slope * slope / std::numbers::pi);
      const double top = mean_of_runs("height_mm").value_or(cone),
                   middle = (flank->lower_share + flank->upper_share) / 2;
      const double at = radius_of_runs(middle * top).value_or((1 - middle) * top / slope);
      const double half = (flank->upper_share - flank->lower_share) / 2 * top;
      const std::string name = by == DrawnBy::laboratory
                                   ? format("laboratory, angle of repose %.1f +- %.1f degrees", angle, deviation)
                                   : format("simulated, angle of repose %.1f degrees", angle);
      for (const double side : {-1.0, 1.0})
        drawing_.lines.push_back(
            {name,
             by,
             {{side * (at + half / slope), middle * top - half}, {side * (at - half / slope), middle * top + half}}});
    });
  }

  /// Mean height of the accepted heaps [mm].
  double mean_height_at(double x) const {
    double sum = 0, count = 0;
    for (const Seen& seen : outlines_)
      if (seen.accepted) {
        sum += mm * seen.outline->at(x / mm);
        ++count;
      }
    return count > 0 ? sum / count : 0;
  }

  /// Half the width of the accepted heaps' mean outline at this height [mm].
  std::optional<double> radius_of_runs(double height) const {
    double left = 0, right = 0;
    while (left < half_width_ && mean_height_at(-left) >= height) left += kStep;
    while (right < half_width_ && mean_height_at(right) >= height) right += kStep;
    return left > 0 && right > 0 ? std::optional((left + right) / 2) : std::nullopt;
  }

  const Measurement* measurement(const std::string& name) const {
    return find_measurement(measured_, step_ + "." + name);
  }
  std::optional<double> mean_of_runs(const std::string& name) const {
    return mean_reading(accepted_, step_ + "." + name);
  }

  /// Calls `draw(by, value, standard deviation)` for the measured and the simulated value of a measured reading.
  void each_value(const std::string& name, const auto& draw) const {
    const Measurement* one = measurement(name);
    if (!one) return;
    draw(DrawnBy::laboratory, one->value, one->standard_deviation);
    if (const auto mean = mean_of_runs(name)) draw(DrawnBy::simulation, *mean, 0.0);
  }

  void add(const char* name, DrawnBy by, DrawnPoint from, DrawnPoint to, DrawnPoint first, DrawnPoint last,
           double value, double deviation) {
    drawing_.lengths.push_back({step_ + "." + name, by, from, to, first, last, value, deviation});
  }

  const SlumpTest& test_;
  std::string step_;
  std::vector<SeenRun> accepted_;  // means use these
  std::span<const Measurement> measured_;
  struct Seen {
    const Outline* outline = nullptr;
    std::uint64_t packing = 0;
    bool accepted = true;  // enters the mean: not sheared off, or all are
    bool sheared = false;
  };
  std::vector<Seen> outlines_;  // all runs
  double half_width_ = 0;       // of the drawing [mm]
  Drawing drawing_;
};

/// Spread over time, simulated and measured.
std::optional<Drawing> drawing_of_flow(const SlumpTest& test, std::span<const SeenRun> runs,
                                       std::span<const Measurement> measured) {
  const bool any = std::ranges::any_of(runs, [](const SeenRun& run) { return run.curve.has_value(); });
  if (!any && test.reading.spread_curve.empty()) return std::nullopt;
  Drawing drawing = drawing_of_curves("Spread after the lift begins", "time [s]", "spread [mm]", runs);
  DrawnLine line{"laboratory", DrawnBy::laboratory, {}};
  for (const auto& [time_s, width_m] : test.reading.spread_curve) line.points.push_back({time_s, mm * width_m});
  if (const auto* known = find_measurement(measured, "step1.spread_curve_mm"))
    line.deviation = known->standard_deviation;
  if (!line.points.empty()) drawing.lines.push_back(std::move(line));
  const auto* t500 = find_measurement(measured, "step1.t500_s");
  if (t500 && test.reading.flow) {
    const double width = mm * test.reading.flow->diameter_m, from = t500->value - t500->standard_deviation;
    drawing.lines.push_back({"laboratory, time to this width",
                             DrawnBy::laboratory,
                             {{std::max(from, 0.0), width}, {t500->value + t500->standard_deviation, width}}});
  }
  return drawing;
}

}  // namespace

std::vector<Drawing> drawings_of(const SlumpTest& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured) {
  std::vector<Drawing> out{HeapDrawing(test, "step1", runs, measured).drawn()};
  if (const auto flow = drawing_of_flow(test, runs, measured)) out.push_back(*flow);
  if (test.drop) out.push_back(HeapDrawing(test, "step2", runs, measured).drawn());
  if (test.drop && test.drop->drops > 1) {
    out.push_back(HeapDrawing(test, "after_drops", runs, measured).drawn());
    out.push_back(drawing_of_curves("Spread over the drops of the table", "drops", "spread [mm]", runs));
  }
  return out;
}

}  // namespace pastefit
