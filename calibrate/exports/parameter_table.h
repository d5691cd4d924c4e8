#pragma once

#include <string>
#include <vector>

#include "calibrate/exports/export.h"

namespace pastefit {

/// "overlap_m,attraction_n,repulsion_n" of two grains of mean radius, in 2,001 rows from the rupture gap to an overlap
/// of a tenth of the radius, including touch. Both forces are positive; the attraction pulls.
ExportFile force_csv(const ExportScene& scene);

/// "x_m,y_m,z_m,radius_m" of the filled mould.
ExportFile grains_csv(const ExportScene& scene);

/// Appends parameters, forces and, if the mould is filled, its grains to `files`.
std::vector<ExportFile> law_files(const ExportScene& scene, std::vector<ExportFile> files = {});

/// Laws as text and formulas with their SI constants, for manual input into another program.
std::string laws_in_words(const ExportScene& scene);

}  // namespace pastefit
