#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "calibrate/card/card.h"
#include "calibrate/check/check.h"
#include "calibrate/study/parameters.h"
#include "tests/calibrate/check/spoiled_engine.h"
#include "tests/calibrate/slump.h"

using namespace pastefit;

namespace {

/// A paste of 345 grains of 12 mm that slumps to a third of the mould, with both steps.
Card coarse_card() {
  Card card;
  card.title = "Coarse paste";
  auto values = default_values();
  const auto set = [&](std::string_view name, double value) {
    const auto kinds = parameter_kinds();
    values[std::ranges::find(kinds, name, &ParameterKind::name) - kinds.begin()] = value;
  };
  set("strength_pa", 1500);
  set("rupture_gap_ratio", 0.6);
  set("friction", 0.3);
  set("rolling_friction", 0.02);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& kind = parameter_kinds()[i];
    card.material.parameters.push_back({std::string(kind.name), false, values[i], 0, 0, kind.scale});
  }
  SlumpTest slump;
  slump.grains.radius_m = 0.012;
  slump.contact.friction_basis = FrictionBasis::total;
  slump.drop = DropPlate{};
  slump.lift_velocity_m_s = 0.2;
  card.tests.emplace_back().test = with_contact_of(with_default_contact(slump), values);
  const Specimen& specimen = specimen_of(card.tests[0].test);
  card.material.bulk_density_kg_m3 = specimen.bulk_density_kg_m3;
  card.material.grains = specimen.grains;
  card.material.contact = specimen.contact;
  return card;
}

Card with_baseline(Card card, int packings) {
  auto made = rebaselined(std::move(card), "first", packings, {});
  INFO((made.ok() ? "" : made.faults()[0].what));
  REQUIRE(made.ok());
  return std::move(made).value();
}

/// Readings of the test that lie outside the band of the noise; the law, which has none, does not count.
std::vector<std::string> caught_by_noise(const CardCheck& check) {
  std::vector<std::string> names;
  for (const auto& reading : check.readings)
    if (!reading.agrees() && !reading.name.starts_with("law.")) names.push_back(reading.name);
  return names;
}

bool law_agrees(const CardCheck& check) {
  return std::ranges::all_of(check.readings,
                             [](const auto& one) { return !one.name.starts_with("law.") || one.agrees(); });
}

/// A card that keeps two runs, and an engine whose answer is this height, at no cost.
Card quick_card(std::vector<double> heights) {
  Card card = coarse_card();
  card.tests[0].baseline.program = "here";
  std::uint64_t packing = 10;
  for (const double height : heights) {
    Readings readings;
    readings.set("step1.height_axis_mm", height);
    card.tests[0].baseline.runs.push_back({packing++, readings});
  }
  return card;
}

CheckEngine quick_engine(const std::string& program, std::vector<double> heights) {
  CheckEngine engine;
  engine.program = program;
  engine.prepare = [](const Test&, const RunOptions&) { return nullptr; };
  engine.run = of_slump([heights](const SlumpTest& test, const RunOptions&) {
    Outcome outcome;
    outcome.readings.set("step1.height_axis_mm", heights.at(test.packing_seed - 10));
    return outcome;
  });
  return engine;
}

}  // namespace

TEST_CASE("every test of a card is checked, and a reading carries the name of its test") {
  Card card = quick_card({100, 101});
  card.tests[0].name = "tall";
  CardTest lower;
  lower.name = "low";
  lower.test = card.tests[0].test;
  std::get<SlumpTest>(lower.test).mould.height_m *= 0.9;
  CardReading low;
  low.name = "step1.height_axis_mm";
  low.simulated = {2, 50, 1};
  lower.readings.push_back(low);
  card.confirmation.packings = {10, 11};
  card.tests.push_back(lower);
  const double height = std::get<SlumpTest>(card.tests[0].test).mould.height_m;

  const auto engine_with = [&](double read) {
    CheckEngine engine = quick_engine("there", {100, 101});
    engine.run = of_slump([=](const SlumpTest& test, const RunOptions&) {
      const double own = test.mould.height_m < height ? read : 100;
      Outcome outcome;
      outcome.readings.set("step1.height_axis_mm", own + static_cast<double>(test.packing_seed - 10));
      return outcome;
    });
    return engine;
  };
  CHECK(caught_by_noise(check(card, {}, engine_with(49.5))).empty());
  CHECK(caught_by_noise(check(card, {}, engine_with(250))) == std::vector<std::string>{"low/step1.height_axis_mm"});
  CHECK(check(card, {}, engine_with(49.5)).bits == SameBits::not_comparable);

  const auto again = rebaselined(card, "as it should be", 2, {}, engine_with(250));
  REQUIRE(again.ok());
  CHECK(again.value().tests[1].baseline.runs.size() == 2);
  CHECK(again.value().rebaselined.back().moved.back().reading == "low/step1.height_axis_mm");
  CHECK(check(again.value(), {}, engine_with(250)).bits == SameBits::same);
  CHECK(check(again.value(), {}, engine_with(251)).bits == SameBits::other);
  const auto read = card_from_json(to_json(again.value()));
  REQUIRE(read.ok());
  CHECK(read.value().tests[1].baseline.runs.size() == 2);
}

