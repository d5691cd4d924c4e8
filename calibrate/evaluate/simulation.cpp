#include "calibrate/evaluate/simulation.h"

#include <stdexcept>
#include <utility>

#include "calibrate/evaluate/early_end.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

const Test& bare_test(const Simulation& simulation) {
  return simulation.study->tests.at(simulation.test).lab.test;
}

}  // namespace

Test test_of(const Simulation& simulation) {
  return test_with(bare_test(simulation), values_at(*simulation.study, coordinates(simulation.point)),
                   simulation.packing);
}

std::optional<Cutoff> cutoff_of(const Simulation& simulation) {
  return simulation.may_end_early ? cutoff_of(*simulation.study, simulation.test) : std::nullopt;
}

StoredEvaluation unanswered(const Simulation& simulation, std::string_view program) {
  const UnitPoint& point = simulation.point;
  if (point.size() != free_count(*simulation.study) || !point.allFinite() || point.minCoeff() < 0 ||
      point.maxCoeff() > 1)
    throw std::logic_error("a candidate must lie in the unit cube over the free parameters");
  StoredEvaluation out;
  out.values = values_at(*simulation.study, coordinates(point));
  out.key = key_of(*simulation.study, simulation.test, out.values, simulation.packing, program);
  out.point.assign(point.begin(), point.end());
  out.packing = simulation.packing;
  return out;
}

void enter(StoredEvaluation& evaluation, Outcome outcome, const std::optional<Cutoff>& cutoff) {
  evaluation.failure = std::move(outcome.failure);
  if (!evaluation.failure) evaluation.readings = std::move(outcome.readings);
  evaluation.run = outcome.run;
  if (outcome.run.ended_early) evaluation.key = key_of_ended(evaluation.key, cutoff.value());
}

std::optional<StoredEvaluation> find(const Store& store, const Simulation& simulation) {
  return find(store, bare_test(simulation), unanswered(simulation, store.identity().program).key,
              cutoff_of(simulation));
}

}  // namespace pastefit
