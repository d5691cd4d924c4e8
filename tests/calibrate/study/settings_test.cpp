#include <algorithm>
#include <catch2/catch.hpp>

#include "calibrate/base/text.h"
#include "calibrate/study/study.h"
#include "calibrate/study/tests.h"

using namespace pastefit;

namespace {

const std::string kStudy = std::string(PASTEFIT_SOURCE_DIR) + "/data/studies/concrete-mix-79.json";

Study with(const std::vector<std::string>& settings) {
  auto study = read_study_with(kStudy, settings);
  if (!study.ok())
    for (const Fault& fault : study.faults()) UNSCOPED_INFO(fault.where << ": " << fault.what << "; " << fault.remedy);
  REQUIRE(study.ok());
  return std::move(study).value();
}

std::string refusal_of(const std::string& setting) {
  const auto study = read_study_with(kStudy, {setting});
  REQUIRE_FALSE(study.ok());
  return message_of(study.faults());
}

const Parameter& friction_in(const Study& study) {
  return *std::ranges::find(study.parameters, "friction", &Parameter::name);
}

}  // namespace

TEST_CASE("a setting changes a study as an edited file would: its inputs and its hash, and it keeps the settings") {
  const Study plain = with({}), changed = with({"parameters.friction.upper=0.8", "search.seed=7"});
  CHECK(friction_in(changed).upper == 0.8);
  CHECK(friction_in(changed).lower == friction_in(plain).lower);
  CHECK(changed.search.seed == 7);
  CHECK(changed.settings == std::vector<std::string>{"parameters.friction.upper=0.8", "search.seed=7"});
  CHECK(changed.hash != plain.hash);
  CHECK(inputs_of(changed) != inputs_of(plain));
  CHECK(with({"parameters.friction.free[1]=0.8", "search.seed=7"}).hash == changed.hash);
  CHECK(plain.settings.empty());
}

TEST_CASE("a fixed parameter is freed, and a free one fixed, by a setting") {
  CHECK_FALSE(friction_in(with({"parameters.friction={\"value\": 0.2}"})).free);
  CHECK(
      friction_in(with({"parameters.friction={\"value\": 0.2}", "parameters.friction={\"free\": [0.1, 0.9]}"})).upper ==
      0.9);
}

TEST_CASE("an unknown key or a bad value of a setting is the fault of a file with it: place and remedy") {
  CHECK_THAT(refusal_of("parameters.friction.maximum=0.8"),
             Catch::Contains("concrete-mix-79.json: parameters.friction.maximum: unknown key"));
  CHECK_THAT(refusal_of("parameters.fricton={\"value\": 1}"), Catch::Contains("did you mean \"friction\"?"));
  CHECK_THAT(refusal_of("serach.seed=3"), Catch::Contains("concrete-mix-79.json: serach: unknown key"));
  CHECK_THAT(refusal_of("search.budget_simulations=many"),
             Catch::Contains("search.budget_simulations: is the text \"many\""));
  CHECK_THAT(refusal_of("parameters.friction.upper=-1"), Catch::Contains("parameters.friction.free"));
  CHECK_THAT(refusal_of("search"), Catch::Contains("is not path=value"));
}

TEST_CASE("a bound of a parameter that is not free is answered with how to free it") {
  CHECK_THAT(refusal_of("parameters.fricton.upper=0.8"), Catch::Contains("did you mean \"friction\"?"));
  CHECK_THAT(refusal_of("parameters.restitution.upper=0.8"),
             Catch::Contains("not free") && Catch::Contains("parameters.restitution={\"free\": [LOWER, UPPER]}"));
}
