#include "calibrate/exports/export.h"
#include "calibrate/exports/parameter_table.h"

namespace pastefit {

Result<Export> export_csv(const ExportLaw& law) {
  return Export{law_files(law),
                {"The force table has no memory: when a bridge forms is said by formation_gap_m in parameters.csv."}};
}

}  // namespace pastefit
