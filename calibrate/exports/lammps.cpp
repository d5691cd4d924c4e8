#include "calibrate/base/format.h"
#include "calibrate/exports/elasto_plastic.h"
#include "calibrate/exports/export.h"
#include "calibrate/exports/known_laws.h"
#include "calibrate/exports/lammps_deck.h"
#include "calibrate/exports/lammps_style.h"
#include "calibrate/exports/parameter_table.h"
#include "calibrate/verify/force_curve.h"

namespace pastefit {

namespace {

/// lmp_pastefit defines the variable (data/lammps/lmp_pastefit.cpp).
const char* const kGuard = R"guard(if "! $(is_defined(variable,pastefit_style))" then &
  "print 'This deck needs pair style pastefit: build style/ as NOTES.txt says, and run lmp_pastefit in place of lmp.'" &
  "quit 2"
if "${pastefit_style} != 1" then &
  "print 'This deck was written for version 1 of pair style pastefit: build lmp_pastefit from the style/ beside it.'" &
  "quit 2"
)guard";

const char* const kConventions = R"(#
# Conventions. Names and numbers of the laws are those of the card; style/README.md explains them.
#
)";

const std::string kBuild =
    "style/ is LAMMPS with the card's laws. Build it once, with Debian's liblammps-dev:\n"
    "    (cd style && " +
    lammps_style_build("../lmp_pastefit") +
    ")\n"
    "    ./lmp_pastefit -in DECK                  or: mpirun -np 2 ./lmp_pastefit -in DECK, which is in.slump or\n"
    "    in.two_grains\n";

/// " &" and a name with its number, on a line of its own.
std::string number(const char* name, double value) {
  return format(" &\n             %s ", name) + exact(value);
}

template <class T, std::size_t N>
std::string word(const char* name, T value, const std::array<Named<T>, N>& words) {
  return format(" &\n             %s ", name) + word_of(value, words);
}

std::string bridge_words(const Bridge& bridge) {
  std::string out = word("bridge", bridge.shape, bridge_shapes);
  if (bridge.shape == BridgeShape::none) return out;
  if (bridge.shape == BridgeShape::capillary)
    out += number("liquid_volume_m3", bridge.liquid_volume_m3) +
           number("surface_tension_n_m", bridge.surface_tension_n_m) +
           number("contact_angle_rad", bridge.contact_angle_rad);
  else
    out += number("c_n", bridge.c_n) + number("d_c_m", bridge.d_c_m);
  if (bridge.shape == BridgeShape::polynomial) out += number("a_n_m2", bridge.a_n_m2) + number("b_n_m", bridge.b_n_m);
  out += word("formation", bridge.formation, bridge_formations);
  if (bridge.formation == BridgeFormation::film) out += number("offset_m", bridge.offset_m);
  if (bridge.viscosity_pa_s > 0) out += number("viscosity_pa_s", bridge.viscosity_pa_s);
  return out;
}

/// Of Hertz nothing: the style's default.
std::string normal_words(const ContactModel& contact) {
  if (!yields(contact.normal)) return {};
  return word("normal", contact.normal, normal_laws) + number("plasticity_ratio", contact.plasticity_ratio) +
         number("adhesion_ratio", contact.adhesion_ratio);
}

/// Of Hertz, which has no reserve, net and total are the same.
FrictionBasis basis_of(const ContactModel& contact) {
  const bool net = contact.friction_basis == FrictionBasis::net;
  return net && !yields(contact.normal) ? FrictionBasis::total : contact.friction_basis;
}

std::string pair_style(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  const double radius = scene.radius_m();
  return "pair_style   pastefit" + number("reference_radius_m", radius) +
         number("youngs_modulus_pa", contact.youngs_modulus_pa) + number("poissons_ratio", contact.poissons_ratio) +
         number("restitution", contact.restitution) + number("friction", contact.friction) + normal_words(contact) +
         word("friction_basis", basis_of(contact), friction_bases) +
         number("rolling_friction", contact.rolling_friction) + word("rolling", contact.rolling, rolling_models) +
         number("cohesion_n", cohesion_n(contact, {radius, radius, radius})) + bridge_words(contact.bridge) +
         "\npair_coeff   * *\n";
}

std::string wall_words(const WallContact& wall) {
  return format("youngs_modulus_pa %.17g poissons_ratio %.17g restitution %.17g friction %.17g ",
                wall.youngs_modulus_pa, wall.poissons_ratio, wall.restitution, wall.friction) +
         format("rolling_friction %.17g cohesion_factor %.17g", wall.rolling_friction, wall.cohesion_factor);
}

/// LAMMPS of 2025 has the law, Debian's does not; not run by us.
std::string note_of_granular(const ExportScene& scene) {
  return "LAMMPS of 2025 and later has this law of its own, in pair_style granular. By its manual (we have not run "
         "it):\n    " +
         lammps_granular_words(scene) +
         "\n  in the order E, restitution, nu, plasticity ratio, f0, kc, exponents; choose rolling and damping beside "
         "it. kc "
         "is that of two mean grains, in N/m^n: compare other sizes and walls (kc times the cohesion factor) with "
         "in.two_grains first. Its friction adds kc d^n to the force on the adhesion branch only, the card's "
         "everywhere, and "
         "its tangential spring feels the contact radius of the plastic overlap.";
}

}  // namespace

Result<Export> export_lammps(const ExportScene& scene) {
  const KnownLaws known{
      "pair style pastefit", {NormalLaw::hertz, NormalLaw::epa, NormalLaw::luding}, kAllRolling, kAllAttractions, true};
  if (Faults faults = unknown_laws(scene.contact(), known); !faults.empty()) return faults;
  auto style = lammps_style();
  if (!style.ok()) return style.faults();
  LammpsLaws laws{"lmp_pastefit", kGuard, kConventions, pair_style(scene), {}, "wall/pastefit @", "", true};
  for (const auto& [name, wall] : walls_in_deck(scene)) laws.walls.push_back({name, wall_words(wall)});
  Export out;
  out.notes.push_back(
      "The laws are the card's, memory of bridges and walls included. LAMMPS integrates them with steps of a tenth of "
      "the Rayleigh time, without pastefit's protection of grains that have many damped contacts: do not lengthen "
      "them.");
  if (yields(scene.contact().normal)) out.notes.push_back(note_of_granular(scene));
  if (const SlumpTest* test = scene.slump(); test && test->drop) {
    if (test->drop->motion == TableMotion::vertical)
      out.notes.push_back("The deck runs step 1, on a square table. A table that falls upright is not part of it.");
    else if (test->drop->drops > 1)
      out.notes.push_back(
          format("The deck drops the plate once: the heap of step 2. The card's test goes on to %d drops.",
                 test->drop->drops));
  }
  out.instructions = kBuild;
  out.files = lammps_deck(scene, laws, out.notes, scene.packing.radii);
  for (auto& file : style.value()) out.files.push_back({"style/" + file.name, std::move(file.content)});
  if (scene.slump()) out.heap = "heap.dump";
  return out;
}

}  // namespace pastefit
