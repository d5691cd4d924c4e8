#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/exports/elasto_plastic.h"
#include "calibrate/exports/export.h"
#include "calibrate/exports/soulie.h"

namespace pastefit {

/// The models of grains and walls in LIGGGHTS's words. Cohesion has to stand before rolling friction; settings come
/// last, in a wall's fix after its geometry.
struct Models {
  std::string grains, walls;
  std::string grain_settings = {}, wall_settings = {};

  std::string pair_style() const {
    return "pair_style   gran " + grains + (grain_settings.empty() ? "" : " " + grain_settings) +
           "\npair_coeff   * *\n";
  }
  /// What ends the fix of a wall.
  std::string wall_end() const { return wall_settings.empty() ? "" : " ${wall_settings}"; }
};

/// What stands for the card's law.
struct Written {
  ContactModel contact;                ///< with the law that stands in for the card's
  std::optional<SoulieFit> fit;        ///< of a bridge
  std::optional<Edinburgh> edinburgh;  ///< of elasto-plastic adhesion
  double time_step_s = 0;

  const SoulieFit* bridge() const { return fit ? &*fit : nullptr; }
  double modulus(double card) const { return edinburgh ? edinburgh->modulus_share * card : card; }
  double restitution(double card) const { return edinburgh ? edinburgh->restitution(card) : card; }
};

/// The command of that name. Sorted, LIGGGHTS may list a pair the other way round, and turns the sign of what edinburgh
/// remembers of it: the contact then loads anew.
std::string atom_modify(const ContactModel& contact);

/// The slump test: relax in the mould, lift, rest. Notes become comments.
std::string liggghts_slump(const ExportScene& scene, const Written& written, const Models& models,
                           const std::vector<std::string>& notes);

/// Two grains on their way (`two_grain_legs`), of laws without a memory only apart; prints "apart DISTANCE FORCE" or
/// "path DISTANCE FORCE". Where there is no other deck it has the notes.
std::string liggghts_two_grains(const ExportScene& scene, const Written& written,
                                const std::vector<std::string>& notes);

/// The mould's side.
std::string mould_stl(const Mould& mould);

}  // namespace pastefit
