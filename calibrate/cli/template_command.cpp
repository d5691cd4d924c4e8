#include <memory>

#include "calibrate/base/text.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/study/apparatus.h"
#include "calibrate/study/slump_sheet.h"
#include "calibrate/study/target_laws.h"

namespace pastefit {

namespace {

struct TemplateOptions {
  std::string name, target, law, mould;
};

/// Starting files of a mould for dry materials; for other moulds, its laboratory file and the common study of slump
/// tests.
std::string template_of_mould(const TemplateOptions& options) {
  if (options.name != "lab" && options.name != "study")
    refuse({{"--mould " + printable(options.mould), "is for lab and study, not for " + printable(options.name),
             "template lab --mould ..., template study --mould ..."}});
  if (auto own = template_text(options.name + "-" + options.mould)) return *own;
  std::string lab = value_or_throw(slump_lab_template(options.mould, "."));
  return options.name == "study" ? *template_text("study") : lab;
}

int print_template(TemplateOptions options, const std::string& names) {
  if (!options.mould.empty()) options.mould = preset_of_standard(options.mould, ".");
  auto text = template_text(options.name);
  if (!text) refuse({{"template " + printable(options.name), "there is no such starting file", "one of " + names}});
  if (!options.target.empty() || !options.law.empty()) {
    const std::string target = options.target.empty() ? std::string(target_laws().front().target) : options.target;
    const auto laws = laws_for(target, options.law);
    if (options.name != "study" || !options.mould.empty())
      refuse({{options.law.empty() ? "--for" : "--law", "is for the first study only", "template study --for ..."}});
    if (!laws) refuse({no_such_laws(target, options.law)});
    text = with_laws(*text, *laws);
  }
  if (!options.mould.empty()) text = template_of_mould(options);
  print(*text);
  return kDone;
}

}  // namespace

Command add_template(CLI::App& verb) {
  const std::string names = listed(template_names());
  const auto options = std::make_shared<TemplateOptions>();
  verb.add_option("NAME", options->name, "which one: " + names)->required();
  verb.add_option("--for", options->target, "study with laws that this program has: " + names_of_targets())
      ->type_name("PROGRAM");
  verb.add_option("--law", options->law, "study with this law: " + names_of_laws())->type_name("LAW");
  verb.add_option("--mould", options->mould,
                  "for lab or study: preset (abrams, mini-cone, haegermann-table, ...) whose table, grains and usual "
                  "readings the laboratory file gets; lifted-cylinder has a study of its own")
      ->type_name("PRESET");
  return [options, names] { return print_template(*options, names); };
}

}  // namespace pastefit
