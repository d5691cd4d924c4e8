#include "calibrate/calibrate.h"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "calibrate/store/program.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"
#include "tests/calibrate/folder.h"

using namespace pastefit;
using namespace pastefit::test;

namespace {

/// A shipped study with coarse grains, its strength alone, a wide tolerance, and all conditions stated.
Study coarse_study() {
  Study study = read_study(PASTEFIT_SOURCE_DIR "/data/studies/concrete-mix-20.json").value();
  specimen_of(study.tests.at(0).lab.test).grains.radius_m = 0.018;
  study.tests.at(0).lab.stated = {"apparatus.lift_velocity_mm_s"};
  for (Parameter& parameter : study.parameters) {
    parameter.stated = true;
    if (!parameter.free || parameter.name == "strength_pa") continue;
    parameter.value = value_between(parameter, 0.5);
    parameter.free = false;
  }
  study.search.screening = 3;
  study.search.budget_simulations = 20;
  study.search.packings = 1;
  study.search.confirmation_packings = 2;
  study.search.examination_simulations = 2;
  study.search.tolerance_mm = 40;
  study.search.rejected_share = 1;  // so few grains break as they like
  return study;
}

Store store_in(const Folder& folder, const Study& study) {
  return Store::open(folder.path() / "store.sqlite", {program_identity(), inputs_of(study)}).value();
}

Study study_without_stated_conditions() {
  Study study = coarse_study();
  study.tests.at(0).lab.stated.clear();
  study.search.budget_simulations = 40;
  return study;
}

}  // namespace

TEST_CASE("one call makes a card, and the same card again from its store without a simulation") {
  const Folder folder;
  const Study study = coarse_study();
  auto store = store_in(folder, study);
  const auto first = calibrate(study, store, {.threads = 1}).value();
  REQUIRE(first.card);
  CHECK(first.card->search.status == name_of(CalibrationStatus::confirmed));
  CHECK(first.counts.simulated > 0);
  CHECK(first.counts.simulated <= 20);
  const auto second = calibrate(study, store, {.threads = 2}).value();
  REQUIRE(second.card);
  CHECK(second.counts.simulated == 0);
  CHECK(to_json(*second.card) == to_json(*first.card));
}

TEST_CASE("an examination goes on until its simulations are spent, or all that is shown as equivalent was simulated") {
  const auto calibrated = [](int examination_simulations) {
    const Folder folder;
    Study study = coarse_study();
    study.search.budget_simulations = 40;
    study.search.examination_simulations = examination_simulations;
    Store store = store_in(folder, study);
    return calibrate(study, store).value();
  };
  const int search_alone = calibrated(0).counts.simulated;
  for (const int simulations : {3, 12}) {
    const CalibrationResult result = calibrated(simulations);
    const auto predicted = std::ranges::count(result.inference.value().family, false, &EquivalentMaterial::simulated);
    const int spent = result.counts.simulated - search_alone;
    CAPTURE(simulations, spent, predicted);
    CHECK(spent <= simulations);
    CHECK((spent == simulations || predicted == 0));
  }
}

TEST_CASE("a card says what a condition that nobody states moves, and keeps to the budget and to its bytes") {
  const Folder folder;
  const Study study = study_without_stated_conditions();
  auto store = store_in(folder, study);
  Engine standing;  // so few grains shear off as they like
  standing.run = [](const Test& test, const RunOptions& options) {
    Outcome outcome = simulate(test, options);
    if (outcome.readings.find("step1.lateral_shift_mm")) outcome.readings.set("step1.lateral_shift_mm", 0);
    return outcome;
  };
  const auto result = calibrate(study, store, {.threads = 1, .engine = standing}).value();
  const auto& conditions = result.card.value().inference.conditions;
  REQUIRE(conditions.size() == 1);
  CHECK(conditions[0].place == "apparatus.lift_velocity_mm_s");
  CHECK(conditions[0].lower == 50);
  CHECK(conditions[0].upper == 200);
  REQUIRE(conditions[0].packings > 0);
  const auto height = std::ranges::find(conditions[0].readings, "step1.height_mm", &ConditionEffect::Reading::name);
  REQUIRE(height != conditions[0].readings.end());
  CHECK(height->at_upper != height->at_lower);  // which of them is higher is luck, of so few grains
  CHECK(result.counts.simulated <= 40);
  CHECK(result.card->search.simulations == result.counts.simulated);
  const auto again = calibrate(study, store, {.threads = 2, .engine = standing}).value();
  CHECK(again.counts.simulated == 0);
  CHECK(to_json(again.card.value()) == to_json(*result.card));
  const nlohmann::json written = to_json(*result.card);
  CHECK(nlohmann::json(to_json(card_from_json(written).value())) == written);
}

TEST_CASE("a calibration that is stopped while conditions are simulated says nothing of them") {
  const Folder folder;
  const Study study = study_without_stated_conditions();
  auto store = store_in(folder, study);
  std::atomic<bool> stop = false;
  Engine stopping;
  stopping.run = [&](const Test& test, const RunOptions& options) {
    if (std::get<SlumpTest>(test).lift_velocity_m_s != 0.1) stop = true;
    return simulate(test, options);
  };
  const auto result = calibrate(study, store, {.threads = 1, .stop = &stop, .engine = stopping}).value();
  REQUIRE(stop);
  CHECK(result.card.value().inference.conditions.empty());
}

TEST_CASE("a study that cannot be calibrated is told so before anything is simulated") {
  const Folder folder;
  Study study = coarse_study();
  study.search.budget_simulations = 4;
  auto store = store_in(folder, study);
  const auto result = calibrate(study, store);
  REQUIRE(!result.ok());
  CHECK(result.faults().at(0).where == "search.budget_simulations");
  CHECK(store.size() == 0);
}

TEST_CASE("a study whose residuals would not be finite is refused, whoever put it together") {
  const auto fault_of = [](auto spoil) {
    Study study = coarse_study();
    spoil(study);
    const Faults faults = validate(study);
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].what.find("not finite") != std::string::npos);
    return faults[0].where;
  };
  CHECK(validate(coarse_study(), {}).empty());
  const std::string prior = "parameters.strength_pa.prior.standard_deviation", height = "step1.height_mm";
  // The square overflows at 1e-153, the residual itself at 1e-310, and 0/0 is not a number.
  for (const double deviation : {1e-160, 1e-310, 0.0})
    CHECK(fault_of([&](Study& study) { study.parameters.at(0).prior = Prior{1000, deviation}; }) == prior);
  CHECK(fault_of([](Study& study) { study.tests.at(0).lab.measurements.at(0).standard_deviation = 1e-170; }) == height);
  CHECK(fault_of([](Study& study) { study.tests.at(0).targets.at(0).tolerance = 1e-170; }) == height);
  CHECK(fault_of([](Study& study) { study.tests.at(0).targets.at(0).weight = 1e308; }) == height);
}
