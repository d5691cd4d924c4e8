#include <cstdio>

#include "calibrate/search/strategy.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/study.h"
#include "core/rigs/slump/slump_test.h"

/// Reads an installed study and runs its test once, with coarse grains and the usual parameters.
int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto read = pastefit::read_study(argv[1]);
  if (!read.ok()) return 1;
  const pastefit::Study& study = read.value();
  if (!pastefit::validate(study.search, pastefit::free_count(study)).empty()) return 1;

  pastefit::Test test = study.tests.at(0).lab.test;
  pastefit::specimen_of(test).grains.radius_m = 0.018;
  test = pastefit::with_usual_contact(test);
  const pastefit::Outcome outcome = pastefit::simulate(test);
  const auto height = outcome.observables.find("step1.height_mm");
  if (outcome.failure || !height) return 1;
  std::printf("%s: %.1f mm high with the usual parameters\n", study.title.c_str(), *height);
  return *height > 0 && *height <= 300 ? 0 : 1;
}
