#include "calibrate/inference/inference.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "calibrate/inference/description.h"
#include "calibrate/inference/posterior.h"
#include "calibrate/search/screening.h"
#include "tests/calibrate/search/fake_slump.h"

using namespace pastefit;
using namespace pastefit::synthetic;

namespace {

/// Readings of two parameters between 0 and 1, as functions; noise with a standard deviation of 1.
struct Law {
  std::string name;
  std::function<double(const UnitPoint&)> mean;
  std::optional<double> measured;
  double deviation = 5;
};

TrainingData evidence_for(const std::vector<Law>& laws, int simulations = 40, double most_of_second = 1) {
  TrainingData evidence;
  for (const char* name : {"first", "second"}) {
    Parameter parameter;
    parameter.name = name;
    parameter.free = true;
    parameter.upper = 1;
    evidence.parameters.push_back(parameter);
  }
  evidence.points = screening_points(2, simulations, 1);
  for (UnitPoint& point : evidence.points) point[1] *= most_of_second;
  for (const Law& law : laws) {
    ReadingTrainingData reading;
    reading.name = law.name;
    reading.measured = law.measured;
    reading.deviation = law.deviation;
    reading.weight = 1;
    reading.simulated.resize(simulations);
    for (int i = 0; i < simulations; ++i)
      reading.simulated[i] = law.mean(evidence.points[static_cast<std::size_t>(i)]) +
                             normal(static_cast<std::uint64_t>(i), evidence.readings.size());
    evidence.readings.push_back(std::move(reading));
  }
  return evidence;
}

const Law first_alone{"step1.height_mm", [](const UnitPoint& x) { return 100 * x[0]; }, 50};
const Law sum_of_both{"step1.height_mm", [](const UnitPoint& x) { return 100 * (x[0] + x[1]); }, 100};
const Law second_alone{"step1.spread_mm", [](const UnitPoint& x) { return 100 * x[1]; }, std::nullopt};
const Law other_difference{"step1.spread_mm", [](const UnitPoint& x) { return 100 * (x[0] - x[1]); }, 0, 25};
const UnitPoint middle = UnitPoint::Constant(2, 0.5);

}  // namespace

TEST_CASE("a sample of a normal likelihood has its mean and its width") {
  const auto sample = posterior_sample(
      [](const UnitPoint& x) { return -0.5 * (std::pow((x[0] - 0.3) / 0.02, 2) + std::pow((x[1] - 0.6) / 0.1, 2)); }, 2,
      3000, 1);
  double mean = 0, square = 0, wide = 0;
  for (const UnitPoint& x : sample) {
    mean += x[0] / 3000;
    square += std::pow(x[0] - 0.3, 2) / 3000;
    wide += std::pow(x[1] - 0.6, 2) / 3000;
  }
  CHECK(mean == Approx(0.3).margin(0.002));
  CHECK(std::sqrt(square) == Approx(0.02).epsilon(0.1));
  CHECK(std::sqrt(wide) == Approx(0.1).epsilon(0.1));
}

TEST_CASE("a sample finds separate regions in proportion to their weight") {
  const auto sample = posterior_sample(
      [](const UnitPoint& x) {
        const auto hill = [&](double at) { return std::exp(-0.5 * std::pow((x[0] - at) / 0.03, 2)); };
        return std::log(3 * hill(0.15) + hill(0.8) + 1e-30);
      },
      1, 3000, 1);
  const auto left = std::ranges::count_if(sample, [](const UnitPoint& x) { return x[0] < 0.5; });
  CHECK(static_cast<double>(left) / 3000 == Approx(0.75).margin(0.05));
}

TEST_CASE("a flat likelihood leaves the bounds as they are") {
  const Inference inference =
      infer(evidence_for({{"step1.height_mm", [](const UnitPoint&) { return 50.0; }, 50}}), middle);
  for (const ParameterInterval& one : inference.intervals) {
    CHECK(one.not_identified());
    CHECK(one.lower.at == 0);
    CHECK(one.upper.at == 1);
    CHECK(one.uncertainty == Approx(1).margin(0.06));
  }
  for (const Combination& one : inference.combinations) CHECK_FALSE(one.determined());
}

