#include "calibrate/exports/export.h"
#include "calibrate/exports/known_laws.h"
#include "calibrate/exports/parameter_table.h"

namespace pastefit {

Result<Export> export_csv(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  const KnownLaws known{"the force table", {NormalLaw::hertz}, kAllRolling};
  if (Faults faults = unknown_laws(contact, known); !faults.empty()) return faults;
  return Export{law_files(scene),
                {"The laws: " + laws_chosen(contact) + ".",
                 "The force table has no memory: when a bridge forms is said by formation_gap_m in parameters.csv."}};
}

}  // namespace pastefit
