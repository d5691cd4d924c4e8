#include <cstdio>
#include <memory>

#include "calibrate/cli/commands.h"
#include "calibrate/cli/standard_output.h"
#include "calibrate/laboratory/test.h"

namespace pastefit {

Command add_template(CLI::App& verb) {
  std::string names;
  for (const auto& name : template_names()) names += (names.empty() ? "" : ", ") + name;
  const auto name = std::make_shared<std::string>();
  verb.add_option("NAME", *name, "which one: " + names)->required();
  return [name, names] {
    const auto text = template_text(*name);
    if (!text) return report({{"template " + *name, "there is no such starting file", "one of " + names}});
    print("%s", text->c_str());
    return kDone;
  };
}

}  // namespace pastefit