TEST_CASE("the interval of a parameter that is seen alone is that of the closed form") {
  const Inference inference = infer(evidence_for({first_alone}), middle);
  const ParameterInterval& seen = inference.intervals[0];
  REQUIRE(seen.interval_exists());
  CHECK(seen.lower.at == Approx(0.5 - 1.96 * 0.05).margin(0.012));
  CHECK(seen.upper.at == Approx(0.5 + 1.96 * 0.05).margin(0.012));
  CHECK(inference.intervals[1].not_identified());
  REQUIRE(inference.combinations.size() == 2);
  CHECK(inference.combinations[0].determined());
  CHECK(inference.combinations[0].singular_value == Approx(100 / std::sqrt(12.0) / 5).epsilon(0.05));
  CHECK(std::abs(inference.combinations[0].direction[0]) == Approx(1).margin(0.01));
  CHECK(inference.combinations[0].lead_width == Approx(1.96 * 0.05).margin(0.012));
  CHECK_FALSE(inference.combinations[1].determined());
}

TEST_CASE("repeats narrow an interval as their number does") {
  TrainingData evidence = evidence_for({first_alone});
  const double once = infer(evidence, middle).intervals[0].uncertainty;
  evidence.readings[0].repeats = 4;
  CHECK(infer(evidence, middle).intervals[0].uncertainty == Approx(once / 2).epsilon(0.12));
}

TEST_CASE("a condition that nobody states widens an interval by a twelfth of the square of what it moves") {
  TrainingData evidence = evidence_for({first_alone});  // tells 0.5 +- 0.05
  const double stated = infer(evidence, middle).intervals[0].uncertainty;
  evidence.conditions = {{"apparatus.lift_velocity_mm_s", 100, 50, 200, 2, {{"step1.height_mm", 60, 30}}}};
  const double own = 5, moved = 30 / std::sqrt(12.0);
  CHECK(infer(evidence, middle).intervals[0].uncertainty ==
        Approx(stated * std::hypot(own, moved) / own).epsilon(0.12));
  CHECK(describe(infer(evidence, middle))
            .find("apparatus.lift_velocity_mm_s, 50 to 200: step1.height_mm from 60 to 30") != std::string::npos);
}

TEST_CASE("a prior and a reading of the same parameter are weighed by their variances") {
  TrainingData evidence = evidence_for({first_alone});  // tells 0.5 +- 0.05
  evidence.parameters[0].prior = Prior{0.6, 0.05};
  const Inference inference = infer(evidence, middle);
  const ParameterInterval& one = inference.intervals[0];
  CHECK(one.lower.at == Approx(0.55 - 1.96 * 0.05 / std::sqrt(2.0)).margin(0.012));
  CHECK(one.upper.at == Approx(0.55 + 1.96 * 0.05 / std::sqrt(2.0)).margin(0.012));
  CHECK(one.deviation_before == Approx(0.05).epsilon(0.01));
  CHECK(one.uncertainty == Approx(1 / std::sqrt(2.0)).margin(0.06));
  CHECK_THAT(describe(inference), Catch::Contains("first had the prior 0.6 +- 0.05; with the readings"));
}

TEST_CASE("a prior tells apart what the reading alone cannot, and what came from it is said") {
  TrainingData evidence = evidence_for({sum_of_both});
  evidence.parameters[1].prior = Prior{0.3, 0.03};
  const Inference inference = infer(evidence, Eigen::Vector2d(0.7, 0.3));
  CHECK(inference.intervals[0].interval_exists());
  CHECK(inference.intervals[0].lower.at == Approx(0.7 - 1.96 * std::hypot(0.05, 0.03)).margin(0.02));
  CHECK(inference.intervals[0].upper.at == Approx(0.7 + 1.96 * std::hypot(0.05, 0.03)).margin(0.02));
  CHECK(inference.intervals[1].uncertainty > 0.9);
  CHECK_THAT(describe(inference), Catch::Contains("second had the prior 0.3 +- 0.03; the readings do not narrow it"));
  for (const EquivalentMaterial& member : inference.family) CHECK(member.values[1] == Approx(0.3).margin(0.12));
}

