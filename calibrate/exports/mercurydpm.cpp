#include <cmath>

#include "calibrate/base/embedded_text.h"
#include "calibrate/base/text.h"
#include "calibrate/exports/elasto_plastic.h"
#include "calibrate/exports/export.h"
#include "calibrate/exports/nearest_law.h"
#include "core/laws/constants.h"

namespace pastefit {

namespace {

/// Writes parameters of LinearPlasticViscoelasticNormalSpecies for two mean grains. Its unloading stiffness is linear
/// in the largest overlap, from k1 to its maximum at delta*. Here delta* is twice the matched overlap, at which the
/// stiffness is the card's.
Export plastic_export(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  const double effective = 0.5 * scene.radius_m(), ratio = matched_overlap_ratio(scene);
  const bool linear = contact.normal == NormalLaw::luding;
  const double k1 = grain_pair(contact, scene.radius_m()).hertz * effective * (linear ? 1 : std::sqrt(ratio));
  const double k2 = k1 / (1 - contact.plasticity_ratio), largest = 2 * k2 - k1;
  const double depth = 2 * ratio * effective * (largest - k1) / largest / (2 * effective);
  const std::string text =
      filled_in("exports/texts/mercurydpm_plastic.txt", {{"laws", laws_in_words(scene)},
                                                         {"loading", format("%.9g", k1)},
                                                         {"unloading", format("%.9g", largest)},
                                                         {"cohesion", format("%.9g", contact.adhesion_ratio * k1)},
                                                         {"depth", format("%.9g", depth)},
                                                         {"matched", format("%.4g", 1e3 * ratio * effective)}});
  return {
      law_files(scene, {{"mercurydpm.txt", text}}),
      {"MercuryDPM's stiffness of unloading grows with the deepest overlap, the card's is constant: they are the same "
       "at one overlap only. Its stiffness is that of all pairs, the card's grows with R*.",
       "Its friction is a share of the size of the normal force, without the attraction.", "Not run in MercuryDPM."}};
}

}  // namespace

Result<Export> export_mercurydpm(const ExportScene& scene) {
  const KnownLaws known{"MercuryDPM", {NormalLaw::hertz, NormalLaw::epa, NormalLaw::luding}, kAllRolling};
  if (Faults faults = unknown_laws(scene.contact(), known); !faults.empty()) return faults;
  if (yields(scene.contact().normal)) return plastic_export(scene);
  return Export{
      law_files(scene, {{"mercurydpm.txt",
                         filled_in("exports/texts/mercurydpm_bridge.txt", {{"laws", laws_in_words(scene)}})}}),
      {"MercuryDPM has no such bridge as it comes; an adhesive species has to be derived.", "Not run in MercuryDPM."}};
}

}  // namespace pastefit
