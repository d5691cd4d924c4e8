#include "calibrate/exports/export.h"
#include "calibrate/exports/known_laws.h"
#include "calibrate/exports/parameter_table.h"

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

}  // namespace

Result<Export> export_mercurydpm(const ExportScene& scene) {
  const KnownLaws known{"MercuryDPM", {NormalLaw::hertz}, kAllRolling};
  if (Faults faults = unknown_laws(scene.contact(), known); !faults.empty()) return faults;
  return Export{
      law_files(scene, {{"mercurydpm.txt", laws_in_words(scene) + kMercuryInstructions}}),
      {"MercuryDPM has no such bridge as it comes; an adhesive species has to be derived.", "Not run in MercuryDPM."}};
}

}  // namespace pastefit
