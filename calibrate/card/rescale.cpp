#include "calibrate/card/rescale.h"

namespace pastefit {

Result<Card> rescaled(Card card, double radius) {
  const double s = radius / card.test.grains.radius_m;
  card.rescaled.push_back({card.test.grains.radius_m, {}});

  GrainSizes& grains = card.test.grains;
  grains.radius_m = radius;
  grains.standard_deviation_m *= s;
  grains.smallest_m *= s;
  grains.largest_m *= s;
  card.test.contact = enlarged(card.test.contact, s);

  if (auto faults = validate(card.test); !faults.empty()) return faults;
  card.observables.clear();
  card.further.clear();
  card.confirmation.packings.clear();
  card.confirmation.fresh = card.confirmation.meets_laboratory = false;
  card.confirmation.misfit_mm = 0;
  card.search.reason = "The material was carried over from grains of another size and not confirmed there.";
  card.baseline = {};
  card.rebaselined.clear();
  return card;
}

}  // namespace pastefit
