#include "calibrate/card/rescale.h"

namespace pastefit {

Result<Card> rescaled(Card card, double radius) {
  if (const auto why = why_of_that_size(card.test); !why.empty())
    return Fault{"test", std::string(why),
                 "keep its grains; in a test of many grains the same material is another card"};
  const double s = radius / specimen_of(card.test).grains.radius_m;
  card.rescaled.push_back({specimen_of(card.test).grains.radius_m, {}});
  Faults all;
  for (const auto& [prefix, fitted, test, observables, baseline] : tests_of(card)) {
    if (why_of_that_size(test).empty()) {
      Specimen& specimen = specimen_of(test);
      specimen.grains = enlarged(specimen.grains, s);
      specimen.contact = enlarged(specimen.contact, s);
    }
    observables.clear();
    baseline = {};
    for (Fault fault : validate(test)) {
      fault.where = prefix + fault.where;
      all.push_back(std::move(fault));
    }
  }
  if (!all.empty()) return all;
  specimen_of(card.test).grains.radius_m = radius;  // s rounds
  for (auto& test : card.further) test.within_noise.reset();
  card.confirmation.packings.clear();
  card.confirmation.fresh = card.confirmation.meets_laboratory = false;
  card.confirmation.misfit = 0;
  card.search.reason = "The material was carried over from grains of another size and not confirmed there.";
  card.rebaselined.clear();
  return card;
}

}  // namespace pastefit