TEST_CASE("a card of several tests is carried to other grains in all of them") {
  Card card = quick_card({100, 101});
  card.tests[0].name = "tall";
  CardTest lower;
  lower.name = "low";
  lower.test = card.tests[0].test;
  CardReading low;
  low.name = "step1.height_axis_mm";
  low.measured = 48;
  low.weight = 1;
  low.tolerance = 5;
  lower.readings.push_back(low);
  CardReading met = low;  // the error is that of the worst reading, not a mean
  met.name = "step1.height_max_mm";
  met.measured = 60;
  lower.readings.push_back(met);
  card.tests.push_back(lower);
  const double radius = 1.25 * card.material.grains.radius_m;
  const auto carried = rescaled(card, radius);
  REQUIRE(carried.ok());
  CHECK(specimen_of(carried.value().tests[1].test).grains.radius_m == Approx(radius));
  CHECK(specimen_of(carried.value().tests[1].test).contact.bridge.c_n ==
        Approx(1.25 * 1.25 * card.material.contact.bridge.c_n));
  CHECK(carried.value().tests[1].readings.empty());

  CheckEngine engine = quick_engine("here", {});
  engine.run = of_slump([=](const SlumpTest& test, const RunOptions&) {
    Outcome outcome;
    outcome.readings.set("step1.height_max_mm", 60);
    outcome.readings.set("step1.height_axis_mm", 50 + 1000 * (test.grains.radius_m - 0.012));
    return outcome;
  });
  const auto measured = with_measured_bias(card, carried.value(), 2, {}, engine);
  REQUIRE(measured.ok());
  const Rescaling::Bias bias = measured.value().rescaled.back().bias.back();
  CHECK(bias.reading == "low/step1.height_axis_mm");
  CHECK(bias.after - bias.before == Approx(3));
  CHECK(measured.value().confirmation.error == Approx(1));
}

TEST_CASE("the noise of 24 packings shows bridges 20 % stronger, friction dropped, and a plate dropped twice",
          "[campaign]") {
  const Card card = with_baseline(coarse_card(), 24);
  const auto engine = engine_of(card);
  const CheckOptions options;

  const auto told = [](const char* change, const CardCheck& check) { UNSCOPED_INFO(text_of({change, check})); };

  const auto stronger = check(card, options, with_stronger_bridges(engine, 1.2));
  told("bridges 20 % stronger", stronger);
  CHECK(stronger.verdict == CheckVerdict::disagrees);
  CHECK_FALSE(caught_by_noise(stronger).empty());
  CHECK_FALSE(law_agrees(stronger));

  const auto slippery = check(card, options, without_friction(engine));
  told("friction dropped", slippery);
  CHECK(slippery.verdict == CheckVerdict::disagrees);
  CHECK(caught_by_noise(slippery).size() >= 3);
  CHECK(law_agrees(slippery));

  const auto twice = check(card, options, with_plate_dropped_twice(engine));
  told("plate dropped twice", twice);
  CHECK(twice.verdict == CheckVerdict::disagrees);
  const auto caught = caught_by_noise(twice);
  REQUIRE_FALSE(caught.empty());
  for (const auto& name : caught) CHECK_THAT(name, Catch::StartsWith("step2."));
}

TEST_CASE("any change that a force can tell is a change of bits, and the same program gives the same bits",
          "[campaign]") {
  const Card card = with_baseline(coarse_card(), 2);
  const CheckOptions quick{.quick = true};
  const auto same = check(card, quick);
  CHECK(same.verdict == CheckVerdict::agrees);
  CHECK(same.bits == SameBits::same);

  auto spoiled = with_one_bit_changed(engine_of(card));
  const auto changed = check(card, quick, spoiled);
  CHECK(changed.bits == SameBits::other);
  CHECK(changed.verdict == CheckVerdict::disagrees);
  CHECK_THAT(changed.reason, Catch::Contains("same bits"));
}

