#include <unistd.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <utility>

#include "calibrate/base/json_reader.h"
#include "calibrate/base/machine.h"
#include "calibrate/base/text.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/store/program.h"
#include "core/step/kernels.h"

namespace pastefit {

namespace {

/// Prints every fault to standard error; returns the exit status.
int report(const Refusal& refusal) {
  const std::size_t count = refusal.faults.size();
  std::fprintf(stderr, "pastefit: %zu error%s\n%s\n", count, count == 1 ? "" : "s",
               for_terminal(lines_of(message_of(refusal.faults))).c_str());
  return refusal.status;
}

/// Contact kernels used by runs.
std::string kernels_note() {
  const std::string_view set = kernels_of_this_processor().instruction_set;
  const bool plain = set == "SSE2";
  return "contact kernels: " + std::string(set) +
         (plain ? " (slower than AVX2 and AVX-512; the last bits of results differ)" : "");
}

/// Options that the verb does not have; CLI11 would first report missing required ones.
Faults unknown_options(const CLI::App& verb, int argc, char** argv) {
  Names names;
  for (const CLI::Option* option : verb.get_options())
    for (const std::string& name : option->get_lnames()) names.insert("--" + name);
  Faults faults;
  for (int i = 2; i < argc && std::string_view(argv[i]) != "--"; ++i) {
    const std::string word = std::string(argv[i]).substr(0, std::string_view(argv[i]).find('='));
    if (!word.starts_with("--") || names.contains(word)) continue;
    const auto near = nearest(word, names);
    faults.push_back({printable(word), "is not an option of pastefit " + verb.get_name(),
                      near ? "did you mean " + *near + "?" : "see pastefit help " + verb.get_name()});
  }
  return faults;
}

/// Help with lines that fit the terminal.
struct WrappedHelp : CLI::Formatter {
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    return wrapped(CLI::Formatter::make_help(app, std::move(name), mode));
  }
};

int run(int argc, char** argv) {
  refuse(obey_kernels_variable());
  CLI::App program("Calibrates DEM contact models of pastes and wet granules from laboratory tests.", "pastefit");
  program.formatter(std::make_shared<WrappedHelp>());
  program.set_version_flag("--version", "pastefit " + program_version() + "\n" + kernels_note());
  program.require_subcommand(1);
  program.fallthrough(false);

  struct Verb {
    const char* group;  ///< heading in the help
    const char* name;
    const char* meaning;
    Command (*add)(CLI::App&);
  };
  constexpr const char *kStart = "Start", *kCalibrate = "Calibrate", *kLook = "Look", *kUse = "Use elsewhere",
                       *kTrust = "Check", *kMany = "Many studies";
  constexpr Verb kVerbs[] = {
      {kStart, "new", "write a laboratory file and a study from the values of a measuring sheet", add_new},
      {kStart, "plan", "say which test or reading would tell most, before anything is measured", add_plan},
      {kStart, "template", "print a commented starting file", add_template},
      {kStart, "help", "describe the program, or one of its verbs", add_help},
      {kCalibrate, "calibrate", "find the material that reproduces the measured readings of a study", add_calibrate},
      {kCalibrate, "simulate", "run the test of a study, card, laboratory, apparatus or impact file once",
       add_simulate},
      {kCalibrate, "infer", "calculate the intervals of the parameters from the stored simulations of a calibration",
       add_infer},
      {kLook, "show", "print a material card as text", add_show},
      {kLook, "compare", "show material cards side by side: parameters, intervals, readings", add_compare},
      {kLook, "report", "write the page of a calibration again, for a browser", add_report},
      {kLook, "predict", "predict another test with the materials that fit a calibration", add_predict},
      {kUse, "export", "write the test of a material card for another DEM program", add_export},
      {kUse, "kpi", "print flow, residue, forces and depth of an exported application, for all materials that fit",
       add_kpi},
      {kUse, "read", "compare the heap of an exported deck with the card", add_read},
      {kUse, "confirm", "simulate the test of a material card in LAMMPS and add the result to the card", add_confirm},
      {kUse, "rescale", "convert a material card to another grain size and measure the bias", add_rescale},
      {kTrust, "doctor", "say of each property of a calibration whether it is fine, or what is doubtful", add_doctor},
      {kTrust, "check", "simulate cards again and compare within the noise", add_check},
      {kTrust, "verify", "compare the contact laws with closed forms, case by case", add_verify},
      {kMany, "batch", "calibrate many studies, one after the other or as an array job, and make one table of them",
       add_batch}};
  const Names names = names_of(kVerbs, &Verb::name);
  if (argc > 1 && argv[1][0] != '-' && !names.contains(argv[1])) {
    const auto near = nearest(argv[1], names);
    refuse({{argv[1], "is not a verb of pastefit", near ? "did you mean '" + *near + "'?" : "see pastefit --help"}});
  }
  Command chosen;
  for (const auto& verb : kVerbs) {
    auto* app = program.add_subcommand(verb.name, verb.meaning)->group(verb.group);
    app->add_flag_callback("--quiet", be_quiet, "no progress and no notes, only the result and errors");
    app->callback([&chosen, command = verb.add(*app)] { chosen = command; });
  }

  if (argc == 1) {
    print(program.help());
    return kDone;
  }
  if (names.contains(argv[1])) refuse(unknown_options(*program.get_subcommand(argv[1]), argc, argv));
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int status = program.exit(error);
    return status == 0 ? kDone : kBadInput;
  }
  return chosen();
}

}  // namespace
}  // namespace pastefit

int main(int argc, char** argv) {
  int status = 70;
  try {
    pastefit::guard_standard_streams();
    pastefit::keep_freed_memory();
    try {
      status = pastefit::run(argc, argv);
    } catch (const pastefit::Refusal& refusal) {
      status = pastefit::report(refusal);
    }
    status = pastefit::after_output(status);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pastefit: this is a bug in the program, please report it: %s\n", error.what());
  }
  // Skips the destructors of libraries: OpenBLAS waits forever for its thread if memory was low when it was loaded.
  std::fflush(nullptr);
  _exit(status);
}
