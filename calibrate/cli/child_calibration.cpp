#include "calibrate/cli/child_calibration.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "calibrate/base/text.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/process.h"
#include "calibrate/cli/terminal.h"

namespace pastefit {

namespace {

namespace fs = std::filesystem;

constexpr int kMostDeaths = 3;  // of one calibration's process; as for a worker

/// Reason for a missing card from the end of the process; nothing if there is a card.
std::optional<BatchFailure> failure_after(const BatchStudy& one, const ChildEnd& end) {
  if (end.signal != 0)
    return BatchFailure{"failed", format("its process was killed by signal %d, ", end.signal) +
                                      format("%d times; the same command goes on with it", kMostDeaths)};
  if (end.status != kDone && end.status != kFailed)
    return BatchFailure{"failed", format("ended with status %d; to see why: ", end.status) + "pastefit calibrate " +
                                      shell_word(one.file.string()) + " --resume --out " +
                                      shell_word(one.folder.string())};
  const auto answer = nlohmann::json::parse(end.output, nullptr, false);
  if (answer.is_object() && answer.contains("format")) return std::nullopt;
  if (!answer.is_object() || !answer.contains("reason"))
    return BatchFailure{"failed", "it could not write its result to " + one.folder.string()};
  return BatchFailure{answer.value("status", "failed"), answer.value("reason", "")};
}

}  // namespace

Faults calibrate_in_child(const BatchStudy& one, const std::vector<std::string>& options,
                          const std::atomic<bool>& stop) {
  std::vector<std::string> words{"calibrate", one.file.string(), "--out", one.folder.string(), "--resume", "--json"};
  words.insert(words.end(), options.begin(), options.end());
  if (is_quiet()) words.push_back("--quiet");
  std::error_code error;
  fs::remove(one.folder / kFailureFile, error);
  ChildEnd end;
  try {
    for (int deaths = 0; deaths < kMostDeaths; ++deaths) {
      end = run_this_program(words, stop);
      if (end.signal == 0 || stop) break;
      note("pastefit: %s: the process was killed by signal %d\n", one.name.c_str(), end.signal);
    }
  } catch (const std::system_error& failed) {
    return write_failure(one, {"failed", std::string("no process could be started: ") + failed.what()});
  }
  if (end.signal != 0 && stop) return {};  // can be continued
  if (const auto failure = failure_after(one, end)) return write_failure(one, *failure);
  fs::remove(one.folder / kFailureFile, error);  // written by a concurrent batch
  return {};
}

}  // namespace pastefit