TEST_CASE("two parameters that only their sum shows are each wide, narrow if the other is held, and correlated") {
  const Inference inference = infer(evidence_for({sum_of_both}), middle);
  for (const ParameterInterval& one : inference.intervals) {
    CHECK(one.not_identified());
    CHECK(one.held_upper.at - one.held_lower.at == Approx(2 * 1.96 * 0.05).margin(0.03));
  }
  CHECK(inference.correlation[0][1] < -0.9);
  const Combination& sum = inference.combinations[0];
  CHECK(sum.direction[0] == Approx(std::sqrt(0.5)).margin(0.02));
  CHECK(sum.direction[1] == Approx(std::sqrt(0.5)).margin(0.02));
  for (const EquivalentMaterial& member : inference.family)
    CHECK(member.values[0] + member.values[1] == Approx(1).margin(0.1));
  REQUIRE(inference.family.size() == 5);
  CHECK(std::abs(inference.family[1].values[0] - 0.5) > 0.3);
}

TEST_CASE("no material is named of which a reading is expected to miss by more than one deviation") {
  // Two readings that cannot be had together, as a height and a spread may be: half of a broad sample misses one.
  const std::vector laws{sum_of_both, other_difference};
  const Inference inference = infer(evidence_for(laws, 12), middle);
  const EquivalentMaterial& recommended = inference.family.front();
  for (const EquivalentMaterial& member : inference.family) {
    for (std::size_t k = 0; k < laws.size(); ++k) {
      const auto error = [&](const EquivalentMaterial& one) {
        return std::abs(one.readings[k] - *laws[k].measured) / laws[k].deviation;
      };
      CHECK(error(member) <= std::max(1.0, error(recommended)) + 1e-9);
    }
  }
  CHECK_THAT(describe(inference), Catch::Contains("expected to fit these readings as well as the first"));
}

TEST_CASE("the measurement that would tell them apart is named first, with what it would leave") {
  const Inference inference = infer(evidence_for({sum_of_both, second_alone}), middle);
  REQUIRE(inference.gains.size() == 2);
  CHECK(inference.gains[0].reading == "step1.spread_mm");
  CHECK(inference.gains[0].narrowing < 0.25);
  CHECK(inference.gains[1].narrowing > 0.8);

  TrainingData after = evidence_for({sum_of_both, second_alone});
  after.readings[1].measured = 50;
  after.readings[1].repeats = inference.gains[0].measurements;
  const double left = infer(after, middle).intervals[1].uncertainty / inference.intervals[1].uncertainty;
  CHECK(left == Approx(inference.gains[0].narrowing).margin(0.1));
}

TEST_CASE("a reading that the model misses by far is not proposed again") {
  TrainingData evidence = evidence_for({sum_of_both, second_alone});
  evidence.readings[1].measured = 500;
  evidence.readings[1].weight = 0;
  const Inference inference = infer(evidence, middle);
  REQUIRE(inference.gains.size() == 1);
  CHECK(inference.gains[0].reading == "step1.height_mm");
}

TEST_CASE("what no simulation has looked at is not ruled out by readings that are one and the same") {
  const auto wave = [](const UnitPoint& x) { return 100 * x[0] + 8 * std::sin(9 * x[1]); };
  const TrainingData evidence = evidence_for({{"step1.height_mm", wave, 50},
                                              {"step1.spread_mm", wave, 50},
                                              {"step2.height_mm", wave, 50},
                                              {"step2.spread_mm", wave, 50}},
                                             40, 0.4);
  const Inference inference = infer(evidence, UnitPoint{{0.5, 0.35}});
  CHECK(inference.intervals[0].interval_exists());
  CHECK_FALSE(inference.intervals[1].upper.known);
}