TEST_CASE("another program may give other bits within the noise, unless bits are asked for") {
  const Card card = quick_card({100, 104, 98, 102});
  CHECK(check(card, {}, quick_engine("here", {100, 104, 98, 102})).verdict == CheckVerdict::agrees);
  CHECK(check(card, {}, quick_engine("here", {100, 104, 98, 103})).verdict == CheckVerdict::disagrees);
  CHECK(check(card, {}, quick_engine("elsewhere", {101, 103, 99, 103})).verdict == CheckVerdict::agrees);
  CHECK(check(card, {}, quick_engine("elsewhere", {131, 133, 129, 133})).verdict == CheckVerdict::disagrees);
  const CheckOptions bits{.bits = true};
  CHECK(check(card, bits, quick_engine("elsewhere", {101, 103, 99, 103})).verdict == CheckVerdict::disagrees);
}

TEST_CASE("a card without single runs is checked by mean and deviation, one without noise not at all") {
  Card card = quick_card({});
  card.confirmation.packings = {10, 11, 12, 13};
  card.tests[0].readings = {{"step1.height_axis_mm", {1, 101, 2.6}, {}, 0, 0, 0}};
  const auto engine = quick_engine("elsewhere", {100, 104, 98, 102});
  const auto checked = check(card, {}, engine);
  CHECK(checked.verdict == CheckVerdict::agrees);
  CHECK(checked.bits == SameBits::not_comparable);
  card.confirmation.packings = {10};
  CHECK(check(card, {}, engine).verdict == CheckVerdict::not_checked);
}

TEST_CASE("a simulation that fails is a disagreement that names packing and reason") {
  const Card card = quick_card({100, 104});
  auto engine = quick_engine("elsewhere", {100, 104});
  engine.run = of_slump([](const SlumpTest& test, const RunOptions&) {
    Outcome outcome;
    if (test.packing_seed == 11) {
      outcome.failure = Failure{};
      outcome.failure->message = "It burst.";
    }
    outcome.readings.set("step1.height_axis_mm", 100);
    return outcome;
  });
  const auto checked = check(card, {}, engine);
  CHECK(checked.verdict == CheckVerdict::disagrees);
  CHECK_THAT(checked.reason, Catch::Contains("packing 11") && Catch::Contains("It burst."));
}

TEST_CASE("a new baseline keeps the packings, adds fresh ones, and records why and what moved") {
  Card card = quick_card({100, 104});
  card.search.packings = {1, 2};
  CheckEngine engine = quick_engine("there", {});
  engine.run = of_slump([](const SlumpTest& test, const RunOptions&) {
    Outcome outcome;
    outcome.readings.set("step1.height_axis_mm", 110 + 0.1 * static_cast<double>(test.packing_seed));
    return outcome;
  });
  const auto made = rebaselined(card, "the plate was mended", 4, {}, engine);
  REQUIRE(made.ok());
  const auto& baseline = made.value().tests[0].baseline;
  REQUIRE(baseline.runs.size() == 4);
  CHECK(baseline.runs[0].packing == 10);
  CHECK(baseline.runs[2].packing == 3);
  CHECK(baseline.program == "there");
  const auto& change = made.value().rebaselined.at(0);
  CHECK(change.why == "the plate was mended");
  CHECK(change.program_before == "here");
  CHECK(change.moved.at(0).before == Approx(102));
  CHECK(change.moved.at(0).after == Approx(110.7));
}

TEST_CASE("an old card is judged by new laboratory data within the noise of both") {
  Card card = quick_card({100, 104, 98, 102});
  const auto engine = quick_engine("elsewhere", {100, 104, 98, 102});
  Lab lab;
  lab.test = card.tests[0].test;
  lab.measurements = {{"step1.height_axis_mm", 104, 4, 3}};
  CHECK(check_against(card, lab, {}, engine).verdict == CheckVerdict::agrees);
  lab.measurements[0].value = 180;
  const auto checked = check_against(card, lab, {}, engine);
  CHECK(checked.verdict == CheckVerdict::disagrees);
  CHECK(checked.readings.at(0).expected == 180);
  std::get<SlumpTest>(lab.test).mould = {0.02, 0.01, 0.03};
  CHECK(check_against(card, lab, {}, engine).verdict == CheckVerdict::not_checked);
}

TEST_CASE("the bias of another grain size is measured, with its error") {
  const Card before = quick_card({100, 104});
  const auto after = rescaled(before, 0.006);
  REQUIRE(after.ok());
  CheckEngine engine = quick_engine("here", {});
  engine.run = of_slump([](const SlumpTest& test, const RunOptions&) {
    Outcome outcome;
    outcome.readings.set("step1.height_axis_mm",
                         1e4 * test.grains.radius_m + static_cast<double>(test.packing_seed % 2));
    return outcome;
  });
  const auto measured = with_measured_bias(before, after.value(), 4, {}, engine);
  REQUIRE(measured.ok());
  const auto& bias = measured.value().rescaled.back().bias.at(0);
  CHECK(bias.after - bias.before == Approx(-60));
  CHECK(bias.standard_error == Approx(std::sqrt(2 * (1.0 / 3) / 4)));
  CHECK(measured.value().tests[0].baseline.runs.size() == 4);
}

