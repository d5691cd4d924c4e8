#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/embedded_text.h"
#include "calibrate/base/json_reader.h"
#include "calibrate/base/text.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/store/program.h"

namespace pastefit {

// Manual and shell completion, generated from the definitions of the command line.

namespace {

/// Verbs of a program, in the order of its table.
std::vector<const CLI::App*> verbs_of(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App*) { return true; });
}

/// Escapes text for roff: no line begins a request, and hyphens stay ASCII.
std::string roff(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) out += "\\&";
    if (c == '-' || c == '\\')
      out += c == '-' ? "\\-" : "\\e";
    else
      out += c;
  }
  return out;
}

/// "--out DIR", "-h,--help", "STUDY".
std::string shape_of(const CLI::Option& option) {
  const bool positional = option.get_positional();
  const std::string name = option.get_name(positional, !positional), type = option.get_type_name();
  return positional || type.empty() || option.get_items_expected_max() == 0 ? name : name + " " + type;
}

std::string synopsis_of(const CLI::App& verb) {
  std::string out;
  for (const CLI::Option* option : verb.get_options()) {
    if (option->get_positional())
      out += option->get_required() ? " " + option->get_name(true) : " [" + option->get_name(true) + "]";
    else if (option->get_required())
      out += " " + shape_of(*option);
  }
  return out + " [OPTIONS]";
}

std::string flags_of(const CLI::App& verb) {
  std::string out;
  for (const CLI::Option* option : verb.get_options())
    for (const std::string& name : option->get_lnames()) out += (out.empty() ? "--" : " --") + name;
  return out;
}

std::string bash_completion(const CLI::App& program) {
  std::string verbs, cases;
  for (const CLI::App* verb : verbs_of(program)) {
    verbs += verb->get_name() + " ";
    cases += "    " + verb->get_name() + ") words=" + shell_word(flags_of(*verb)) + " ;;\n";
  }
  return filled_in("cli/texts/completion.bash", {{"verbs", shell_word(verbs + "--help --version")}, {"cases", cases}});
}

std::string zsh_completion(const CLI::App& program) {
  std::string out = "#compdef pastefit\nlocal -a verbs=(\n";
  for (const CLI::App* verb : verbs_of(program))
    out += "  " + shell_word(verb->get_name() + ":" + verb->get_description()) + "\n";
  out += ")\nif (( CURRENT == 2 )); then\n  _describe verb verbs\n  return\nfi\ncase $words[2] in\n";
  for (const CLI::App* verb : verbs_of(program))
    out += "  " + verb->get_name() + ") compadd -- " + flags_of(*verb) + " ;;\n";
  return out + "esac\n_files\n";
}

std::string fish_completion(const CLI::App& program) {
  std::string out;
  for (const CLI::App* verb : verbs_of(program)) {
    out += "complete -c pastefit -n __fish_use_subcommand -f -a " + verb->get_name() + " -d " +
           shell_word(verb->get_description()) + "\n";
    for (const CLI::Option* option : verb->get_options())
      for (const std::string& name : option->get_lnames())
        out += "complete -c pastefit -n '__fish_seen_subcommand_from " + verb->get_name() + "' -l " + name +
               (option->get_items_expected_max() > 0 ? " -r" : "") + " -d " + shell_word(option->get_description()) +
               "\n";
  }
  return out;
}

/// Page of a verb, or of the program, for man(1), section 1.
std::string man_page_of(const CLI::App& app) {
  const bool is_program = app.get_parent() == nullptr;
  const std::string name = (is_program ? "" : "pastefit-") + app.get_name();
  std::string out = ".TH " + roff(name) + " 1 \"\" \"pastefit " + roff(program_version()) + "\"\n";
  out += ".SH NAME\n" + roff(name) + " \\- " + roff(app.get_description()) + "\n.SH SYNOPSIS\n.B ";
  out += is_program ? "pastefit\nVERB [OPTIONS]\n" : "pastefit " + roff(app.get_name() + synopsis_of(app)) + "\n";
  if (is_program) {
    out += ".SH VERBS\n";
    for (const CLI::App* verb : verbs_of(app))
      out += ".TP\n.BR pastefit\\-" + roff(verb->get_name()) + " (1)\n" + roff(verb->get_description()) + "\n";
  }
  out += ".SH OPTIONS\n";
  for (const CLI::Option* option : app.get_options())
    out += ".TP\n.B " + roff(shape_of(*option)) + "\n" + roff(option->get_description()) + "\n";
  out +=
      ".SH EXIT STATUS\n0: done, and the answer is positive; 1: the answer is negative, or the result could not be "
      "written;\n2: unusable input, all errors are listed and nothing is written; 70: a bug in the program.\n";
  return out + ".SH SEE ALSO\n" +
         (is_program ? "The README in share/doc/pastefit.\n"
                     : ".BR pastefit (1), and the README in share/doc/pastefit.\n");
}

namespace fs = std::filesystem;

/// Writes every page, and a completion for each shell, in the layout of packages.
int write_manual(const CLI::App& program, const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  Faults faults;
  const auto write = [&](const std::string& name, const std::string& text) {
    append(faults, write_atomically(folder / name, text));
  };
  write("pastefit.1", man_page_of(program));
  for (const CLI::App* verb : verbs_of(program)) write("pastefit-" + verb->get_name() + ".1", man_page_of(*verb));
  write("pastefit.bash", bash_completion(program));
  write("pastefit.zsh", zsh_completion(program));
  write("pastefit.fish", fish_completion(program));
  refuse(faults, kFailed);
  return kDone;
}

int print_help(const CLI::App& program, const std::string& name) {
  if (name.empty()) {
    // program.help() would print the help of the current verb.
    const auto form = program.get_formatter();
    print(form->make_help(&program, program.get_name(), CLI::AppFormatMode::Normal));
    return kDone;
  }
  const Names names = names_of(verbs_of(program), &CLI::App::get_name);
  if (names.contains(name)) {
    print(program.get_subcommand(name)->help(program.get_name()));
    return kDone;
  }
  const auto near = nearest(name, names);
  throw Refusal{
      {{"help " + name, "there is no such verb", near ? "did you mean '" + *near + "'?" : "see pastefit help"}},
      kBadInput};
}

}  // namespace

Command add_help(CLI::App& verb) {
  const auto name = std::make_shared<std::string>(), folder = std::make_shared<std::string>();
  verb.add_option("VERB", *name, "verb to describe");
  verb.add_option("--write", *folder, "write man pages and completions for bash, zsh and fish to this folder instead")
      ->type_name("DIR");
  return [name, folder, program = verb.get_parent()] {
    return folder->empty() ? print_help(*program, *name) : write_manual(*program, *folder);
  };
}

}  // namespace pastefit
