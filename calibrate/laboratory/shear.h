#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calibrate/base/json_reader.h"
#include "calibrate/laboratory/surface.h"
#include "calibrate/laboratory/usual_answers.h"
#include "core/rigs/shear_cell/shear_cell.h"

namespace pastefit {

// The shear cell in the words of files and people: what `LaboratoryTest` (calibrate/laboratory/test.h) asks of a kind.

inline constexpr std::string_view kind_of(const ShearCell&) {
  return "shear";
}

/// None that has parameters: plates and sides are of steel, and what is known of them is part of the apparatus.
std::vector<Surface> surfaces_of(ShearCell& test);

double grains_needed(const ShearCell& test);

/// The keys of "apparatus" in laboratory and rig files: millimetres and millimetres a second.
void read_apparatus(ObjectReader& apparatus, ShearCell& test, Need need);
std::span<const std::pair<std::string_view, std::string_view>> places_in_files(const ShearCell&);

nlohmann::json to_json(const ShearCell& test);
ShearCell usual_test(const ShearCell&);
void read_test(ObjectReader& reader, ShearCell& test);

Templates templates_of(const ShearCell& test);

/// The filling of the cell, and all that follows, each with a clock of its own.
std::span<const std::string_view> series_of(const ShearCell& test);
std::size_t series_at(const ShearCell& test, const Moment& moment);

std::optional<double> grain_density_of(const ShearCell& test, const Observables& means);
nlohmann::ordered_json conditions_of(const ShearCell& test);
std::string conditions_in_words(const ShearCell& test);

/// Beds whose stress still changed when the base stopped. A line, or nothing.
std::string remarks_on(const ShearCell& test, std::span<const Observables> runs);

}  // namespace pastefit
