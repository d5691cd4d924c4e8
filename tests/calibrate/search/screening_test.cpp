#include "calibrate/search/screening.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "answered.h"
#include "calibrate/card/card.h"
#include "calibrate/evaluate/study_scoring.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/study.h"
#include "fake_slump.h"

using namespace pastefit;
using namespace pastefit::synthetic;

namespace {

Study concrete_79() {
  return read_study(PASTEFIT_SOURCE_DIR "/data/studies/concrete-mix-79.json").value();
}

void measure(StudyTest& test, double height_mm) {
  for (Measurement& one : test.lab.measurements)
    if (one.reading == "step1.height_mm") one.value = height_mm;
}

/// The strengths [Pa] that a screening of a study goes through; the strength is its first free parameter.
LikelyRange screened(const Study& study) {
  const UnitBox box = StudyScoring(study).likely_box();
  const Parameter& strength = study.parameters.front();
  CHECK(box.lower.tail(box.lower.size() - 1).isZero());
  CHECK(box.upper.tail(box.upper.size() - 1).isOnes());
  return {value_between(strength, box.lower[0]), value_between(strength, box.upper[0])};
}

}  // namespace

TEST_CASE(
    "a screening looks for strengths from the yield stress of the height to the upper bound or a hundred times as "
    "much") {
  Study study = concrete_79();
  CHECK(screened(study).lowest == Approx(411.3).epsilon(1e-3));
  CHECK(screened(study).highest == Approx(40000));
  study.parameters.front().upper = 1e6;
  CHECK(screened(study).highest == Approx(100 * 411.3).epsilon(1e-3));
}

TEST_CASE("a heap that friction may hold up has no least strength, and one as high as its mould any") {
  Study study = concrete_79();
  measure(study.tests[0], 90);
  CHECK(screened(study).lowest == Approx(10));
  CHECK(screened(study).highest == Approx(100 * 231).epsilon(0.01));
  measure(study.tests[0], 300);
  CHECK(screened(study).lowest == Approx(10));
  CHECK(screened(study).highest == Approx(40000));
}

TEST_CASE("tests that ask for different strengths leave a screening the bounds") {
  Study study = concrete_79();
  study.tests.push_back(study.tests[0]);
  study.tests[0].name = "stiff";
  study.tests[1].name = "weak";
  measure(study.tests[0], 280);
  CHECK(screened(study).lowest == Approx(1300).epsilon(0.1));  // both have more than a weak heap has at most
  measure(study.tests[1], 8);
  CHECK(screened(study).lowest == Approx(10));
  CHECK(screened(study).highest == Approx(40000));
}

TEST_CASE("the strengths of the shipped cards lie where their heights say") {
  for (const char* name : {"concrete-mix-20", "concrete-mix-79"}) {
    CAPTURE(name);
    const Card card = read_card(std::string(PASTEFIT_SOURCE_DIR) + "/data/cards/" + name + ".json").value();
    Readings measured;
    for (const CardReading& one : card.tests[0].readings)
      if (one.measured) measured.set(one.name, *one.measured);
    const auto likely = likely_strength_pa(std::get<SlumpTest>(card.tests[0].test), measured);
    REQUIRE(likely);
    const double strength_pa = card.material.parameters.front().value;
    CHECK(strength_pa > likely->lowest);
    CHECK(strength_pa < likely->highest);
  }
}

TEST_CASE("a screening stays in the likely part of the bounds, and fills it") {
  struct Known : Synthetic {
    explicit Known(const Synthetic& other) : Synthetic(other) {}
    UnitBox likely_box() const override {
      UnitBox box = Synthetic::likely_box();
      box.lower[0] = 0.4;
      box.upper[0] = 0.6;
      return box;
    }
  };
  Known slump(fake_slump(150, 1));
  SearchOptions options;
  options.screening = 15;
  Answered answered(slump);
  const std::function<void(const Progress&)> unheard;
  StrategyState state(answered.queue, options, {}, unheard);
  ScreeningPhase phase(state, Fidelity::fine);
  answered.run(phase, state.history);
  double lowest = 1, highest = 0, lowest_of_second = 1;
  for (const Response& one : state.history.singles()) {
    lowest = std::min(lowest, one.point[0]);
    highest = std::max(highest, one.point[0]);
    lowest_of_second = std::min(lowest_of_second, one.point[1]);
  }
  CHECK(state.history.singles().size() == 15);
  CHECK((lowest >= 0.4 && lowest < 0.45));
  CHECK((highest <= 0.6 && highest > 0.55));
  CHECK(lowest_of_second < 0.1);
}
