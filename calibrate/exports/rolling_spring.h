#pragma once

#include <string>

#include "calibrate/exports/export.h"

namespace pastefit {

/// Lever of the spring that resists rolling, over R*: k_r = 2.25 S_n (lever R*)^2. Of a spring and dashpot mu_r, as on
/// the card (Ai et al. 2011). In place of a constant torque, which a target lacks, stands a stiff spring, as wide as
/// R*: it slips at the same moment after a turn that is small.
double rolling_spring_lever(RollingModel rolling, double rolling_friction);

/// How small: of two mean grains under a load [N]. Empty if the card has no constant torque.
std::string note_of_constant_torque(const ExportScene& scene, double load_n);

}  // namespace pastefit
