#include "tests/bench/front_figure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace pastefit {

namespace {

constexpr double kWidth = 460, kHeight = 300;  // of a panel
constexpr double kLeft = 60, kRight = 20, kTop = 36, kBottom = 46;

struct Range {
  double low = 0, high = 1;
  double share(double value) const { return (value - low) / (high - low); }
};

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// One panel: points of one scene and ladder.
class Panel {
 public:
  Panel(std::ostream& out, double left, double top, std::vector<const Row*> rows, const Row& reference,
        std::size_t reading)
      : out_(out), left_(left), top_(top), rows_(std::move(rows)), reference_(reference), reading_(reading) {
    time_ = {1e300, 0};
    error_ = {0, 0};
    for (const Row* row : rows_) {
      const Deviation d = deviation(*row, reference_, reading_);
      const double t = std::log10(std::max(cpu_of(*row).value, 1e-3));
      time_ = {std::min(time_.low, t), rows_.front() == row ? t : std::max(time_.high, t)};
      error_ = {std::min(error_.low, d.value - 2 * d.noise), std::max(error_.high, d.value + 2 * d.noise)};
    }
    const double margin = 0.1 * std::max(error_.high - error_.low, 1e-3);
    error_ = {error_.low - margin, error_.high + margin};
    time_ = {time_.low - 0.15, time_.high + 0.35};
  }

  void draw(const std::string& title) const {
    const double x0 = left_ + kLeft, x1 = left_ + kWidth - kRight, y0 = top_ + kTop, y1 = top_ + kHeight - kBottom;
    out_ << "<rect x='" << x0 << "' y='" << y0 << "' width='" << x1 - x0 << "' height='" << y1 - y0
         << "' fill='none' stroke='#888'/>\n";
    text(x0, y0 - 12, title, "start");
    text(0.5 * (x0 + x1), y1 + 36, "processor time of a run [s]", "middle");
    for (double t = std::ceil(time_.low * 3) / 3; t <= time_.high; t += 1.0 / 3)
      text(x(t), y1 + 16, number(std::pow(10, t)), "middle");
    for (int k = 0; k <= 4; ++k) {
      const double e = error_.low + 0.25 * k * (error_.high - error_.low);
      text(x0 - 6, y(e) + 4, number(e), "end");
    }
    line(x0, y(0), x1, y(0), "#bbb");
    for (const Row* row : rows_) draw_point(*row);
  }

 private:
  double x(double log_time) const { return left_ + kLeft + time_.share(log_time) * (kWidth - kLeft - kRight); }
  double y(double error) const { return top_ + kHeight - kBottom - error_.share(error) * (kHeight - kTop - kBottom); }

  void line(double xa, double ya, double xb, double yb, const char* colour) const {
    out_ << "<line x1='" << xa << "' y1='" << ya << "' x2='" << xb << "' y2='" << yb << "' stroke='" << colour
         << "'/>\n";
  }
  void text(double px, double py, const std::string& words, const char* anchor) const {
    out_ << "<text x='" << px << "' y='" << py << "' text-anchor='" << anchor << "'>" << words << "</text>\n";
  }
  void draw_point(const Row& row) const {
    const Deviation d = deviation(row, reference_, reading_);
    const double px = x(std::log10(std::max(cpu_of(row).value, 1e-3)));
    line(px, y(d.value - 2 * d.noise), px, y(d.value + 2 * d.noise), "#06c");
    out_ << "<circle cx='" << px << "' cy='" << y(d.value) << "' r='4' stroke='#06c' fill='"
         << (d.is_noise() ? "white" : "#06c") << "'/>\n";
    text(px + 7, y(d.value) - 5, row.setting.name, "start");
  }

  std::ostream& out_;
  double left_, top_;
  std::vector<const Row*> rows_;
  const Row& reference_;
  std::size_t reading_;
  Range time_, error_;
};

}  // namespace

void write_figure(std::ostream& out, const std::vector<Row>& rows, std::size_t reading) {
  out << "<svg xmlns='http://www.w3.org/2000/svg' width='" << 3 * kWidth << "' height='" << 2 * kHeight
      << "' font-family='sans-serif' font-size='11'>\n<rect width='100%' height='100%' fill='white'/>\n";
  double top = 0;
  for (const char* scene : {"dry", "cohesive"}) {
    double left = 0;
    for (const char* ladder : {"step", "shortcuts", "grains"}) {
      std::vector<const Row*> chosen;
      for (const Row& row : rows)
        if (row.setting.scene == scene && row.setting.ladder == ladder &&
            std::isfinite(reading_of(row, reading).value) &&
            std::any_of(row.runs.begin(), row.runs.end(), [](const Run& run) { return run.readings.has_value(); }))
          chosen.push_back(&row);
      if (!chosen.empty())
        Panel(out, left, top, chosen, reference_of(rows, *chosen.front()), reading)
            .draw(std::string(scene) + ", " + ladder + ": error of " + kReadingNames[reading] + " [mm]");
      left += kWidth;
    }
    top += kHeight;
  }
  out << "</svg>\n";
}

}  // namespace pastefit
