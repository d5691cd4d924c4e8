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
void tell_parameter(ObjectSchema& parameters, const ParameterKind& kind);
void tell_search_options(ObjectSchema& study);

}  // namespace pastefit
