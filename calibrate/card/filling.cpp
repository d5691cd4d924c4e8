#include "calibrate/card/filling.h"

#include "calibrate/study/parameters.h"

namespace pastefit {

SlumpTable filling_of(const Card& card, std::uint64_t packing) {
  return filling_of(card, card.test, packing);
}

SlumpTable filling_of(const Card& card, const SlumpTable& of_card, std::uint64_t packing) {
  Study study;
  study.parameters = card.parameters;
  const Eigen::VectorXd middle = Eigen::VectorXd::Constant(free_count(study), 0.5);
  const auto stiffness = test_with(of_card, values_at(study, middle), packing).contact;
  SlumpTable test = of_card;
  test.packing_seed = packing;
  test.contact.youngs_modulus_pa = stiffness.youngs_modulus_pa;
  test.contact.poissons_ratio = stiffness.poissons_ratio;
  return test;
}

}  // namespace pastefit
