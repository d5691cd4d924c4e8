#pragma once

#include <nlohmann/json_fwd.hpp>

#include "calibrate/base/object_schema.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

// JSON schemas of user files, `data/schema`.

nlohmann::ordered_json apparatus_schema();
nlohmann::ordered_json lab_schema();
nlohmann::ordered_json study_schema();
/// Names of the laws; the other schemas refer to it.
nlohmann::ordered_json laws_schema();

// Parts of the schemas, each defined beside its reader.

void tell_provenance(ObjectSchema& document);
void tell_test(ObjectSchema& document, bool presets);
void tell_grains(ObjectSchema& document, Need need);
void tell_density(ObjectSchema& material);

void tell_yield_stress(ObjectSchema& material);
void tell_measurements(ObjectSchema& lab);

void tell_tests(ObjectSchema& study);

/// "free", "scale" and "prior" of a parameter. `range`: its admissible values.
void read_free(ObjectReader& reader, const Range& range, Parameter& parameter);
void tell_parameter(ObjectSchema& parameters, const ParameterKind& kind);

/// "search" of a study with this number of fitted tests.
void read_search_options(ObjectReader& document, int fitted_tests, SearchOptions& search);
void tell_search_options(ObjectSchema& study);

}  // namespace pastefit
