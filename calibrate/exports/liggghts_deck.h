#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/exports/elasto_plastic.h"
#include "calibrate/exports/export.h"
#include "calibrate/exports/nearest_law.h"

namespace pastefit {

/// Models of grains and walls in LIGGGHTS syntax. Cohesion must precede rolling friction. Settings come last, in a
/// wall's fix after its geometry.
struct Models {
  std::string grains, walls;
  std::string grain_settings = {}, wall_settings = {};

  std::string pair_style() const {
    return "pair_style   gran " + grains + (grain_settings.empty() ? "" : " " + grain_settings) +
           "\npair_coeff   * *\n";
  }
  /// End of a wall's fix.
  std::string wall_end() const { return wall_settings.empty() ? "" : " ${wall_settings}"; }
};

/// The law as written, and how it represents the card's.
struct Written {
  ContactModel contact;                ///< with the substitute law
  std::optional<SoulieFit> fit;        ///< of a bridge
  std::optional<Edinburgh> edinburgh;  ///< of elasto-plastic adhesion
  double time_step_s = 0;

  const SoulieFit* bridge() const { return fit ? &*fit : nullptr; }
  double modulus(double card) const { return edinburgh ? edinburgh->modulus_share * card : card; }
  double restitution(double card) const { return edinburgh ? edinburgh->restitution(card) : card; }
};

/// `atom_modify` command. With sorting, LIGGGHTS may swap a pair, which inverts the sign of edinburgh's history: the
/// contact then starts anew.
std::string atom_modify(const ContactModel& contact);

/// First lines of a deck: title, what it simulates, notes as comments, and settings of the program.
std::string liggghts_begin(const ExportScene& scene, const std::string& what, const std::vector<std::string>& notes);

/// Slump test: relax in the mould, lift, rest. Notes become comments.
std::string liggghts_slump(const ExportScene& scene, const Written& written, const Models& models,
                           const std::vector<std::string>& notes);

/// Motion of two grains (`two_grain_legs`), for laws without history only apart; prints "apart DISTANCE FORCE" or "path
/// DISTANCE FORCE". Contains the notes if there is no other deck.
std::string liggghts_two_grains(const ExportScene& scene, const Written& written,
                                const std::vector<std::string>& notes);

/// The scene's application: the deck, its surfaces and its feed. Requirement: the scene has one.
std::vector<ExportFile> liggghts_application(const ExportScene& scene, const Written& written, const Models& models,
                                             const std::vector<std::string>& notes);

/// Lateral surface of the mould.
std::string mould_stl(const Mould& mould);

}  // namespace pastefit
