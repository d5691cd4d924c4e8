#include "calibrate/exports/export.h"
#include "calibrate/exports/known_laws.h"
#include "calibrate/exports/parameter_table.h"

namespace pastefit {

namespace {

constexpr const char* kJkrInstructions = R"(
How to use this in EDEM
1. Base model Hertz-Mindlin with JKR: shear modulus G = E/(2 (1 + nu)), Poisson's ratio, restitution, static friction and
   surface energy from the table above. EDEM's JKR is this law, surface_energy_j_m2 its surface energy; it lets go a third
   of a percent of the distance sooner.
2. Rolling friction: the standard model of EDEM is a torque against the spin.
3. Walls: surface_energy_j_m2 times the wall's cohesion_factor.
4. Grains: grains.csv is a filled mould at rest; import it as particle positions.
Nothing of this has been run in EDEM: pastefit's tests have no licence for it.
)";

constexpr const char* kEdemInstructions = R"(
How to use this in EDEM
1. Base model Hertz-Mindlin (no slip): shear modulus G = E/(2 (1 + nu)), Poisson's ratio, restitution, static friction
   from the table above. EDEM's damping is the same function of the restitution.
2. Rolling friction: the standard model of EDEM is a torque against the spin, not a spring and dashpot; with the small
   coefficients of pastes the difference is small, but it is one.
3. The attraction: EDEM has no such bridge. force.csv is the curve; a physics plug-in (API contact model) that
   interpolates it, scaled by s for other pairs of sizes, carries the law. Its contact radius has to exceed the radius
   of the grains by half of |d_c|.
   Without a plug-in, the nearest built-in model is Hertz-Mindlin with JKR. It has no attraction across a gap before
   touch. Choose its surface energy gamma for the same force at touch: gamma = 3 c/(8 pi R*), and run a slump test
   before you trust it.
4. Grains: grains.csv, if there is one, is a filled mould at rest; import it as particle positions.
Nothing of this has been run in EDEM: pastefit's tests have no licence for it.
)";

}  // namespace

Result<Export> export_edem_notes(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  const bool sticks = contact.normal == NormalLaw::jkr;
  KnownLaws known{"EDEM", {NormalLaw::hertz, NormalLaw::jkr}, kAllRolling};
  if (sticks) known.attraction = {BridgeShape::none};  // a plug-in takes the place of EDEM's own JKR
  if (Faults faults = unknown_laws(contact, known); !faults.empty()) return faults;
  if (sticks)
    return Export{law_files(scene, {{"edem.txt", laws_in_words(scene) + kJkrInstructions}}),
                  {"EDEM's JKR lets go of grains at 0.917 of the contact radius at which pastefit's does, a third of a "
                   "percent sooner in distance.",
                   "Not run in EDEM."}};
  return Export{
      law_files(scene, {{"edem.txt", laws_in_words(scene) + kEdemInstructions}}),
      {"EDEM has no bridge across a gap without a plug-in; its JKR attracts only after contact.", "Not run in EDEM."}};
}

}  // namespace pastefit
