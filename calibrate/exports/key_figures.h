#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"

namespace pastefit {

/// Quantity of an application, from each run: one run for each material that fits the readings.
struct KeyFigure {
  std::string name;  ///< ends with the unit
  std::vector<double> of_runs;

  double mean() const;
  /// Band that holds a further run with a probability of 90 %, if the runs are a sample of a normal distribution:
  ///     mean +- t(0.95; n - 1) s sqrt(1 + 1/n).
  /// Nothing with fewer than three runs. Materials that fit are chosen to differ, so the band is a wide one.
  std::optional<std::pair<double, double>> band() const;
};

struct KeyFigures {
  std::vector<std::string> runs;   ///< folders, relative to the one that was asked for
  std::vector<KeyFigure> figures;  ///< those that every run has
};

/// Reads figures.csv, which the deck of an application writes, in the folder or in its subfolders. "Mean" is over the
/// time in which 20 to 80 % of what is discharged leaves, without a discharge over the second half of the time:
///
///     fed_kg, discharged_kg, remaining_kg   at the end
///     discharge_rate_kg_s                   60 % of the discharged mass over the time that it takes
///     time_to_50_percent_s                  until half of the fed mass has left, from the last start of a motion
///     flow_depth_mm                         mean
///     PART_force_mean_n, PART_force_max_n   size of the force of the grains on a part, mean and largest
///     PART_torque_mean_n_m                  of the grains on a part, about its axis
///
/// A machine without an outlet has lost_kg, the mass that escaped, in place of what concerns the discharge.
/// Errors: no figures; a run that has not begun or not ended; numbers that are not finite; a repeated column.
Result<KeyFigures> read_key_figures(const std::filesystem::path& folder);

}  // namespace pastefit
