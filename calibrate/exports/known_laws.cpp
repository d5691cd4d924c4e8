#include "calibrate/exports/known_laws.h"

#include <algorithm>
#include <array>
#include <string>

#include "calibrate/base/fault_text.h"
#include "calibrate/laboratory/names.h"

namespace pastefit {

namespace {

template <class T, std::size_t N>
void look(T chosen, const std::vector<T>& known, const std::array<Named<T>, N>& words, const std::string& place,
          const std::string& key, std::string_view target, Faults& faults) {
  if (std::ranges::count(known, chosen) > 0) return;
  std::string list;
  for (const T one : known) list += (list.empty() ? "" : " or ") + in_quotes(word_of(one, words));
  faults.push_back({place, "is " + in_quotes(word_of(chosen, words)) + ", which " + std::string(target) + " lacks",
                    "export to another target, or calibrate with " + key + " " + list});
}

}  // namespace

Faults unknown_laws(const ContactModel& contact, const KnownLaws& known) {
  Faults faults;
  look(contact.normal, known.normal, normal_laws, "test.contact.normal", "normal", known.target, faults);
  look(contact.rolling, known.rolling, rolling_models, "test.contact.rolling", "rolling_model", known.target, faults);
  if (!known.attraction.empty())
    look(contact.bridge.shape, known.attraction, bridge_shapes, "test.contact.bridge.shape", "attraction", known.target,
         faults);
  if (contact.bridge.viscosity_pa_s > 0 && !known.viscosity)
    faults.push_back({"test.contact.bridge.viscosity_pa_s",
                      "is not 0, but " + std::string(known.target) + " lacks the viscosity of a bridge",
                      "export to another target, or calibrate with viscosity_pa_s 0"});
  return faults;
}

}  // namespace pastefit
