#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "calibrate/base/format.h"
#include "calibrate/exports/export.h"
#include "calibrate/exports/known_laws.h"
#include "calibrate/exports/lammps_deck.h"
#include "calibrate/exports/nearest_law.h"
#include "calibrate/exports/rolling_spring.h"
#include "calibrate/laboratory/names.h"
#include "calibrate/verify/force_curve.h"
#include "core/laws/constants.h"
#include "core/laws/table.h"
#include "core/world/world.h"

namespace pastefit {

namespace {

/// `version` of LAMMPS is a date as a number; an older program would misread the deck.
const char* const kVersionGuard = R"(variable     program_version equal version
if "${program_version} < 20210929" then &
  "print 'This deck needs LAMMPS of 29 September 2021 or later (pair style granular with mindlin_rescale/force).'" &
  "quit 2"
)";

const char* const kTableConventions = R"(#
# Conventions. normal "hertz k e": k = 4/3 E*, force k sqrt(R*) d^1.5. "damping tsuji": LAMMPS turns e into the factor of
# sqrt(m* k a) by a polynomial; e below is chosen such that the factor is sqrt(5) beta(e of the card), which is the
# damping 2 sqrt(5/6) beta sqrt(S_n m*). tangential: stiffness 8 G*, damping ratio sqrt(4 G*/E*), friction.
# jkr, dmt: Young's modulus and Poisson's ratio of the grains instead of k, surface energy.
# rolling sds: stiffness, dashpot, friction. Walls: E*, G* of grain and wall. Attraction: tables, negative = pull.
#
)";

constexpr int kTablePoints = 4001;
constexpr double kDeepest = 0.3;  // of the smaller radius; LAMMPS stops at grains that overlap more

/// The polynomial by which LAMMPS's "damping tsuji" turns a restitution into its coefficient (pair_style granular).
double tsuji(double e) {
  constexpr std::array<double, 7> kFactors{1.2728, -4.2783, 11.087, -22.348, 27.467, -18.022, 4.8218};
  double sum = 0;
  for (std::size_t i = kFactors.size(); i-- > 0;) sum = sum * e + kFactors[i];
  return sum;
}

