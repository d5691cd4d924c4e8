#include "calibrate/exports/export.h"
#include "calibrate/exports/known_laws.h"
#include "calibrate/exports/parameter_table.h"

namespace pastefit {

Result<Export> export_csv(const ExportScene& scene) {
  const KnownLaws known{"the force table", {NormalLaw::hertz}, kAllRolling};
  if (Faults faults = unknown_laws(scene.test.contact, known); !faults.empty()) return faults;
  return Export{{parameters_csv(scene), force_csv(scene), grains_csv(scene)},
                {"The laws: " + laws_chosen(scene.test.contact) + ".",
                 "The force table has no memory: when a bridge forms is said by formation_gap_m in parameters.csv."}};
}

}  // namespace pastefit
