#include <cstdio>
#include <filesystem>

#include "calibrate/calibrate.h"
#include "calibrate/store/program.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

/// Calibrates an installed study with coarse grains, its strength alone, and prints what its card says.
int main(int argc, char** argv) {
  if (argc != 2) return 2;
  auto study = pastefit::read_study(argv[1]);
  if (!study.ok()) return 1;
  pastefit::specimen_of(study.value().tests.at(0).lab.test).grains.radius_m = 0.018;
  for (pastefit::Parameter& parameter : study.value().parameters) {
    if (!parameter.free || parameter.name == "strength_pa") continue;
    parameter.value = pastefit::value_between(parameter, 0.5);
    parameter.free = false;
  }
  study.value().search = {.screening = 3,
                          .budget_simulations = 12,
                          .packings = 1,
                          .confirmation_packings = 2,
                          .examination_simulations = 2,
                          .tolerance_mm = 40};

  const auto file = std::filesystem::temp_directory_path() / "pastefit-consumer.sqlite";
  std::filesystem::remove(file);
  auto store = pastefit::Store::open(file, {pastefit::program_identity(), pastefit::inputs_of(study.value())});
  if (!store.ok()) return 1;
  const auto result = pastefit::calibrate(study.value(), store.value());
  if (!result.ok() || !result.value().card) return 1;
  for (const pastefit::Parameter& parameter : result.value().card->material.parameters)
    if (parameter.name == "strength_pa")
      std::printf("%s: strength %.0f Pa, %s\n", study.value().title.c_str(), parameter.value,
                  result.value().card->search.status.c_str());
  return 0;
}
