#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "calibrate/base/text.h"
#include "calibrate/exports/export.h"

namespace pastefit {

/// True for elasto-plastic adhesive laws: `epa` and `luding` (core/laws/epa.h).
bool yields(NormalLaw normal);

/// Part of the motion of two grains in a deck, with equal steps.
struct Leg {
  const char* word;         ///< prefix of distance and force in the deck's output
  double from_m = 0, to_m;  ///< distance of the centres
  int steps;                ///< the deck prints at the start and after each step but the last
};

/// Motion of two grains of this radius that measures their law. Elasto-plastic grains: one "path" through all branches,
/// twice loading, unloading to the adhesion branch and along it, reloading from there, and separation. Other grains:
/// "apart" and "back" (`two_grain_distances`).
std::vector<Leg> two_grain_legs(const ContactModel& contact, double radius_m);

/// Overlap over R* at which a law of another stiffness should give the same force: for two mean grains under the weight
/// of half the mould on a square as wide as a grain; without a mould, a twentieth of the radius.
double matched_overlap_ratio(const ExportScene& scene);

/// Surface energy gamma [J/m^2] of EEPA in EDEM, PFC and LIGGGHTS without `fixKc`, whose pull-off is 1.5 pi gamma a, a
/// from the plastic overlap. Two mean grains pressed to the matched overlap then have the card's pull-off.
double eepa_surface_energy(const ExportScene& scene);

/// Of the overlap in the law; S_n = dF/dd of loading over F/d. The card's dashpots and tangential and rolling springs
/// are proportional to S_n.
double overlap_exponent(NormalLaw normal);

/// Global properties of a LIGGGHTS deck, as the fixes p1, p2, ...
struct GlobalProperties {
  std::string text;
  int next = 1;

  void add(const std::string& name, const std::string& value) {
    text += format("fix p%d all property/global ", next++) + name + " " + value + "\n";
  }
};

/// Matrix over the grains and each wall, without wall-wall pairs.
inline std::string pairs_of(const std::vector<double>& values) {
  std::string out = format("peratomtypepair %zu", values.size());
  for (std::size_t row = 0; row < values.size(); ++row)
    for (std::size_t column = 0; column < values.size(); ++column)
      out += " " + exact(values[std::min(row, column) == 0 ? std::max(row, column) : std::min(row, column)]);
  return out;
}

/// `luding` and `epa` cards in LIGGGHTS 3.8: model `edinburgh` with linear springs, 2 E' R* with the modulus it is
/// given, fixed adhesion stiffness, and Luding's friction and rolling (`tan_luding`, `luding`), whose limit mu |F + f0
/// + kc d| is the card's.
///
/// `luding` is the card's law, except for the tangential and rolling springs, which vary with the overlap. `epa` is
/// written with linear springs, too, with the same force at one overlap (`matched_overlap_ratio`); plasticity and
/// adhesion ratio are unchanged, so the pull-off is the same fraction of every load. With exponent 3/2, the model
/// deviates as soon as a contact reaches the adhesion branch: its memory shrinks there by (k2 + kc)/(k2 - k1) without
/// the exponent 2/3, so the contact never leaves that branch, however large the overlap, and grains collapse into each
/// other.
///
/// Decks work around two properties of LIGGGHTS 3.8.0. With `limitForce` (default), `fixKc` and no constant pull-off,
/// every attraction is cut to zero. If two grains change their order, by sorting or by moving to another process, the
/// sign of the largest overlap is inverted, and the contact loses its history.
struct Edinburgh {
  explicit Edinburgh(const ExportScene& scene);

  double overlap_ratio = 0;  ///< overlap over R* at which the springs have the same force
  double modulus_share = 1;  ///< E' over the card's Young's moduli
  double stiffening = 1;     ///< k2/k1
  double time_step_s = 0;
  double rolling_damping = 0;  ///< coefficientRollingViscousDamping of two mean grains

  /// Restitution in LIGGGHTS, whose dashpot is 2 beta sqrt(m* k1), from the card's, 2 sqrt(5/6) beta sqrt(S_n m*).
  double restitution(double card) const;

 private:
  double damping_share_ = 1;  ///< of beta
};

/// Model in LIGGGHTS syntax for grains and walls; a wall's fix has the settings at its end.
std::string edinburgh_models(const ContactModel& contact);
inline const std::string kEdinburghSettings = "fixKc on limitForce off";

/// Properties for yielding and adhesion, the fixes `unloading` and `adhesion`; with `elastic`, values that disable
/// both.
std::string edinburgh_memory(const ExportScene& scene, bool elastic);

/// Adds properties of the model other than elasticity, friction, restitution and rolling friction.
void add_edinburgh_properties(const ExportScene& scene, const Edinburgh& edinburgh, GlobalProperties& properties);

/// Differences from the card.
std::vector<std::string> edinburgh_losses(const ExportScene& scene, const Edinburgh& edinburgh);

}  // namespace pastefit