TEST_CASE("the words name what is fixed, what is not, and what to measure") {
  const std::string words = describe(infer(evidence_for({first_alone, second_alone}), middle));
  CHECK(words.find("step1.height_mm limits first to") != std::string::npos);
  CHECK(words.find("second is not identifiable from this test") != std::string::npos);
  CHECK(words.find("measurements of step1.spread_mm") != std::string::npos);
  CHECK(warning_before(5, 0, {"a"}).find("1 fitted reading fixes at most 1 combination") != std::string::npos);
  CHECK(warning_before(1, 0, {"a", "b"}).empty());
  CHECK(warning_before(3, 2, {"a"}).empty());
  CHECK(warning_before(4, 2, {"a"}).find("2 that are known beforehand") != std::string::npos);
}

TEST_CASE("a card keeps the ends that the data set, and names what they do not see") {
  const CardInference card = card_inference(infer(evidence_for({first_alone}), middle));
  REQUIRE(card.intervals.size() == 1);
  CHECK(card.intervals[0].parameter == "first");
  CHECK(card.level == 0.95);
  REQUIRE(card.not_identified.size() == 1);
  CHECK(card.not_identified[0].parameter == "second");
}

TEST_CASE("the same evidence gives the same inference") {
  const std::string once = describe(infer(evidence_for({sum_of_both, second_alone}), middle));
  CHECK(describe(infer(evidence_for({sum_of_both, second_alone}), middle)) == once);
}

TEST_CASE("a simulation that ended early says that it read less, not that it read its bound") {
  const TrainingData whole = evidence_for({first_alone});
  TrainingData cut = whole;
  ReadingTrainingData& height = cut.readings[0];
  constexpr double cutoff = 38;
  for (double& value : height.simulated) {
    height.is_bound.push_back(value <= cutoff);
    value = std::max(value, cutoff);
  }
  TrainingData equal = cut;
  equal.readings[0].is_bound.clear();
  const auto lower = [](const TrainingData& evidence) { return infer(evidence, middle).intervals[0].lower.at; };
  const double known = lower(whole);
  CHECK(lower(cut) == Approx(known).margin(0.02));
  CHECK(std::abs(lower(cut) - known) < std::abs(lower(equal) - known));
}

TEST_CASE("readings of one heap that scatter against each other tell more together than apart") {
  // Both rise with the first parameter, with a noise of 5 each: var = 25/(100^2 2) (1 + r).
  const auto uncertainty = [](double correlation) {
    TrainingData evidence = evidence_for({first_alone, {"step1.spread_mm", first_alone.mean, 50}}, 40);
    const std::vector<UnitPoint> sites = evidence.points;
    evidence.points.clear();
    std::vector<double> heights, spreads;
    for (std::uint64_t i = 0; i < 800; ++i) {
      const UnitPoint& site = sites[i % sites.size()];
      const double one = normal(i, 7), other = normal(i, 8);
      evidence.points.push_back(site);
      heights.push_back(100 * site[0] + 5 * one);
      spreads.push_back(100 * site[0] + 5 * (correlation * one + std::sqrt(1 - correlation * correlation) * other));
    }
    evidence.readings[0].simulated = Eigen::Map<Eigen::VectorXd>(heights.data(), std::ssize(heights));
    evidence.readings[1].simulated = Eigen::Map<Eigen::VectorXd>(spreads.data(), std::ssize(spreads));
    return infer(evidence, middle).intervals[0].uncertainty / std::sqrt(12.0);
  };
  for (const double correlation : {0.0, -0.8})
    CHECK(uncertainty(correlation) == Approx(0.05 * std::sqrt((1 + correlation) / 2)).epsilon(0.15));
}

TEST_CASE("that a laboratory reports its heaps tells against materials of which most shear off") {
  TrainingData evidence = evidence_for({first_alone}, 60);
  for (const UnitPoint& point : evidence.points) evidence.rejection_indices.push_back(point[1] > 0.5 ? 1.5 : 0.5);
  const auto range = [&](int heaps) {
    evidence.accepted_heaps = heaps;
    const Inference inference = infer(evidence, middle);
    return std::pair{inference.intervals[1].lower.at, inference.intervals[1].upper.at};
  };
  CHECK(range(0).second > 0.95);
  CHECK(range(3).second < 0.85);
  CHECK(range(3).first < 0.05);
}

