#include <filesystem>
#include <memory>
#include <set>
#include <system_error>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/json_reader.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/manual.h"
#include "calibrate/cli/standard_output.h"

namespace pastefit {

namespace {

namespace fs = std::filesystem;

/// Every page, and a completion for each shell, as packages have them.
int write_manual(const CLI::App& program, const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  Faults faults;
  const auto write = [&](const std::string& name, const std::string& text) {
    for (Fault& fault : write_atomically(folder / name, text)) faults.push_back(std::move(fault));
  };
  write("pastefit.1", man_page_of(program));
  for (const CLI::App* verb : verbs_of(program)) write("pastefit-" + verb->get_name() + ".1", man_page_of(*verb));
  for (const std::string_view shell : completed_shells)
    write("pastefit." + std::string(shell), completion_of(program, shell));
  return faults.empty() ? kDone : report(faults, kFailed);
}

int print_help(const CLI::App& program, const std::string& name) {
  if (name.empty()) {
    // Not program.help(), which is that of the verb in use: of this one.
    const auto form = program.get_formatter();
    print("%s", form->make_help(&program, program.get_name(), CLI::AppFormatMode::Normal).c_str());
    return kDone;
  }
  std::set<std::string, std::less<>> names;
  for (const CLI::App* verb : verbs_of(program)) {
    names.insert(verb->get_name());
    if (verb->get_name() != name) continue;
    print("%s", verb->help(program.get_name()).c_str());
    return kDone;
  }
  const auto near = nearest(name, names);
  return report(
      {{"help " + name, "there is no such verb", near ? "did you mean '" + *near + "'?" : "see pastefit help"}});
}

}  // namespace

Command add_help(CLI::App& verb) {
  const auto name = std::make_shared<std::string>(), folder = std::make_shared<std::string>();
  verb.add_option("VERB", *name, "which verb");
  verb.add_option("--write", *folder, "write man pages and completions of bash, zsh and fish to this folder, instead")
      ->type_name("DIR");
  return [name, folder, program = verb.get_parent()] {
    return folder->empty() ? print_help(*program, *name) : write_manual(*program, *folder);
  };
}

}  // namespace pastefit
