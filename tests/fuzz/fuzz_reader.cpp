// One fuzz target for each reader of a file: whatever bytes the file holds, they are read, or refused with faults.
// PASTEFIT_FUZZ_READER says which; libFuzzer has the main program.

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "calibrate/base/fault_text.h"
#include "calibrate/base/foreign_text.h"
#include "calibrate/base/json_document.h"
#include "calibrate/card/card.h"
#include "calibrate/report/card_text.h"
#include "calibrate/store/outcome_json.h"
#include "calibrate/study/impact_json.h"
#include "calibrate/study/lab.h"
#include "calibrate/study/rig.h"
#include "calibrate/study/tests.h"
#include "calibrate/verify/case.h"

namespace pastefit {

namespace {

namespace fs = std::filesystem;

/// A folder in memory where the shipped laboratories and apparatus are found beside the file that is read.
fs::path desk() {
  static const fs::path folder = [] {
    std::string name = "/dev/shm/pastefit-fuzz-XXXXXX";
    if (!::mkdtemp(name.data())) std::abort();
    const fs::path made = name;
    for (const char* beside : {"lab", "rigs"})
      fs::create_directory_symlink(fs::path(PASTEFIT_SOURCE_DIR) / "data" / beside, made / beside);
    fs::create_directory(made / "read");
    std::atexit([] {
      std::error_code error;
      fs::remove_all(desk(), error);
    });
    return made;
  }();
  return folder;
}

/// Faults are for people: each says where and what.
template <class T>
void judge(const Result<T>& read) {
  if (read.ok()) return;
  if (read.faults().empty()) std::abort();
  for (const Fault& fault : read.faults())
    if (fault.what.empty()) std::abort();
  lines_of(message_of(read.faults()));
}

[[maybe_unused]] void lab(const fs::path& file) {
  judge(read_lab(file));
}

[[maybe_unused]] void rig(const fs::path& file) {
  judge(read_rig(file));
}

[[maybe_unused]] void study(const fs::path& file) {
  const auto read = read_study(file);
  judge(read);
  if (read.ok()) inputs_of(read.value());
}

/// A card that was read can be shown, and written so that it reads as the same one.
[[maybe_unused]] void card(const fs::path& file) {
  const auto read = read_card(file);
  judge(read);
  if (!read.ok()) return;
  text_of(read.value());
  const auto written = json_text(to_json(read.value()));
  const auto again = card_from_json(nlohmann::json::parse(written));
  if (!again.ok() || json_text(to_json(again.value())) != written) std::abort();
}

[[maybe_unused]] void physics_case(const fs::path& file) {
  judge(read_case(file));
}

[[maybe_unused]] void impact(const fs::path& file) {
  Faults faults;
  if (const auto document = read_json(file, faults)) judge(impact_from_json(*document));
}

/// A row of the store, as JSON; what is no row is refused by an exception, which the store turns into a fault.
[[maybe_unused]] void store(const fs::path& file) {
  Faults faults;
  const auto row = read_json(file, faults);
  if (!row || !row->is_object()) return;
  const auto part = [&](const char* name) { return row->value(name, nlohmann::json()); };
  const auto try_to = [](auto read) {
    try {
      read();
    } catch (const nlohmann::json::exception&) {
    } catch (const std::invalid_argument&) {
    }
  };
  try_to([&] { to_json(observables_from_json(nlohmann::ordered_json(part("observables")))); });
  try_to([&] { to_json(failure_from_json(part("failure"))); });
  try_to([&] { to_json(run_from_json(part("run")), 0); });
  try_to([&] { parameters_to_json(parameters_from_json(part("parameter_values"))); });
}

}  // namespace

}  // namespace pastefit

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = pastefit::desk() / "read" / "file.json";
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  pastefit::PASTEFIT_FUZZ_READER(file);
  return 0;
}
