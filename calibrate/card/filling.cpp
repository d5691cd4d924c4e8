#include "calibrate/card/filling.h"

#include "calibrate/study/parameters.h"

namespace pastefit {

SlumpTable filling_of(const Card& card, std::uint64_t packing) {
  Study study;
  study.parameters = card.parameters;
  const Eigen::VectorXd middle = Eigen::VectorXd::Constant(free_count(study), 0.5);
  const auto stiffness = test_with(card.test, values_at(study, middle), packing).contact;
  SlumpTable test = card.test;
  test.packing_seed = packing;
  test.contact.youngs_modulus_pa = stiffness.youngs_modulus_pa;
  test.contact.poissons_ratio = stiffness.poissons_ratio;
  return test;
}

}  // namespace pastefit
