#include <algorithm>

#include "calibrate/base/text.h"
#include "calibrate/laboratory/drawing.h"
#include "calibrate/report/views.h"

namespace pastefit {

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
