#include "calibrate/card/compared_yield_stress.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "calibrate/card/card_description.h"

namespace pastefit {

std::vector<ComparedYieldStress> compared_yield_stresses(const CardTest& test) {
  Readings measured, simulated;
  for (const CardReading& one : test.readings) {
    simulated.set(one.name, one.simulated);
    if (one.measured) measured.set(one.name, *one.measured);
  }
  const std::vector<YieldStress> of_laboratory = yield_stresses_of(test.test, measured);
  std::vector<ComparedYieldStress> out;
  for (const YieldStress& one : yield_stresses_of(test.test, simulated)) {
    ComparedYieldStress compared{one.reading, one.formula, one.pa, {}, {}, {}};
    const auto same = std::ranges::find(of_laboratory, one.reading, &YieldStress::reading);
    if (same != of_laboratory.end()) compared.reading_pa = same->pa;
    if (const auto& known = test.yield_stress) {
      compared.ratio = one.pa / known->value;
      compared.deviations = (one.pa - known->value) / known->standard_deviation;
    }
    out.push_back(std::move(compared));
  }
  return out;
}

nlohmann::ordered_json yield_stresses_json(const CardTest& test) {
  const char* const key = "yield_stress_pa";
  nlohmann::ordered_json holder;
  OrderedObjectWriter writer(holder);
  card_fields::describe_yield_stresses(writer, key, compared_yield_stresses(test));
  return holder[key];
}

nlohmann::ordered_json with_yield_stresses(const Card& card) {
  nlohmann::ordered_json out = to_json(card);
  for (std::size_t i = 0; i < card.tests.size(); ++i)
    if (auto stresses = yield_stresses_json(card.tests[i]); !stresses.empty())
      out["tests"][i]["yield_stress_pa"] = std::move(stresses);
  return out;
}

nlohmann::ordered_json yield_stresses_json(const Test& test, const Readings& readings) {
  nlohmann::ordered_json out;
  for (const YieldStress& one : yield_stresses_of(test, readings))
    out[one.reading] = {{"formula", one.formula}, {"simulated", one.pa}};
  return out;
}

}  // namespace pastefit
