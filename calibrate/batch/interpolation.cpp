#include "calibrate/batch/interpolation.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "calibrate/base/statistics.h"
#include "calibrate/base/text.h"
#include "calibrate/batch/batch_table.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/models/gaussian_process.h"
#include "calibrate/search/calibration.h"
#include "calibrate/store/program.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

constexpr double kNormal = 1.96;  // standard deviations of a 95 % interval

TrendPrediction predict_line(std::span<const double> x, std::span<const double> y, double at) {
  const double n = static_cast<double>(x.size());
  const double mean_x = sample_of(x).mean, mean_y = sample_of(y).mean;
  double xx = 0, xy = 0, squares = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  const double slope = xy / xx;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double residual = y[i] - mean_y - slope * (x[i] - mean_x);
    squares += residual * residual;
  }
  const double deviation = std::sqrt(squares / (n - 2)), away = at - mean_x;
  const double t = kNormal * widening(static_cast<int>(x.size()) - 1);
  return {mean_y + slope * away, t * deviation * std::sqrt(1 + 1 / n + away * away / xx)};
}

TrendPrediction predict_process(std::span<const double> x, std::span<const double> y, double at) {
  const auto [low, high] = std::ranges::minmax(x);
  const auto unit = [low = low, high = high](double value) {
    return UnitPoint(UnitPoint::Constant(1, (value - low) / (high - low)));
  };
  std::vector<UnitPoint> points;
  Eigen::VectorXd values(static_cast<Eigen::Index>(y.size()));
  for (std::size_t i = 0; i < x.size(); ++i) {
    points.push_back(unit(x[i]));
    values[static_cast<Eigen::Index>(i)] = y[i];
  }
  const GaussianProcess process(points, values);
  const auto prediction = process.predict(unit(at));
  return {prediction.mean, kNormal * std::sqrt(prediction.variance + process.noise_variance())};
}

}  // namespace

std::string_view name_of(TrendModel model) {
  return model == TrendModel::linear ? "linear" : "gaussian_process";
}

TrendPrediction predict_trend(std::span<const double> x, std::span<const double> y, double at, TrendModel model) {
  return model == TrendModel::linear ? predict_line(x, y, at) : predict_process(x, y, at);
}

