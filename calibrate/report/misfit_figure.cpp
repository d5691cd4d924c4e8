#include "calibrate/report/misfit_figure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibrate/base/text.h"

namespace pastefit {

namespace {

constexpr double width = 900, height = 520;
constexpr double left = 60, right = 720, top = 40, bottom = 470;
constexpr std::array colours = {"#1b6ac9", "#c2571a", "#2f8f4e", "#8a3fa0", "#b8860b", "#c0304a"};

/// Simulations along, misfit up, both from the rows.
struct Axes {
  double simulations = 1;
  double low = 0, high = 1;  ///< decimal logarithms of the misfit

  double x(double simulation) const { return left + (right - left) * simulation / simulations; }
  double y(double misfit) const {
    const double share = (std::log10(std::max(misfit, 1e-3)) - low) / (high - low);
    return bottom - (bottom - top) * std::clamp(share, 0.0, 1.0);
  }
};

Axes axes_of(const std::vector<StrategySummary>& rows, const ErrorUnit& unit) {
  Axes axes;
  double least = unit.of(1), most = 2 * unit.of(1);
  for (const StrategySummary& row : rows) {
    axes.simulations = std::max(axes.simulations, static_cast<double>(row.errors.size()));
    for (const double difference : row.errors) {
      if (difference <= 0) continue;
      const double misfit = unit.of(difference);
      least = std::min(least, misfit);
      most = std::max(most, misfit);
    }
  }
  axes.low = std::log10(0.8 * std::max(least, 0.01));
  axes.high = std::log10(1.2 * most);
  return axes;
}

std::string text(double x, double y, const std::string& words, const char* anchor, const char* colour = "#222") {
  return format("<text x='%.1f' y='%.1f' text-anchor='%s' fill='%s'>", x, y, anchor, colour) + xml_text(words) +
         "</text>\n";
}

std::string frame(const Axes& axes, const ErrorUnit& unit) {
  std::string out = format("<rect x='%g' y='%g' width='%g' height='%g' fill='none' stroke='#888'/>\n", left, top,
                           right - left, bottom - top);
  for (int k = 0; k <= 5; ++k) {
    const double simulation = std::round(axes.simulations * k / 5);
    out += text(axes.x(simulation), bottom + 18, format("%.0f", simulation), "middle");
  }
  for (const double misfit : {0.01, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0})
    if (std::log10(misfit) >= axes.low && std::log10(misfit) <= axes.high)
      out += text(left - 6, axes.y(misfit) + 4, format("%g", misfit), "end");
  out += text((left + right) / 2, bottom + 38, "simulations", "middle");
  out += text(left, top - 8, std::string("misfit of the incumbent [") + unit.name() + "]", "start");
  out += format("<line x1='%g' y1='%.1f' x2='%g' y2='%.1f' stroke='#222' stroke-dasharray='5 4'/>\n", left,
                axes.y(unit.of(1)), right, axes.y(unit.of(1)));
  return out;
}

/// Steps, because an incumbent stands until it is beaten.
std::string course(const Axes& axes, const ErrorUnit& unit, const StrategySummary& row, const char* colour,
                   double stroke) {
  std::string points;
  double before = -1;
  for (std::size_t i = 0; i < row.errors.size(); ++i) {
    const double misfit = unit.of(row.errors[i]);
    if (misfit < 0) continue;
    const double x = axes.x(static_cast<double>(i + 1));
    if (before >= 0 && before != misfit) points += format("%.1f,%.1f ", x, axes.y(before));
    points += format("%.1f,%.1f ", x, axes.y(misfit));
    before = misfit;
  }
  return format("<polyline fill='none' stroke='%s' stroke-width='%g' points='", colour, stroke) + points + "'/>\n";
}

}  // namespace

std::string misfit_figure(const std::vector<StrategySummary>& rows, const ErrorUnit& unit, const std::string& title) {
  const Axes axes = axes_of(rows, unit);
  std::string out = format("<svg xmlns='http://www.w3.org/2000/svg' width='%g' height='%g' ", width, height) +
                    "font-family='sans-serif' font-size='12'>\n<rect width='100%' height='100%' fill='white'/>\n";
  out += text(left, 18, title, "start") + frame(axes, unit);
  std::string lines, legend;
  std::size_t coloured = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool shown = coloured < colours.size() && (coloured + 1 < colours.size() || rows[i].strategy == "default");
    const char* colour = shown ? colours[coloured++] : "#bbb";
    lines += course(axes, unit, rows[i], colour, rows[i].strategy == "default" ? 3 : shown ? 1.6 : 0.8);
    legend +=
        text(right + 12, top + 10 + 17 * static_cast<double>(i), rows[i].strategy, "start", shown ? colour : "#777");
  }
  return out + lines + legend + "</svg>\n";
}

}  // namespace pastefit
