#pragma once

#include <string>
#include <vector>

#include "calibrate/exports/export.h"
#include "calibrate/laboratory/names.h"

namespace pastefit {

/// "overlap_m,attraction_n,repulsion_n" of two grains of the mean radius, 2,001 rows from the rupture gap to an overlap
/// of a tenth of the radius; a row at touch. Both forces are positive; the attraction pulls.
ExportFile force_csv(const ExportScene& scene);

/// "x_m,y_m,z_m,radius_m" of the filled mould.
ExportFile grains_csv(const ExportScene& scene);

/// These files, then parameters, forces and, if there is a filled mould, its grains.
std::vector<ExportFile> law_files(const ExportScene& scene, std::vector<ExportFile> files = {});

/// The laws in words and formulas with their numbers in SI, for people who type them into another program.
std::string laws_in_words(const ExportScene& scene);

}  // namespace pastefit
