#include <cmath>

#include "calibrate/base/text.h"
#include "calibrate/exports/elasto_plastic.h"
#include "calibrate/exports/export.h"
#include "calibrate/exports/nearest_law.h"
#include "calibrate/exports/parameter_table.h"
#include "core/laws/constants.h"

namespace pastefit {

namespace {

constexpr const char* kMercuryInstructions = R"(
How to use this in MercuryDPM
1. Species: HertzianViscoelasticMindlinRollingTorsionSpecies carries repulsion, damping, friction and rolling. Set the
   effective elastic modulus E* and shear modulus G* by hand (its setters take effective values), friction and rolling
   friction from the table above, torsion 0.
2. The attraction: none of the adhesive interactions that come with MercuryDPM has the curve above. Derive an
   adhesive species from LiquidBridgeWilletSpecies, which already has formation, memory and rupture of a bridge, and
   put that curve (or an interpolation of force.csv) in the place of its force; rupture distance -d_c, formation at
   formation_gap_m.
3. Grains: grains.csv, if there is one, is a filled mould at rest.
Nothing of this has been run in MercuryDPM: it is no package of Debian 12.
)";

/// Numbers of LinearPlasticViscoelasticNormalSpecies for two mean grains. Its unloading stiffness grows in proportion
/// to the deepest overlap, from k1 to its largest value at delta*; here delta* is twice the matched overlap, where it
/// is the card's.
std::string plastic_instructions(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  const double effective = 0.5 * scene.radius_m(), ratio = matched_overlap_ratio(scene);
  const bool linear = contact.normal == NormalLaw::luding;
  const double k1 = grain_pair(contact, scene.radius_m()).hertz * effective * (linear ? 1 : std::sqrt(ratio));
  const double k2 = k1 / (1 - contact.plasticity_ratio), largest = 2 * k2 - k1;
  const double depth = 2 * ratio * effective * (largest - k1) / largest / (2 * effective);
  return format(R"(
How to use this in MercuryDPM
1. Species: LinearPlasticViscoelasticFrictionSpecies. setPlasticParameters takes, of two mean grains,
     loading stiffness                %.9g N/m
     largest unloading stiffness      %.9g N/m
     cohesion stiffness               %.9g N/m
     largest penetration depth        %.9g of 2 R*
   It is the card's law where a contact was pressed %.4g mm deep; one that was pressed less is less plastic there, one
   that was pressed more than twice as deep is elastic.
2. Constant pull-off force (cohesion_n), friction, rolling friction and walls from the table above; torsion 0.
3. Grains: grains.csv, if there is one, is a filled mould at rest.
Nothing of this has been run in MercuryDPM: it is no package of Debian 12.
)",
                k1, largest, contact.adhesion_ratio * k1, depth, 1e3 * ratio * effective);
}

Export plastic_export(const ExportScene& scene) {
  return {
      law_files(scene, {{"mercurydpm.txt", laws_in_words(scene) + plastic_instructions(scene)}}),
      {"MercuryDPM's stiffness of unloading grows with the deepest overlap, the card's is constant: they are the same "
       "at "
       "one overlap only. Its stiffness is that of all pairs, the card's grows with R*.",
       "Its friction is a share of the size of the normal force, without the attraction.", "Not run in MercuryDPM."}};
}

}  // namespace

Result<Export> export_mercurydpm(const ExportScene& scene) {
  const KnownLaws known{"MercuryDPM", {NormalLaw::hertz, NormalLaw::epa, NormalLaw::luding}, kAllRolling};
  if (Faults faults = unknown_laws(scene.contact(), known); !faults.empty()) return faults;
  if (yields(scene.contact().normal)) return plastic_export(scene);
  return Export{
      law_files(scene, {{"mercurydpm.txt", laws_in_words(scene) + kMercuryInstructions}}),
      {"MercuryDPM has no such bridge as it comes; an adhesive species has to be derived.", "Not run in MercuryDPM."}};
}

}  // namespace pastefit
