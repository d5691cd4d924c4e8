#include "calibrate/search/residual_size.h"

#include <algorithm>
#include <cmath>

#include "calibrate/base/fault_text.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

bool has_finite_square(double residual) {
  return std::isfinite(residual * residual);
}

bool is_positive(double number) {
  return number > 0 && std::isfinite(number);
}

}  // namespace

double worst_miss(const Study& study, std::size_t test, const Measurement& measurement) {
  const auto kinds = reading_kinds(study.tests.at(test).lab.test);
  const ReadingKind* kind = find_kind(kinds, measurement.observable);
  const double bound = kind && kind->worst_miss ? *kind->worst_miss : 10 * measurement.standard_deviation;
  return std::max(std::abs(measurement.value), bound);
}

Faults validate_residuals(const Study& study) {
  Faults faults;
  for (const Parameter& parameter : study.parameters) {
    if (!parameter.free || !parameter.prior) continue;
    const UnitPrior prior = unit_prior(parameter);
    const bool good = is_positive(prior.deviation) && has_finite_square(prior.mean / prior.deviation) &&
                      has_finite_square((1 - prior.mean) / prior.deviation);
    if (!good)
      faults.push_back({"parameters." + parameter.name + ".prior.standard_deviation",
                        shown(parameter.prior->standard_deviation) + " makes residuals that are not finite",
                        "a larger one, or a fixed value"});
  }
  for (const StudyReading& reading : readings_of(study)) {
    const auto& [test, name, measurement, weight, tolerance] = reading;
    const double difference = worst_factor * worst_miss(study, test, measurement);
    const auto refuse = [&, &place = reading.name](bool good, const char* what, double value) {
      if (!good)
        faults.push_back({place, std::string(what) + " " + shown(value) + " makes residuals that are not finite",
                          "a number above 0, of the size of the reading"});
    };
    const double deviation = measurement.standard_deviation;
    refuse(is_positive(deviation) && has_finite_square(std::sqrt(weight) * difference / deviation),
           "standard deviation", deviation);
    refuse(is_positive(tolerance) && has_finite_square(difference / tolerance), "tolerance", tolerance);
  }
  return faults;
}

}  // namespace pastefit
