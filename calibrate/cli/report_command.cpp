#include <memory>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/text.h"
#include "calibrate/batch/batch.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/options.h"
#include "calibrate/cli/output_file.h"
#include "calibrate/cli/process.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/report/page.h"
#include "calibrate/store/output_folder.h"

namespace pastefit {

namespace {

struct ReportOptions {
  std::string folder;
  int threads = 0;
  bool quick = false;
};

/// Page of a folder of calibrations.
int write_overview(const std::filesystem::path& folder, const std::vector<BatchRow>& rows) {
  refuse(output_folder_faults("DIR", folder));
  refuse(write_atomically(folder / kPage, batch_page(rows, "Calibrations in " + folder.string())), kFailed);
  print("wrote %s\n", (folder / kPage).c_str());
  return kDone;
}

int write_report(const ReportOptions& options) {
  if (const auto rows = rows_in(options.folder); !rows.empty()) return write_overview(options.folder, rows);
  Findings findings = value_or_throw(read_findings(options.folder, kStore));
  const std::filesystem::path folder = options.folder;
  refuse(output_folder_faults("DIR", folder));
  const auto tell = [](const std::string& sentence) { note("pastefit: %s\n", sentence.c_str()); };
  const auto unkept = look_at_tests(findings, folder, listen_for_stop(),
                                    {.threads = options.threads, .simulate = !options.quick, .tell = tell});
  for (const std::string& sentence : findings.missing) note("pastefit: %s\n", one_line(sentence).c_str());
  std::vector<std::string> files{kPage};
  refuse(write_curves(folder, findings, files), kFailed);
  refuse(write_page(folder, findings), kFailed);
  refuse(unkept, kFailed);
  for (const std::string& name : files) print("wrote %s\n", (folder / name).c_str());
  return kDone;
}

}  // namespace

Command add_report(CLI::App& verb) {
  const auto options = std::make_shared<ReportOptions>();
  verb.add_option("DIR", options->folder, "folder of a finished or running calibration, or of several")->required();
  verb.add_flag("--quick", options->quick, "do not simulate a missing animation or missing heaps");
  add_threads(verb, options->threads);
  return [options] { return write_report(*options); };
}

}  // namespace pastefit