TEST_CASE("a card for other grains is judged as in a search: by its readings, and by the heaps that sheared off") {
  Card before = quick_card({100, 104});
  CardReading height;
  height.name = "step1.height_axis_mm";
  height.measured = 60;
  height.weight = 1;
  height.tolerance = 5;
  before.tests[0].readings = {height};
  const auto after = rescaled(before, 0.006);
  REQUIRE(after.ok());
  const auto judged = [&](double height_mm, std::uint64_t sheared) {
    CheckEngine engine = quick_engine("here", {});
    engine.run = of_slump([=](const SlumpTest& test, const RunOptions&) {
      Outcome outcome;
      const std::uint64_t packing = test.packing_seed - 70'001;
      outcome.readings.set("step1.height_axis_mm", height_mm + static_cast<double>(packing % 2));
      outcome.readings.set("step1.lateral_shift_mm", packing < sheared ? 300 : 5 + static_cast<double>(packing % 3));
      return outcome;
    });
    const auto card = with_measured_bias(before, after.value(), 8, {}, engine);
    REQUIRE(card.ok());
    return card.value().confirmation;
  };
  CHECK(judged(60, 0).meets_laboratory);
  CHECK_FALSE(judged(60, 4).meets_laboratory);
  CHECK(judged(60, 4).refuted);
  CHECK(judged(60, 4).error < 1);
  CHECK_FALSE(judged(60, 7).meets_laboratory);
  CHECK(judged(80, 0).refuted);
  CHECK_FALSE(judged(62, 0).refuted);
}

TEST_CASE("a reading has one line of 80 columns, whatever card and whether it agrees") {
  const std::string source = PASTEFIT_SOURCE_DIR;
  std::vector<std::filesystem::path> files{source + "/tests/calibrate/card/several_tests.json"};
  for (const auto& entry : std::filesystem::directory_iterator(source + "/data/cards"))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  REQUIRE(files.size() >= 4);
  for (const auto& file : files)
    for (const double off : {0.0, 100.0}) {
      const Card card = read_card(file).value();
      CheckEngine engine = quick_engine("here", {});
      engine.run = of_slump([&](const SlumpTest& test, const RunOptions&) {
        Outcome outcome;
        for (const auto& run : card.tests[0].baseline.runs)
          if (run.packing == test.packing_seed)
            for (const auto& [name, value] : run.readings.all()) outcome.readings.set(name, value + off);
        return outcome;
      });
      const CardCheck answer = check(card, {.quick = true}, engine);
      REQUIRE(answer.readings.size() > 6);
      std::istringstream text(text_of({file, answer}));
      std::string line;
      while (std::getline(text, line) && !line.starts_with("  reading ")) continue;
      CHECK(line.size() <= 80);
      for (const CheckedReading& reading : answer.readings) {
        std::getline(text, line);
        INFO(line);
        CHECK(line.substr(2).starts_with(reading.name + " "));
        CHECK(line.size() <= 80);
        CHECK(line.ends_with(reading.band > 0 ? format("%.3g", reading.band) : " none"));
      }
    }
}

TEST_CASE("the answers are text, JSON and JUnit, with what a card is called escaped") {
  CardCheck good, bad, unread;
  good.card = "good";
  good.verdict = CheckVerdict::agrees;
  bad.card = "bad";
  bad.verdict = CheckVerdict::disagrees;
  bad.reason = "3 < 5 & \"so\"";
  bad.readings = {{"step1.height_axis_mm", 100, 120, 5, 4, 4}};
  unread.reason = "there is no such file";
  const std::vector<CheckedFile> all{{"a.json", good, 1.5}, {"b<.json", bad, 0.25}, {"c.json", unread}};
  const auto json = to_json(all);
  CHECK(json["agree"] == 1);
  CHECK(json["disagree"] == 1);
  CHECK(json["not_checked"] == 1);
  CHECK_FALSE(json["cards"][1]["readings"]["step1.height_axis_mm"]["agrees"].get<bool>());
  const auto xml = junit_of(all);
  CHECK_THAT(xml, Catch::Contains("tests=\"3\" failures=\"1\" errors=\"1\"") && Catch::Contains("b&lt;.json") &&
                      Catch::Contains("3 &lt; 5 &amp; &quot;so&quot;") && Catch::Contains("<error"));
  CHECK_THAT(xml, Catch::Contains("\"pastefit check\" time=\"1.750\"") && Catch::Contains("a.json\" time=\"1.500\""));
  CHECK_THAT(text_of(all[1]), Catch::Contains("outside") && Catch::Contains("disagrees"));
}