/// The restitution to give to LAMMPS for the damping of ours: gamma sqrt(m* 4/3 E* a) = 2 sqrt(5/6) beta sqrt(m* 2 E*
/// a) asks for gamma = sqrt(5) beta. LAMMPS's own number would damp a third less.
double lammps_restitution(double restitution) {
  const double wanted = std::sqrt(5.0) * damping_ratio(restitution);
  double low = 0, high = 1;  // the polynomial falls all the way
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (tsuji(middle) > wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

bool sticks(const ContactModel& contact) {
  return contact.normal != NormalLaw::hertz && contact.surface_energy_j_m2 > 0;
}

/// The law of the overlap with its numbers. Grains that stick give LAMMPS their own modulus and surface energy, which
/// has the convention of the card.
std::string normal_model(const ContactModel& contact) {
  const double restitution = lammps_restitution(contact.restitution);
  if (!sticks(contact)) return format("hertz %.17g %.17g", grain_pair(contact, 1).hertz, restitution);
  return format("%s %.17g %.17g %.17g %.17g", contact.normal == NormalLaw::jkr ? "jkr" : "dmt",
                contact.youngs_modulus_pa, restitution, contact.poissons_ratio, contact.surface_energy_j_m2);
}

std::string normal_model(const PairConstants& wall, double restitution) {
  return format("hertz %.17g %.17g", wall.hertz, lammps_restitution(restitution));
}

/// Radius of a contact under a load [m].
double resting_patch(const ContactModel& contact, const GrainPair& pair, double load) {
  const double radius = pair.effective_radius_m();
  if (!sticks(contact)) return std::sqrt(radius * resting_overlap_m(contact, pair, load));
  const PairConstants constants = grain_pair(contact, pair.reference_radius_m);
  return with_law(NormalLaws{}, contact.normal, [&](auto law) {
    return law.at(constants, std::sqrt(radius), law.overlap_under(constants, radius, load), 0.0).contact_radius;
  });
}

/// "hertz ... damping tsuji" of a pair whose contacts rest with this radius.
std::string granular_model(const std::string& normal, const PairConstants& pair, RollingModel rolling,
                           double effective_mass, double resting_patch) {
  const double shear = pair.tangential_ratio * pair.normal_stiffness;
  std::string out = normal + format(" tangential mindlin_rescale/force %.17g %.17g %.17g", shear,
                                    std::sqrt(pair.tangential_ratio), pair.friction);
  if (rolling != RollingModel::none && pair.rolling_friction > 0) {
    const double stiffness = pair.normal_stiffness * resting_patch;
    const double lever = rolling_spring_lever(rolling, pair.rolling_friction);
    const double dashpot = 0.6 * std::sqrt(1.4 * 2.25) * lever * std::sqrt(stiffness * effective_mass);
    out += format(" rolling sds %.17g %.17g %.17g", 2.25 * stiffness * lever * lever, dashpot, pair.rolling_friction);
  }
  return out + " damping tsuji";
}

/// One table, equidistant in r^2 with a point at touch and the last one at rupture: what LAMMPS uses as it stands.
/// Columns: number, r, energy, force; negative forces attract.
std::string table_text(const ContactModel& contact, const GrainPair& pair, const std::string& name, double& cutoff) {
  const double touch = pair.first_radius_m + pair.second_radius_m;
  const double reach = bridge_gaps(contact, pair).rupture_m;
  const double deepest = touch - kDeepest * std::min(pair.first_radius_m, pair.second_radius_m);
  cutoff = touch + reach;
  const double outside = cutoff * cutoff - touch * touch, inside = touch * touch - deepest * deepest;
  const int last = kTablePoints - 1;
  const int steps = std::clamp(static_cast<int>(last * outside / (outside + inside)), 1, last - 1);
  const double h = outside / steps;
  const double smallest = std::sqrt(cutoff * cutoff - last * h);
  std::string out = format("%s\nN %d RSQ %.17g %.17g\n\n", name.c_str(), kTablePoints, smallest, cutoff);
  for (int i = 0; i <= last; ++i) {
    const int from_touch = i - (last - steps);
    const double r = i == last ? cutoff : std::sqrt(std::max(touch * touch + from_touch * h, smallest * smallest));
    const double overlap = i == last ? -reach : (from_touch == 0 ? 0.0 : touch - r);
    const double in_overlap = overlap > 0 ? bridge_work_j(contact, pair, -overlap, 0) : 0;
    const double energy = -in_overlap - bridge_work_j(contact, pair, std::max(-overlap, 0.0), reach);
    out += format("%d %.17g %.17g %.17g\n", i + 1, r, energy, -attraction_n(contact, pair, overlap));
  }
  return out + "\n";
}

double mass_of(double radius, double density) {
  return 4.0 / 3.0 * std::acos(-1.0) * radius * radius * radius * density;
}

Faults lacking(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  KnownLaws known{
      "LAMMPS's granular style with tables", {NormalLaw::hertz, NormalLaw::jkr, NormalLaw::dmt}, kAllRolling};
  if (contact.normal == NormalLaw::jkr) known.attraction = {BridgeShape::none};
  Faults faults = unknown_laws(contact, known);
  for (const auto& [name, wall] : walls_of(scene.test))
    if (wall.cohesion_factor > 0)
      faults.push_back({"test." + name + "_wall.cohesion_factor", "is not 0, but the deck's walls attract no grain",
                        contact.normal != NormalLaw::hertz
                            ? "calibrate with " + name + "_cohesion_factor 0"
                            : "export with --to lammps, or calibrate with " + name + "_cohesion_factor 0"});
  return faults;
}

std::vector<std::string> losses_of_sticking(const ContactModel& contact, double radius) {
  if (!sticks(contact)) return {};
  const bool jkr = contact.normal == NormalLaw::jkr;
  const double pull_off = (jkr ? 3 : 4) * std::numbers::pi * contact.surface_energy_j_m2 * 0.5 * radius;
  std::vector<std::string> notes;
  if (jkr)
    // d where the pull is largest, y^3 = 3, over d at the end of the contact, y = 1 (core/laws/jkr.h).
    notes.push_back(
        format("Grains part in LAMMPS where their pull is largest (%.3g N), at %.3g of the gap up to which the card's "
               "stay in contact. To part them costs less by the work in between.",
               pull_off, std::cbrt(3.0) / 3));
  // LAMMPS's friction limit: of JKR the force and twice the pull-off, of DMT the net force alone.
  const double held = jkr ? 2 * pull_off : 0;
  const std::string limit = jkr ? "of that force and twice the largest pull" : "of the net force";
  const Sticking grains = sticking_of(contact, 0.5 * radius);
  const double on_card = held_normal_force_n(contact, grains);
  if (std::abs(held - on_card) > 1e-6 * pull_off)
    notes.push_back(
        format("The card's friction is of the %s normal force, LAMMPS's %s. Two grains that only stick hold "
               "%.3g N in the deck, %.3g N on the card.",
               word_of(contact.friction_basis, friction_bases).c_str(), limit.c_str(), contact.friction * held,
               contact.friction * on_card));
  if (!jkr && contact.friction_basis != FrictionBasis::net)
    notes.push_back(
        "So the deck's heap is lower: of a material of 2.86 J/m^2, friction 0.3 and grains of 12 mm, 61 +- 5 mm for 86 "
        "+- 2 mm on the card with friction of the elastic force, 60 +- 3 for 88 +- 7 mm of the total force, and 65 +- "
        "4 for 64 +- 5 mm of the net force, which is the same law (LAMMPS of 29 September 2021, three packings). "
        "Calibrate with \"friction_basis\": \"net\" for this deck.");
  return notes;
}

std::vector<std::string> table_losses(const ExportScene& scene, double weight) {
  const ContactModel& contact = scene.contact();
  const double radius = scene.radius_m();
  const GrainPair pair = scene.mean_pair();
  const auto gaps = bridge_gaps(contact, pair);
  std::vector<std::string> notes = losses_of_sticking(contact, radius);
  if (gaps.remembers()) {
    const double whole = bridge_work_j(contact, pair, 0, gaps.rupture_m);
    const double early = bridge_work_j(contact, pair, gaps.formation_m, gaps.rupture_m);
    notes.push_back(
        format("A table has no memory. The card's bridge forms at a gap of %.4g mm and ruptures at %.4g mm; "
               "in the deck grains attract each other already on their way to each other. Each new bridge "
               "gains %.3g J too early, %.1f %% of the work of the bridge (%.3g J).",
               1e3 * gaps.formation_m, 1e3 * gaps.rupture_m, early, 100 * early / whole, whole));
  }
  const double pull = cohesion_n(contact, pair);
  if (contact.friction_basis != FrictionBasis::elastic && pull > 0)
    notes.push_back(
        format("The card's friction is of the total normal force; LAMMPS's granular style, which does not "
               "see the table, takes that of the elastic force. Under the weight of ten grains its limit "
               "is %.3g N in the deck, %.3g N on the card: the material of the deck is stiffer.",
               contact.friction * (10 * weight + pull), contact.friction * 10 * weight));
  if (contact.rolling == RollingModel::spring_dashpot && contact.rolling_friction > 0)
    notes.push_back(
        "The rolling spring is constant, that of a contact at rest under the weight of ten grains; on the "
        "card it grows with the root of the overlap. The largest rolling moment is the same.");
  if (const auto note = note_of_constant_torque(scene, 10 * weight); !note.empty()) notes.push_back(note);
  if (contact.rolling != RollingModel::none && contact.rolling_friction > 0 && pull == 0 && !sticks(contact))
    notes.push_back(
        "Heaps of grains that roll and do not stick are lower in the deck, for a reason that is not known: 60 +- 3 mm "
        "for "
        "74 +- 3 mm on the card at friction 0.5, rolling friction 0.1 and grains of 12 mm (three packings). Use --to "
        "lammps.");
  if (!scene.slump() && pull > 0 && scene.grains().distribution != SizeDistribution::mono)
    notes.push_back(
        "The table is that of two grains of the mean radius. Grains of other sizes want tables of their own: that of "
        "a pair goes with s^2 in force and with s in distance, s its R* over that of two mean grains.");
  if (scene.sizes.radii_m.size() > 1)
    notes.push_back(
        format("Grains take the radius of their class, %zu classes; the largest change of a radius is "
               "%.2f %%.",
               scene.sizes.radii_m.size(), 100 * scene.sizes.largest_change));
  if (scene.slump() && scene.slump()->drop)
    notes.push_back(scene.slump()->drop->motion == TableMotion::hinged
                        ? "The deck runs step 1. The drop of the plate, step 2, needs --to lammps."
                        : "The deck runs step 1, on a square table. A table that falls upright is not part of it.");
  return notes;
}

}  // namespace

Result<Export> export_lammps_tables(const ExportScene& scene) {
  if (auto faults = lacking(scene); !faults.empty()) return faults;
  const auto& sizes = scene.sizes.radii_m;
  const ContactModel& contact = scene.contact();
  const double radius = scene.radius_m(), density = scene.grain_density_kg_m3;
  const double load = 10 * mass_of(radius, density) * kGravity;
  const GrainPair mean = scene.mean_pair();
  const bool attracts = cohesion_n(contact, mean) > 0 || attraction_n(contact, mean, 0) > 0;

  LammpsLaws laws{"lmp", kVersionGuard, kTableConventions, {}, {}, "wall/gran/region", " region @", false};
  const std::string style = attracts ? format("pair_style   hybrid/overlay granular table linear %d\n", kTablePoints)
                                     : "pair_style   granular\n";
  const PairConstants grains = grain_pair(contact, radius);
  std::string tables = "# attraction of two grains; read by \"pair_coeff ... table\"\n\n";
  for (std::size_t i = 0; i < sizes.size(); ++i)
    for (std::size_t j = i; j < sizes.size(); ++j) {
      const GrainPair pair{sizes[i], sizes[j], radius};
      const double first = mass_of(sizes[i], density), second = mass_of(sizes[j], density);
      const std::string types = format("pair_coeff   %zu %zu ", i + 1, j + 1);
      laws.pairs += types + (attracts ? "granular " : "") +
                    granular_model(normal_model(contact), grains, contact.rolling, first * second / (first + second),
                                   resting_patch(contact, pair, load)) +
                    "\n";
      if (attracts) {
        const std::string name = format("ATTRACTION_%zu_%zu", i + 1, j + 1);
        double cutoff = 0;
        tables += table_text(contact, pair, name, cutoff);
        laws.pairs += types + format("table attraction.table %s %.17g\n", name.c_str(), cutoff);
      }
    }
  laws.pairs = style + laws.pairs;

  const GrainPair on_wall{2 * radius, 2 * radius, radius};  // R* = radius
  const auto wall = [&](const std::string& name, const WallContact& surface) {
    const PairConstants pair = wall_pair(contact, surface, radius);
    const double overlap = std::pow(load / (pair.hertz * std::sqrt(radius)), 2.0 / 3.0);
    return LammpsWall{name, "granular " + granular_model(normal_model(pair, surface.restitution), pair, contact.rolling,
                                                         mass_of(radius, density),
                                                         std::sqrt(on_wall.effective_radius_m() * overlap))};
  };
  for (const auto& [name, surface] : walls_in_deck(scene)) laws.walls.push_back(wall(name, surface));

  std::vector<double> radii;
  for (const int type : scene.sizes.class_of) radii.push_back(sizes[type]);

  Export out;
  out.instructions = "lmp -in DECK              or: mpirun -np 2 lmp -in DECK, which is in.slump or in.two_grains\n";
  out.notes = table_losses(scene, load / 10);
  out.files = lammps_deck(scene, laws, out.notes, radii);
  if (attracts) out.files.push_back({"attraction.table", tables});
  if (attracts && (bridge_gaps(contact, mean).remembers() || contact.friction_basis != FrictionBasis::elastic))
    out.own_law = R"("contact": {"friction_basis": "elastic"} and "formation_ratio": {"value": 1})";
  if (scene.slump()) out.heap = "heap.dump";
  return out;
}

}  // namespace pastefit