namespace {

constexpr std::size_t kFewestCards = 3;

/// A confirmed material of the batch, and where its mix stands.
struct Anchor {
  const BatchStudy* study = nullptr;
  Card card;
  double x = 0;
};

/// Laws and parameters of a study, as its file says them.
nlohmann::json model_of(const Study& study) {
  const auto content = nlohmann::json::parse(study.content);
  return {content.value("contact", nlohmann::json::object()), content.value("parameters", nlohmann::json::object())};
}

/// Names of the variables that the laboratory files have, in words.
std::string variables_in(const std::vector<BatchRow>& rows) {
  std::string out;
  for (const std::string& name : names_in(rows, &BatchRow::laboratory)) out += (out.empty() ? "" : ", ") + name;
  return out;
}

Result<std::vector<Anchor>> anchors_of(const std::vector<BatchStudy>& batch, const MixInBetween& mix) {
  std::vector<Anchor> anchors;
  std::vector<BatchRow> rows;
  bool known = false;
  for (const BatchStudy& one : batch) {
    rows.push_back(row_of(one));
    const auto* number = find_named(rows.back().laboratory, mix.variable);
    if (!number) continue;
    known = true;
    auto card = card_of_batch(one);
    if (!card || card->search.status != name_of(CalibrationStatus::confirmed)) continue;
    anchors.push_back({&one, std::move(*card), number->value.value()});
  }
  if (!known)
    return Fault{"--at " + mix.variable, "no laboratory file has this variable",
                 "one of: " + variables_in(rows) + "; or name it in the laboratory files, \"mix\": { ... }"};
  if (anchors.size() < kFewestCards)
    return Fault{"--from", format("%zu confirmed cards have ", anchors.size()) + mix.variable,
                 format("at least %zu; calibrate more mixes with pastefit batch", kFewestCards)};
  std::ranges::stable_sort(anchors, {}, &Anchor::x);
  if (mix.value < anchors.front().x || mix.value > anchors.back().x || anchors.front().x == anchors.back().x)
    return Fault{
        "--at " + mix.variable, "is " + shown(mix.value),
        "a value between those of the confirmed cards, " + shown(anchors.front().x) + " to " + shown(anchors.back().x)};
  Faults faults;
  for (const Anchor& one : anchors)
    if (model_of(one.study->study) != model_of(anchors.front().study->study))
      faults.push_back({one.study->file.string(),
                        "has other contact laws, parameters or bounds than " + anchors.front().study->file.string(),
                        "calibrate all mixes with the same, or leave it out"});
  if (!faults.empty()) return faults;
  return anchors;
}

const Anchor& nearest_of(const std::vector<Anchor>& anchors, double value) {
  return *std::ranges::min_element(anchors, {}, [&](const Anchor& one) { return std::abs(one.x - value); });
}

/// Something of the cards, at the mix in between.
template <class Number>
TrendPrediction predicted(const std::vector<Anchor>& anchors, const MixInBetween& mix, Number number) {
  std::vector<double> x, y;
  for (const Anchor& one : anchors) {
    x.push_back(one.x);
    y.push_back(number(one.card));
  }
  return predict_trend(x, y, mix.value, mix.model);
}

/// Sets the fitted parameters and their intervals.
void predict_parameters(Card& card, const std::vector<Anchor>& anchors, const MixInBetween& mix) {
  card.inference = {};
  card.inference.method = "prediction by a " +
                          std::string(mix.model == TrendModel::linear ? "line" : "Gaussian process") +
                          format(" over the mix from %zu cards", anchors.size());
  card.inference.level = 0.95;
  for (std::size_t i = 0; i < card.material.parameters.size(); ++i) {
    Parameter& one = card.material.parameters[i];
    if (!one.free) continue;
    const bool logarithmic = one.scale == Scale::logarithmic;
    const auto along = [&](double value) { return logarithmic ? std::log(value) : value; };
    const auto back = [&](double value) {
      return std::clamp(logarithmic ? std::exp(value) : value, one.lower, one.upper);
    };
    const auto [mean, half_width] =
        predicted(anchors, mix, [&](const Card& other) { return along(other.material.parameters[i].value); });
    one.value = back(mean);
    if (has_parameter(card, one.name))
      card.inference.intervals.push_back({one.name, back(mean - half_width), back(mean + half_width)});
  }
}

/// The tests of the nearest mix with this material; none of them was simulated.
void set_tests(Card& card, const Study& study, double density_ratio) {
  for (std::size_t i = 0; i < card.tests.size(); ++i) {
    CardTest& one = card.tests[i];
    Test test = study.tests[i].lab.test;
    specimen_of(test).bulk_density_kg_m3 *= density_ratio;
    one.test = test_with(std::move(test), values_of(card.material), 1);
    one.readings.clear();
    one.within_noise.reset();
    one.baseline = {};
    one.yield_stress.reset();
    one.lab.notes = "Apparatus of this laboratory file; its readings are of another mix. " + one.lab.notes;
  }
  card.material.contact = specimen_of(card.tests.front().test).contact;
}

}  // namespace

Result<Card> interpolated_card(const std::vector<BatchStudy>& batch, const MixInBetween& mix) {
  const auto found = anchors_of(batch, mix);
  if (!found.ok()) return found.faults();
  const std::vector<Anchor>& anchors = found.value();
  const Anchor& nearest = nearest_of(anchors, mix.value);
  Card card = nearest.card;
  card.title = "a mix in between";
  predict_parameters(card, anchors, mix);
  const double density =
      predicted(anchors, mix, [](const Card& other) { return other.material.bulk_density_kg_m3; }).mean;
  const double ratio = density / card.material.bulk_density_kg_m3;
  card.material.bulk_density_kg_m3 *= ratio;
  if (card.material.grain_density_kg_m3) *card.material.grain_density_kg_m3 *= ratio;
  set_tests(card, nearest.study->study, ratio);
  card.confirmation = {};
  card.search = {};
  card.search.strategy = "interpolation";
  card.search.status = name_of(CalibrationStatus::unconfirmed);
  card.search.reason = "The material was interpolated, and no reading of this mix was met.";
  card.provenance.program = program_identity();
  card.rebaselined.clear();
  card.rescaled.clear();
  card.further_confirmations.clear();
  card.interpolated = Interpolation{mix.variable, mix.value, std::string(name_of(mix.model)), {}};
  for (const Anchor& one : anchors) card.interpolated->studies.push_back(one.study->name);
  return card;
}

}  // namespace pastefit
