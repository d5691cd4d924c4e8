#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calibrate/base/json_reader.h"
#include "calibrate/laboratory/drawing.h"
#include "calibrate/laboratory/surface.h"
#include "calibrate/laboratory/usual_answers.h"
#include "core/rigs/pellet_crush/pellet_crush.h"

namespace pastefit {

// The pellet crush in the words of files and people: what `LaboratoryTest` (calibrate/laboratory/test.h) asks of a
// kind.

inline constexpr std::string_view kind_of(const PelletCrush&) {
  return "pellet";
}

/// None that has parameters: the tools are of steel, and what is known of them is part of the apparatus.
std::vector<Surface> surfaces_of(PelletCrush& test);

double grains_needed(const PelletCrush& test);

/// The keys of "apparatus" in laboratory and rig files: millimetres and millimetres a second.
void read_apparatus(ObjectReader& apparatus, PelletCrush& test, Need need);
std::span<const std::pair<std::string_view, std::string_view>> places_in_files(const PelletCrush&);

nlohmann::json to_json(const PelletCrush& test);
PelletCrush usual_test(const PelletCrush&);
void read_test(ObjectReader& reader, PelletCrush& test);

Templates templates_of(const PelletCrush& test);

/// The filling of the die, and all that follows, each with a clock of its own.
std::span<const std::string_view> series_of(const PelletCrush& test);
std::size_t series_at(const PelletCrush& test, const Moment& moment);

std::optional<double> grain_density_of(const PelletCrush& test, const Observables& means);
nlohmann::ordered_json conditions_of(const PelletCrush& test);
std::string conditions_in_words(const PelletCrush& test);

/// The stress on the platen over the strain of the pellet, over the strength that was measured.
std::vector<Drawing> drawings_of(const PelletCrush& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured);

/// Pellets whose stress still rose when the platen stopped. A line, or nothing.
std::string remarks_on(const PelletCrush& test, std::span<const Observables> runs);

}  // namespace pastefit
