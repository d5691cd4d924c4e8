#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "calibrate/base/embedded_text.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/study/apparatus.h"
#include "calibrate/study/slump_sheet.h"
#include "calibrate/study/target_laws.h"

namespace pastefit {

using nlohmann::json;

TEST_CASE("a line that a starting file lacks is an error, not a value that is lost") {
  const TargetLaws laws = target_laws().front();
  CHECK_THROWS_AS(with_laws("{\n  \"parameters\": {\n  }\n}\n", laws), std::logic_error);
  CHECK_THROWS_AS(with_laws("{\n  \"contact\": {},\n}\n", laws), std::logic_error);
  CHECK_THROWS_AS(with_laws("{\n  \"contact\": {},\n  \"parameters\": {\n", laws), std::logic_error);
  std::string text = "one\n  two\n";
  CHECK_THROWS_AS(replace_lines(text, "three", {"3"}), std::logic_error);
  CHECK_THROWS_AS(replace_lines(text, "two", {"2"}, 2), std::logic_error);
  replace_lines(text, "two", {"2", "3"});
  CHECK(text == "one\n  2\n  3\n");
}

TEST_CASE("a study starts with the laws of its target, whichever they are") {
  for (const TargetLaws& laws : target_laws()) {
    INFO(laws.target << ", " << laws.law);
    const json study = json::parse(with_laws(template_text("study").value(), laws), nullptr, true, true);
    CHECK(study["contact"] == json(contact_of(laws)));
    CHECK(study["parameters"] == json(starting_parameters(laws.laws(), true)));
    CHECK(study["search"].is_object());
  }
}

TEST_CASE("every shipped preset with a mould has its starting file, with its lift speed, density and table") {
  int moulds = 0;
  for (const auto& file : std::filesystem::directory_iterator(PASTEFIT_SOURCE_DIR "/data/apparatus")) {
    if (file.path().extension() != ".json") continue;
    const std::string preset = file.path().stem().string();
    INFO(preset);
    const Test own = find_preset(preset, ".").value().test;
    const auto* test = std::get_if<SlumpTest>(&own);
    const Result<std::string> text = slump_lab_template(preset, ".");
    CHECK(text.ok() == (test != nullptr));
    if (!test) continue;
    ++moulds;
    const json lab = json::parse(text.value(), nullptr, true, true);
    CHECK(lab["apparatus"]["preset"] == preset);
    CHECK(lab["apparatus"]["lift_velocity_mm_s"].get<double>() == Approx(1e3 * test->lift_velocity_m_s));
    CHECK(lab["material"]["bulk_density_kg_m3"].get<double>() == Approx(test->bulk_density_kg_m3));
    CHECK(lab["grains"]["distribution"] == "uniform");
    CHECK_FALSE(lab["measurements"].empty());
  }
  CHECK(moulds > 5);
}

}  // namespace pastefit
