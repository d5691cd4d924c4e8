#include "calibrate/search/low_fidelity.h"

#include "calibrate/search/response.h"
#include "calibrate/search/surrogate.h"

namespace pastefit {

std::vector<std::uint64_t> packings_of_coarse(std::uint64_t seed, int count) {
  std::vector<std::uint64_t> packings;
  for (int k = 0; k < count; ++k) packings.push_back(coarse_packings + seed * 1000 + static_cast<std::uint64_t>(k));
  return packings;
}

Study with_coarse_grains(Study study) {
  for (StudyTest& test : study.tests) {
    if (!why_of_that_size(test.lab.test).empty()) continue;
    GrainSizes& grains = specimen_of(test.lab.test).grains;
    grains = enlarged(grains, coarse_radius_ratio);
  }
  return study;
}

std::vector<Response> corrected(std::span<const Response> coarse, std::span<const Response> fine) {
  std::vector<Response> moved;
  for (const Response& one : coarse)
    if (is_feasible(one)) moved.push_back(one);
  if (moved.empty()) return moved;
  Surrogate surrogate(moved);
  Eigen::VectorXd bias = Eigen::VectorXd::Zero(moved.front().residuals.size());
  int count = 0;
  for (const Response& one : fine) {
    if (!is_feasible(one)) continue;
    bias += one.residuals - surrogate.expected_residuals(one.point);
    ++count;
  }
  if (count > 0) bias /= count;
  for (Response& one : moved) {
    one.residuals += bias;
    one.misfit = 0.5 * one.residuals.squaredNorm();
  }
  return moved;
}

}  // namespace pastefit
