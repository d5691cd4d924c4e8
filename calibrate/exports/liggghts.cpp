#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibrate/base/embedded_text.h"
#include "calibrate/base/text.h"
#include "calibrate/exports/elasto_plastic.h"
#include "calibrate/exports/export.h"
#include "calibrate/exports/lammps_deck.h"
#include "calibrate/exports/liggghts_deck.h"
#include "calibrate/exports/nearest_law.h"
#include "calibrate/store/program.h"
#include "calibrate/verify/force_curve.h"

namespace pastefit {

namespace {

Models models_of(const ContactModel& contact, bool attracts) {
  if (yields(contact.normal)) {
    const std::string both = edinburgh_models(contact);
    return {both, both, kEdinburghSettings, kEdinburghSettings};
  }
  std::string rolling;
  if (contact.rolling != RollingModel::none && contact.rolling_friction != 0)
    rolling = contact.rolling == RollingModel::constant_torque ? " rolling_friction cdt" : " rolling_friction epsd";
  const std::string base = "model hertz tangential history";
  const std::string reduce = contact.friction_basis != FrictionBasis::elastic ? "tangential_reduce on" : "";
  if (contact.normal == NormalLaw::sjkr) {
    const std::string both = base + " cohesion sjkr2" + rolling;
    return {both, both, reduce, reduce};
  }
  if (!attracts) return {base + rolling, base + rolling};
  return {base + " cohesion easo/capillary/viscous" + rolling, base + rolling, reduce};
}

std::string one_each(const std::vector<double>& values) {
  return "peratomtype " + listed(values, exact, " ");
}

/// Energy density of sjkr2 with the card's adhesion to the wall.
double energy_density(const ContactModel& card, const WallContact& wall, double radius) {
  if (card.normal == NormalLaw::sjkr) return card.cohesion_energy_density_pa * wall.cohesion_factor;
  return sjkr_energy_density(sticking_of(card, wall, radius).pull_off_n, radius,
                             0.75 * wall_pair(card, wall, radius).hertz);
}

std::string properties(const ExportScene& scene, const Written& written) {
  const ContactModel& contact = written.contact;
  const SoulieFit* const fit = written.bridge();
  const auto walls = scene.walls();
  GlobalProperties out{"# types: 1 grains"};
  for (std::size_t i = 0; i < walls.size(); ++i) out.text += format(", %zu ", i + 2) + walls[i].name;
  out.text += "\n";
  // Values of the grains, then of the walls.
  const auto by_body = [&](const auto& of) {
    std::vector<double> values{of(contact)};
    for (const ExportWall& wall : walls) values.push_back(of(wall.contact));
    return values;
  };
  out.add("youngsModulus", one_each(by_body([&](auto& body) { return written.modulus(body.youngs_modulus_pa); })));
  out.add("poissonsRatio", one_each(by_body([](auto& body) { return body.poissons_ratio; })));
  out.add("coefficientRestitution",
          pairs_of(by_body([&](auto& body) { return written.restitution(body.restitution); })));
  out.add("coefficientFriction", pairs_of(by_body([](auto& body) { return body.friction; })));
  out.add("coefficientRollingFriction", pairs_of(by_body([](auto& body) { return body.rolling_friction; })));
  const double rolling_damping =
      written.edinburgh && contact.friction_basis != FrictionBasis::net ? written.edinburgh->rolling_damping : 0.3;
  out.add("coefficientRollingViscousDamping", pairs_of(by_body([&](auto&) { return rolling_damping; })));
  if (written.edinburgh) add_edinburgh_properties(scene, *written.edinburgh, out);
  if (contact.normal == NormalLaw::sjkr) {
    // The area of sjkr2 is twice that of the card's law.
    std::vector<double> halves{0.5 * contact.cohesion_energy_density_pa};
    for (const ExportWall& wall : walls)
      halves.push_back(0.5 * energy_density(scene.contact(), wall.contact, scene.radius_m()));
    out.add("cohesionEnergyDensity", pairs_of(halves));
  }
  if (!fit) return out.text;
  const double radius = fit->bridge.radius_m;
  // LIGGGHTS assigns the share 1 - sqrt(3/4) of the liquid on one of two equal grains to each bridge.
  const double grain = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  out.add("surfaceLiquidContentInitial", "scalar " + exact(fit->bridge.volume_m3 / (grain * (1 - std::sqrt(0.75)))));
  out.add("surfaceTension", "scalar " + exact(fit->bridge.surface_tension_n_m));
  out.add("fluidViscosity", "scalar 0");
  out.add("contactAngle", one_each(by_body([](auto&) { return 0.0; })));
  out.add("minSeparationDistanceRatio", "scalar 1.01");
  out.add("maxSeparationDistanceRatio", "scalar " + exact(1.02 + 0.5 * fit->bridge.rupture_gap_m() / radius));
  return out.text;
}

/// material.inc: properties, pair style and wall model, for a script with types for the grains and each wall.
std::string liggghts_material(const ExportScene& scene, const Written& written, const Models& models) {
  const auto& walls = scene.walls();
  std::string fixes;
  for (std::size_t i = 0; i < walls.size(); ++i)
    fixes += "#   fix " + walls[i].name + " all wall/gran ${wall_model} mesh n_meshes ... meshes ..." +
             models.wall_end() + format(", each fix mesh/surface file ... type %zu\n", i + 2);
  const std::string& settings = models.wall_settings;
  return filled_in(
      "exports/texts/liggghts_material.in",
      {{"title", deck_comment(scene.title)},
       {"program", program_identity()},
       {"types", std::to_string(walls.size() + 1)},
       {"atom_modify", atom_modify(scene.contact())},
       {"density", grain_density_in_words(scene)},
       {"radius", format("%.9g", scene.radius_m())},
       {"time_step", shown(written.time_step_s)},
       {"walls", fixes},
       {"properties", properties(scene, written)},
       {"pair_style", models.pair_style()},
       {"wall_model", models.walls},
       {"wall_settings", settings.empty() ? "" : "variable     wall_settings string \"" + settings + "\""}});
}

std::vector<std::string> liggghts_losses(const ExportScene& scene, const Written& deck_law) {
  const ContactModel &contact = scene.contact(), &written = deck_law.contact;
  const SoulieFit* const fit = deck_law.bridge();
  if (deck_law.edinburgh) return edinburgh_losses(scene, *deck_law.edinburgh);
  const GrainPair pair = scene.mean_pair();
  const Sticking deck = sticking_of(written, 0.5 * scene.radius_m());
  // With a reduced limit, LIGGGHTS subtracts the cohesion from the friction force: none for grains held by adhesion
  // only.
  std::vector<std::string> notes = differences_of_sticking(
      scene, written, "LIGGGHTS", contact.friction_basis == FrictionBasis::elastic ? deck.load_n : 0);
  if (fit) {
    notes.push_back(
        format("LIGGGHTS has no such bridge. Its capillary bridge (easo, Soulie et al. 2006) was fitted to the card's "
               "curve: it differs by up to %.1f %% of the peak force, %.1f %% in root mean square, %+.1f %% in work.",
               100 * fit->largest, 100 * fit->root_mean_square, 100 * fit->work));
    notes.push_back(
        format("Liquid volume %.4g m^3 a bridge and surface tension %.4g N/m are numbers of the fit, not of a liquid. "
               "The contact angle is 0: at others LIGGGHTS 3.8.0 is wrong, by 27 %% at 30 degrees.",
               fit->bridge.volume_m3, fit->bridge.surface_tension_n_m));
    const auto gaps = bridge_gaps(contact, pair);
    if (gaps.formation_m > 0)
      notes.push_back(
          format("Bridges form when grains touch; on the card, at a gap of %.4g mm.", 1e3 * gaps.formation_m));
    const double cohesion = cohesion_n(contact, pair), touch = fit->bridge.force_n(0);
    notes.push_back(
        format("Overlapping grains attract each other with %.4g N; on the card with %.4g N.", touch, cohesion));
    if (scene.sizes.radii_m.size() > 1 || (!scene.slump() && scene.grains().distribution != SizeDistribution::mono))
      notes.push_back(
          "Between grains of other than the mean size the bridge scales as Soulie's, not with the square of the size.");
  }
  for (const auto& [name, wall] : scene.walls())
    if (wall.cohesion_factor > 0 && written.normal != NormalLaw::sjkr)
      notes.push_back(format("The attraction of grains to the %s (%.3g of that between grains) is lost.", name,
                             wall.cohesion_factor));
  if (contact.rolling == RollingModel::spring_dashpot && contact.rolling_friction > 0)
    notes.push_back(
        "The rolling spring is two thirds of the card's (secant for tangent stiffness); the largest moment is the "
        "same.");
  return notes;
}

/// "gap_m,card_n,liggghts_n" of a fitted bridge.
ExportFile bridge_curves(const ExportScene& scene, const SoulieFit& fit) {
  std::string text = "gap_m,card_n,liggghts_n\n";
  const GrainPair pair = scene.mean_pair();
  const double farthest = 1.2 * std::max(fit.bridge.rupture_gap_m(), bridge_gaps(scene.contact(), pair).rupture_m);
  for (int i = 0; i <= 400; ++i) {
    const double gap = farthest * i / 400;
    text += format("%.17g,%.17g,%.17g\n", gap, attraction_n(scene.contact(), pair, -gap), fit.bridge.force_n(gap));
  }
  return {"curves.csv", text};
}

/// Limits checked by LIGGGHTS 3.8.0 at the start (`0.05 < coefficientRestitution <= 1 required`).
Faults beyond_limits(const ExportScene& scene) {
  constexpr double kLeastRestitution = 0.05;
  Faults faults;
  const auto check = [&](const std::string& place, double restitution, const std::string& remedy) {
    if (restitution <= kLeastRestitution)
      faults.push_back({place,
                        format("is %g; LIGGGHTS takes a restitution above %g only", restitution, kLeastRestitution),
                        "calibrate with " + remedy + ", or export to another target"});
  };
  check("test.contact.restitution", scene.contact().restitution, "\"restitution\" 0.06 or more");
  for (const auto& [name, wall] : scene.walls())
    check((scene.application ? "parts." + name : "test." + name + "_wall") + ".restitution", wall.restitution,
          "a wall of restitution 0.06 or more");
  return faults;
}

/// Size of the simulation. On a core, LIGGGHTS made 2.3 million particle-steps per second in a chute with `epa`, 2.4
/// million in a hopper of dry grains (tests/results/machine_runs.csv), and 1.6 million with a capillary bridge
/// (tests/results/speed.csv).
std::string effort_in_words(const Application& application, const ExportScene& scene, double time_step_s) {
  const double steps_per_core_s = scene.contact().bridge.shape == BridgeShape::none ? 2.3e6 : 1.6e6;
  double volume = 0;
  for (const double radius : scene.packing.radii) volume += 4.0 / 3 * std::numbers::pi * std::pow(radius, 3);
  const double mean_mass = volume / static_cast<double>(scene.packing.radii.size()) * scene.grain_density_kg_m3;
  const double grains = application.feed.mass_kg / mean_mass;
  return plain(grains, 2) + " grains, " + plain(application.duration_s / time_step_s, 2) + " time steps: about " +
         plain(grains * mean_residence_s(application) / time_step_s / steps_per_core_s / 60, 2) +
         " minutes on one core, if grains stay " + plain(mean_residence_s(application), 2) +
         " s in the machine on average.";
}

/// Grains would pass through parts that move too far in a time step, or that they meet too fast.
Faults too_fast(const ExportScene& scene, double time_step_s) {
  if (!scene.application) return {};
  constexpr double largest_share = 0.25;  // of the smallest radius
  const double most = largest_share * std::ranges::min(scene.sizes.radii_m) / time_step_s;
  const double fastest = fastest_m_s(*scene.application);
  if (fastest <= most) return {};
  return {{"--application",
           "has a velocity of " + plain(fastest) + " m/s, by which grains could pass through a surface",
           "at most " + plain(most) + " m/s for these grains"}};
}

/// Study settings that avoid a substitute law; empty if the deck has the card's law.
std::string own_law(const ContactModel& card, const Written& written) {
  if (written.edinburgh)
    return card.normal == NormalLaw::luding ? "" : R"("contact": {"normal": "luding", "attraction": "none"})";
  if (!written.fit && written.contact.normal == card.normal) return {};
  return R"("contact": {"normal": "sjkr", "attraction": "none"}, with "cohesion_energy_density_pa" free)";
}

Written law_for_liggghts(const ExportScene& scene) {
  const ContactModel& card = scene.contact();
  if (yields(card.normal)) {
    const Edinburgh edinburgh(scene);
    return {card, {}, edinburgh, edinburgh.time_step_s};
  }
  const double radius = scene.radius_m();
  Written out{with_nearest_law(card, NormalLaw::sjkr, radius), {}, {}, deck_time_step_s(scene)};
  const GrainPair pair = scene.mean_pair();
  if (bridge_gaps(out.contact, pair).rupture_m > 0 && attraction_n(out.contact, pair, 0) > 0)
    out.fit = fit_soulie(out.contact, radius);
  return out;
}

}  // namespace

Result<Export> export_liggghts(const ExportScene& scene) {
  const ContactModel& card = scene.contact();
  KnownLaws known{
      "LIGGGHTS",
      {NormalLaw::hertz, NormalLaw::jkr, NormalLaw::dmt, NormalLaw::sjkr, NormalLaw::epa, NormalLaw::luding},
      kAllRolling};
  if (card.normal != NormalLaw::hertz) known.attraction = {BridgeShape::none};  // only one cohesion model at a time
  Faults faults = unknown_laws(card, known);
  append(faults, beyond_limits(scene));
  if (!faults.empty()) return faults;
  const Written written = law_for_liggghts(scene);
  if (faults = too_fast(scene, written.time_step_s); !faults.empty()) return faults;
  const Models models = models_of(written.contact, written.bridge());
  Export out;
  out.notes = liggghts_losses(scene, written);
  if (scene.slump() && scene.slump()->drop && !scene.application)
    out.notes.push_back("The deck simulates step 1 only, without the drop of the plate (step 2).");
  if (scene.application) {
    out.notes.push_back(effort_in_words(*scene.application, scene, written.time_step_s));
    out.files = liggghts_application(scene, written, models, out.notes);
  } else if (scene.slump()) {
    out.files = {{"in.slump", liggghts_slump(scene, written, models, out.notes)},
                 {"grains.data", grains_data(scene, {.types = 3, .mould_heights = 2.5})},
                 {"mould.stl", mould_stl(scene.slump()->mould)}};
  }
  if (!scene.application) out.files.push_back({"in.two_grains", liggghts_two_grains(scene, written, out.notes)});
  out.files.push_back({"material.inc", liggghts_material(scene, written, models)});
  if (written.fit) out.files.push_back(bridge_curves(scene, *written.fit));
  if (written.contact.normal != card.normal) out.files.push_back(sticking_curves(scene, written.contact, "liggghts"));
  out.own_law = own_law(card, written);
  out.instructions = scene.application ? "liggghts -in in.application\npastefit kpi .\n"
                                       : "liggghts -in DECK, which is in.slump or in.two_grains\n";
  if (scene.slump() && !scene.application) out.heap = "heap.dump";
  return out;
}

}  // namespace pastefit