namespace {

/// One parameter between 0 and 1 and one reading, at these coordinates.
TrainingData evidence_along(const std::vector<double>& coordinates, const std::function<double(double)>& mean,
                            double measured, double deviation) {
  TrainingData evidence;
  Parameter parameter;
  parameter.name = "only";
  parameter.free = true;
  parameter.upper = 1;
  evidence.parameters.push_back(parameter);
  ReadingTrainingData reading;
  reading.name = "step1.height_mm";
  reading.measured = measured;
  reading.deviation = deviation;
  reading.weight = 1;
  reading.simulated.resize(std::ssize(coordinates));
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    evidence.points.push_back(UnitPoint::Constant(1, coordinates[i]));
    reading.simulated[static_cast<Eigen::Index>(i)] = mean(coordinates[i]);
  }
  evidence.readings.push_back(std::move(reading));
  return evidence;
}

double stands_or_flows(double x) {
  return x < 0.62 ? 70 + 5 * x : 290 + 10 * x;
}

const std::vector<double> halved{0.02, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.61, 0.615, 0.625, 0.65, 0.7, 0.8, 0.9, 0.98};

}  // namespace

TEST_CASE("one free parameter has one interval") {
  const auto line = [](double x) { return 100 * x; };
  for (const double measured : {50.0, 4.0}) {
    const UnitPoint at = UnitPoint::Constant(1, measured / 100);
    const Inference inference = infer(evidence_along(halved, line, measured, 5), at);
    const ParameterInterval& one = inference.intervals[0];
    CHECK(one.lower.at == one.held_lower.at);
    CHECK(one.upper.at == one.held_upper.at);
    CHECK(one.lower.known == (measured > 10));
    const std::string words = describe(inference);
    CHECK(words.find("held") == std::string::npos);
    CHECK(words.find("all parameters free") == std::string::npos);
    CHECK((words.find("(the study's bound)") != std::string::npos) == !one.lower.known);
  }
}

TEST_CASE("intervals with all parameters free contain those with the others held, and what is named as fitting") {
  for (const auto& law : {first_alone, sum_of_both})
    for (const double off : {0.0, 0.2, -0.2}) {
      const Inference inference = infer(evidence_for({law, second_alone}), UnitPoint{{0.5 + off, 0.5 - off}});
      for (std::size_t j = 0; j < inference.intervals.size(); ++j) {
        const ParameterInterval& one = inference.intervals[j];
        CHECK(one.lower.at <= one.held_lower.at);
        CHECK(one.upper.at >= one.held_upper.at);
        for (const EquivalentMaterial& member : inference.family) {
          CHECK(member.values[j] >= one.lower.at);
          CHECK(member.values[j] <= one.upper.at);
        }
      }
    }
}

TEST_CASE("an interval ends at the simulations on either side of a jump") {
  const Inference inference = infer(evidence_along(halved, stands_or_flows, 150, 10), UnitPoint::Constant(1, 0.625));
  CHECK(inference.jumps);
  CHECK(inference.intervals[0].lower.at >= 0.6);
  CHECK(inference.intervals[0].upper.at <= 0.65);
}

TEST_CASE("nothing is predicted across a jump: no material that nobody simulated, no gain of a measurement") {
  const Inference inference = infer(evidence_along(halved, stands_or_flows, 150, 10), UnitPoint::Constant(1, 0.625));
  for (const EquivalentMaterial& member : inference.family) {
    CHECK(member.simulated);
    CHECK(member.readings[0] == Approx(stands_or_flows(member.values[0])));
  }
  CHECK(inference.gains.empty());
  CHECK_THAT(describe(inference), Catch::Contains("jumps"));

  // With two parameters, near the threshold alone; it is seen where the jump is many deviations.
  auto threshold = first_alone;
  threshold.mean = [](const UnitPoint& x) { return stands_or_flows(x[0]); };
  threshold.measured = 150;
  threshold.deviation = 3;
  const Inference two = infer(evidence_for({threshold}, 60), UnitPoint{{0.6, 0.5}});
  for (const EquivalentMaterial& member : two.family)
    if (!member.simulated) CHECK(std::abs(member.values[0] - 0.62) > 0.02);
}
