#include "calibrate/calibrator.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <vector>

#include "calibrate/calibrate.h"
#include "calibrate/search/screening.h"
#include "core/random.h"
#include "tests/calibrate/search/laboratory.h"

using namespace pastefit;
using namespace pastefit::test;

namespace {

/// A laboratory with a second test that is held out, and heaps that scatter a little.
void prepare_for_calibration(Laboratory& laboratory) {
  auto& study = laboratory.study;
  study.tests[0].name = "fitted";
  study.tests.push_back(study.tests[0]);
  study.tests[1].name = "held_out";
  study.tests[1].hold_out = true;
  std::get<SlumpTest>(study.tests[1].lab.test).lift_velocity_m_s = 0.15;
  study.search.budget_simulations = 80;
  laboratory.twist = [](const SlumpTest& test, const RunOptions&, Outcome& outcome) {
    const double noise = 0.3 * RandomStream(test.packing_seed, "luck").normal(0);
    outcome.readings.set("step1.height_mm",
                         95 + 50 * (test.contact.friction - 0.5) + 40 * test.lift_velocity_m_s + noise);
    outcome.readings.set("fill.mass_kg", 9.01);
  };
}

std::string text_of(const CalibrationResult& result) {
  return to_json(result.card.value()).dump();
}

/// Answers suggestions in an order drawn from `seed`, at most `most`; returns how many.
int go_on(Calibrator& calibrator, const Answers& answers, const Engine& engine, std::uint64_t seed, int most = 1000) {
  std::vector<Simulation> under_way;
  int answered = 0;
  for (; answered < most && !calibrator.finished(); ++answered) {
    const auto simulations = calibrator.suggest(3);
    under_way.insert(under_way.end(), simulations.begin(), simulations.end());
    if (calibrator.finished()) break;
    REQUIRE(!under_way.empty());
    const auto chosen = under_way.begin() + static_cast<std::ptrdiff_t>(
                                                hash_of(seed, static_cast<std::uint64_t>(answered)) % under_way.size());
    RunOptions run;
    run.cutoff = cutoff_of(*chosen);
    StoredEvaluation evaluation = answers.unanswered(*chosen);
    enter(evaluation, engine.run(test_of(*chosen), run), run.cutoff);
    REQUIRE(calibrator.ingest(*chosen, evaluation).empty());
    under_way.erase(chosen);
  }
  return answered;
}

}  // namespace

TEST_CASE("answers from anywhere, in any order, make the card of one call, to its held-out tests and conditions") {
  Laboratory laboratory;
  prepare_for_calibration(laboratory);
  auto store = laboratory.store();
  const CalibrationResult expected = calibrate(laboratory.study, store, laboratory.options, {}, "study.json").value();
  REQUIRE(expected.search.status == CalibrationStatus::confirmed);
  CHECK(expected.card->tests[1].within_noise.has_value());
  CHECK_FALSE(expected.inference.value().conditions.empty());
  for (const std::uint64_t seed : {1, 2}) {
    Laboratory elsewhere;
    prepare_for_calibration(elsewhere);
    auto store_elsewhere = elsewhere.store();
    StudyAnswers answers(std::make_shared<const Study>(elsewhere.study), store_elsewhere, "study.json");
    Calibrator calibrator(answers);
    go_on(calibrator, answers, elsewhere.options.engine, seed);
    CHECK(text_of(calibrator.result()) == text_of(expected));
    CHECK(calibrator.counts().simulated == expected.counts.simulated);
  }
}

TEST_CASE("a calibration that is left and begun again from its store asks nothing twice and makes the same card") {
  Laboratory laboratory;
  prepare_for_calibration(laboratory);
  auto store = laboratory.store();
  StudyAnswers answers(std::make_shared<const Study>(laboratory.study), store, "study.json");
  Calibrator whole(answers);
  const int asked = go_on(whole, answers, laboratory.options.engine, 1);
  for (const int before : {1, asked / 2, asked - 1}) {
    Laboratory left;
    prepare_for_calibration(left);
    auto its_store = left.store();
    StudyAnswers its_answers(std::make_shared<const Study>(left.study), its_store, "study.json");
    Calibrator first(its_answers), second(its_answers);
    CHECK(go_on(first, its_answers, left.options.engine, 2, before) == before);
    CHECK(go_on(second, its_answers, left.options.engine, 3) == asked - before);
    CHECK(second.counts().answered == before);
    CHECK(text_of(second.result()) == text_of(whole.result()));
  }
}

TEST_CASE("a calibration that is stopped asks nothing more, and infers only if asked to") {
  Laboratory laboratory;
  prepare_for_calibration(laboratory);
  for (const bool infers : {false, true}) {
    const Laboratory stopped;
    auto store = stopped.store();
    StudyAnswers answers(std::make_shared<const Study>(laboratory.study), store, "study.json");
    Calibrator calibrator(answers);
    go_on(calibrator, answers, laboratory.options.engine, 1, 6);
    calibrator.stop(infers);
    CHECK(calibrator.finished());
    CHECK(calibrator.suggest(10).empty());
    CHECK(calibrator.result().search.status == CalibrationStatus::stopped);
    CHECK(calibrator.result().inference.has_value() == infers);
  }
}

TEST_CASE("a program that knows a candidate's parameters only is asked for fitted tests, to their end") {
  Laboratory laboratory;
  prepare_for_calibration(laboratory);
  auto store = laboratory.store();
  const auto study = std::make_shared<const Study>(laboratory.study);
  StudyAnswers answers(study, store, "study.json", Simulates::fitted_tests);
  Calibrator calibrator(answers);
  while (!calibrator.finished())
    for (const Simulation& one : calibrator.suggest(4)) {
      CHECK(one.test == 0);
      CHECK(one.study == study);
      CHECK_FALSE(one.may_end_early);
      StoredEvaluation evaluation = answers.unanswered(one);
      enter(evaluation, laboratory.options.engine.run(test_of(one), {}), {});
      REQUIRE(calibrator.ingest(one, evaluation).empty());
    }
  CHECK(calibrator.result().card.value().tests[1].readings.empty());
}
