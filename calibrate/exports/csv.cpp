#include "calibrate/exports/export.h"
#include "calibrate/exports/parameter_table.h"

namespace pastefit {

Result<Export> export_csv(const ExportScene& scene) {
  return Export{{parameters_csv(scene), force_csv(scene), grains_csv(scene)},
                {"The force table has no memory: when a bridge forms is said by formation_gap_m in parameters.csv."}};
}

}  // namespace pastefit
