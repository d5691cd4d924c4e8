#include "calibrate/card/rescale.h"

#include <algorithm>

namespace pastefit {

Result<Card> rescaled(Card card, double radius) {
  const auto has_that_size = [](const CardTest& test) { return !why_of_that_size(test.test).empty(); };
  if (const auto of_its_size = std::ranges::find_if(card.tests, has_that_size);
      of_its_size != card.tests.end() &&
      specimen_of(of_its_size->test).grains.radius_m == card.material.grains.radius_m)
    return Fault{"tests[" + std::to_string(of_its_size - card.tests.begin()) + "].test",
                 std::string(why_of_that_size(of_its_size->test)),
                 "keep its grains; in a test of many grains the same material is another card"};
  const double old_radius = card.material.grains.radius_m, s = radius / old_radius;
  const auto carry = [&](GrainSizes& grains, ContactModel& contact) {
    const bool of_that_radius = grains.radius_m == old_radius;
    grains = enlarged(grains, s);
    if (of_that_radius) grains.radius_m = radius;  // s rounds
    contact = enlarged(contact, s);
  };
  carry(card.material.grains, card.material.contact);
  card.rescaled.push_back({old_radius, {}});
  Faults all;
  for (CardTest& test : card.tests) {
    Specimen& specimen = specimen_of(test.test);
    if (!has_that_size(test)) carry(specimen.grains, specimen.contact);
    test.readings.clear();
    test.within_noise.reset();
    test.baseline = {};
    for (Fault fault : validate(test.test)) {
      fault.where = heading_of(test) + fault.where;
      all.push_back(std::move(fault));
    }
  }
  if (!all.empty()) return all;
  card.confirmation.packings.clear();
  card.confirmation.fresh = card.confirmation.meets_laboratory = card.confirmation.refuted = false;
  card.confirmation.error = 0;
  card.search.reason = "The material was carried over from grains of another size and not confirmed there.";
  card.rebaselined.clear();
  card.further_confirmations.clear();
  return card;
}

}  // namespace pastefit
