#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "calibrate/base/object_schema.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

// The JSON schemas of files for people, `data/schema`.

nlohmann::ordered_json apparatus_schema();
nlohmann::ordered_json lab_schema();
nlohmann::ordered_json study_schema();
/// Of the words of laws, to which the others refer.
nlohmann::ordered_json laws_schema();

// Their parts, each told beside its reader.

void tell_provenance(ObjectSchema& document);
/// "test" and "apparatus".
void tell_test(ObjectSchema& document, bool presets);
void tell_grains(ObjectSchema& document, Need need);
void tell_density(ObjectSchema& material);

void tell_yield_stress(ObjectSchema& material);
void tell_measurements(ObjectSchema& lab);

void tell_tests(ObjectSchema& study);

/// "free", "scale" and "prior" of a parameter. `range`: where it is admissible.
void read_free(ObjectReader& reader, const Range& range, Parameter& parameter);
void tell_parameter(ObjectSchema& parameters, const ParameterKind& kind);

/// "search" of a study in which so many tests are fitted.
void read_search_options(ObjectReader& document, int fitted_tests, SearchOptions& search);
void tell_search_options(ObjectSchema& study);

}  // namespace pastefit
