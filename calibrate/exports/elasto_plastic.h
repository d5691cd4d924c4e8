#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "calibrate/base/text.h"
#include "calibrate/exports/export.h"

namespace pastefit {

/// Whether grains of this law deform for good and adhere: `epa` and `luding` (core/laws/epa.h).
bool yields(NormalLaw normal);

/// A part of the way of two grains in a deck, evenly spaced.
struct Leg {
  const char* word;         ///< before distance and force in what the deck prints
  double from_m = 0, to_m;  ///< distance of the centres
  int steps;                ///< the deck prints where it starts, and after each but the last
};

/// The way of two grains of this radius that measures their law. Of elasto-plastic grains one "path" through all
/// branches: loading, unloading to the adhesion branch and along it, reloading from there, and parting, twice. Of
/// others "apart" and "back" (`two_grain_distances`).
std::vector<Leg> two_grain_legs(const ContactModel& contact, double radius_m);

/// Overlap of a pair over its R* where a law of another stiffness is to exert the same force: of two mean grains under
/// the weight of half the mould on a square as wide as a grain; of tests without a mould a twentieth of the radius.
double matched_overlap_ratio(const ExportScene& scene);

/// Surface energy [J/m^2] of EEPA as EDEM, PFC and LIGGGHTS without `fixKc` have it, whose pull-off is 1.5 pi gamma a
/// with a of the plastic overlap: of two mean grains that were pressed to the matched overlap it is then the card's.
double eepa_surface_energy(const ExportScene& scene);

/// The card's law in the words of the `pair granular` of current LAMMPS, for notes.
std::string lammps_granular_words(const ExportScene& scene);

/// A matrix over the grains and each wall; walls do not meet each other.
inline std::string pairs_of(const std::vector<double>& values) {
  std::string out = format("peratomtypepair %zu", values.size());
  for (std::size_t row = 0; row < values.size(); ++row)
    for (std::size_t column = 0; column < values.size(); ++column)
      out += " " + exact(values[std::min(row, column) == 0 ? std::max(row, column) : std::min(row, column)]);
  return out;
}

/// `luding` and `epa` cards in LIGGGHTS 3.8: its model `edinburgh` with linear springs, 2 E' R* of the modulus it is
/// given, and a fixed adhesion stiffness, with friction and rolling of Luding's (`tan_luding`, `luding`), whose limits
/// are mu |F + f0 + kc d| as the card's.
///
/// So `luding` is the card's law. `epa` is written with linear springs, too, of the same force at one overlap
/// (`matched_overlap_ratio`); plasticity and adhesion ratio stay, so that of every load the same share is held as
/// pull-off. With its exponent 3/2 the model is the card's law only until a contact reaches the adhesion branch: its
/// memory shrinks there by (k2 + kc)/(k2 - k1) without the exponent 2/3, so that the contact never leaves that branch,
/// however deep it is pressed, and grains fall into each other.
///
/// Two more properties of LIGGGHTS 3.8.0 that a deck has to know: with `limitForce`, its default, `fixKc` and no
/// constant pull-off every pull is cut to zero; and where two grains change their order, because LIGGGHTS sorts them or
/// one moves to another process, it turns the sign of the deepest overlap, and the contact forgets it.
struct Edinburgh {
  explicit Edinburgh(const ExportScene& scene);

  double overlap_ratio = 0;  ///< overlap over R* at which the springs are matched
  double modulus_share = 1;  ///< E' over the card's Young's moduli
  double stiffening = 1;     ///< k2/k1
  double time_step_s = 0;
  double rolling_damping = 0;  ///< coefficientRollingViscousDamping of two mean grains

  /// LIGGGHTS's restitution, whose dashpot is 2 beta sqrt(m* k1), for the card's, 2 sqrt(5/6) beta sqrt(S_n m*).
  double restitution(double card) const;

 private:
  double damping_share_ = 1;  ///< of beta
};

/// In words of LIGGGHTS; the same for walls, whose fix has the settings at its end.
std::string edinburgh_models(const ContactModel& contact);
inline const std::string kEdinburghSettings = "fixKc on limitForce off";

/// Those of its properties that make contacts yield and adhere, the fixes `unloading` and `adhesion`; or, `elastic`,
/// such that they do not.
std::string edinburgh_memory(const ExportScene& scene, bool elastic);

/// The properties of that model beside those of elasticity, friction, restitution and rolling friction.
std::string edinburgh_properties(const ExportScene& scene, const Edinburgh& edinburgh);

/// What differs from the card.
std::vector<std::string> edinburgh_losses(const ExportScene& scene, const Edinburgh& edinburgh);

}  // namespace pastefit
