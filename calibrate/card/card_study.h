#pragma once

#include <Eigen/Core>

#include "calibrate/card/card.h"

namespace pastefit {

/// The study that a card answers, as far as the card says: its tests with what was measured and what of it counts, and
/// the parameters with their bounds. Its title, bounds and tolerances are the study's; of the search only seed,
/// strategy, packings and budget are.
Study study_of(const Card& card);

/// The card's material among that study's candidates.
Eigen::VectorXd point_of(const Card& card);

}  // namespace pastefit
