#include "calibrate/study/questions.h"

#include <algorithm>
#include <utility>

namespace pastefit {

Questions::Questions(ObjectReader& document) : faults_(document.faults()) {
  document.texts("confirmed", confirmed_, Need::optional);
}

void Questions::ask(const std::string& place, std::string what, std::string remedy) {
  if (std::ranges::count(confirmed_, place) > 0)
    note(place, std::move(what) + ", as confirmed");
  else
    faults_.push_back({place, std::move(what),
                       std::move(remedy) + "; if it is right, say \"confirmed\": [" + in_quotes(place) + "]"});
}

}  // namespace pastefit
