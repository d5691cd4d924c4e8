#include "calibrate/calibrate.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "calibrate/store/program.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"
#include "tests/calibrate/folder.h"

using namespace pastefit;
using namespace pastefit::test;

namespace {

/// A shipped study with coarse grains, its strength alone, and a wide tolerance.
Study coarse_study() {
  Study study = read_study(PASTEFIT_SOURCE_DIR "/data/studies/concrete-mix-20.json").value();
  specimen_of(study.tests.at(0).lab.test).grains.radius_m = 0.018;
  for (Parameter& parameter : study.parameters) {
    if (!parameter.free || parameter.name == "strength_pa") continue;
    parameter.value = value_between(parameter, 0.5);
    parameter.free = false;
  }
  study.search.screening = 3;
  study.search.budget_simulations = 12;
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

}  // namespace

TEST_CASE("one call makes a card, and the same card again from its store without a simulation") {
  const Folder folder;
  const Study study = coarse_study();
  auto store = store_in(folder, study);
  const auto first = calibrate(study, store, {.threads = 1}).value();
  REQUIRE(first.card);
  CHECK(first.card->search.status == name_of(CalibrationStatus::confirmed));
  CHECK(first.counts.simulated > 0);
  CHECK(first.counts.simulated <= 12);
  const auto second = calibrate(study, store, {.threads = 2}).value();
  REQUIRE(second.card);
  CHECK(second.counts.simulated == 0);
  CHECK(to_json(*second.card) == to_json(*first.card));
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
