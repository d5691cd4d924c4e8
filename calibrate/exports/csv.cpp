#include "calibrate/exports/elasto_plastic.h"
#include "calibrate/exports/export.h"
#include "calibrate/exports/known_laws.h"
#include "calibrate/exports/parameter_table.h"

namespace pastefit {

Result<Export> export_csv(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  const KnownLaws known{"the force table", {NormalLaw::hertz, NormalLaw::epa, NormalLaw::luding}, kAllRolling};
  if (Faults faults = unknown_laws(contact, known); !faults.empty()) return faults;
  if (yields(contact.normal))
    return Export{law_files(scene),
                  {"The laws: " + laws_chosen(contact) + ".",
                   "There is no force table: the force depends on how deep the grains were pressed before."}};
  return Export{law_files(scene),
                {"The laws: " + laws_chosen(contact) + ".",
                 "The force table has no memory: when a bridge forms is said by formation_gap_m in parameters.csv."}};
}

}  // namespace pastefit
