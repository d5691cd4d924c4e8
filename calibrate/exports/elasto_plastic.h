#pragma once

#include <string>
#include <vector>

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

/// Says that a constant pull-off belongs to two mean grains, if there is one and grains differ in size; else empty.
std::string note_of_pull_off(const ExportScene& scene, std::string_view target);

}  // namespace pastefit
