#include "calibrate/report/findings.h"

#include <algorithm>
#include <utility>

#include "calibrate/base/text.h"
#include "calibrate/card/card.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/inference/examination.h"
#include "calibrate/store/output_folder.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

namespace fs = std::filesystem;

/// Faults as the end of a sentence.
std::string in_words(const Faults& faults) {
  constexpr std::size_t kMost = 3;
  std::string out;
  for (std::size_t i = 0; i < std::min(faults.size(), kMost); ++i)
    out += (i > 0 ? "; " : "") + faults[i].where + " " + faults[i].what;
  if (faults.size() > kMost) out += "; and " + std::to_string(faults.size() - kMost) + " more";
  return out;
}

/// Adds the inference of the card's parameters.
void infer_from(const Store& store, const std::optional<Inference>& known, Findings& findings) {
  const Card& card = *findings.card;
  const auto record = everything_of(*findings.study, store);
  const bool of_use =
      std::ranges::any_of(record, [](const StoredEvaluation& one) { return !one.failure && !one.run.ended_early; });
  if (!of_use) {
    findings.missing.push_back("No stored simulation of the card's tests is complete, so there are no intervals.");
    return;
  }
  findings.evidence = training_data_of(*findings.study, record);
  findings.evidence->conditions = card.inference.conditions;
  if (card.search.status == "out_of_reach") {
    findings.missing.push_back(
        "A measured reading was out of reach; readings that no material reproduces do not determine parameters.");
    return;
  }
  findings.inference = known ? *known : inference_of(card, *findings.evidence);
}

void take_evaluations(const Store& store, const std::optional<Inference>& inference, Findings& findings) {
  for (const std::string& remark : store.remarks())
    findings.missing.push_back("The record of the search is incomplete: " + remark + ".");
  findings.evaluations = store.all();
  findings.program = store.identity().program;
  if (findings.card) infer_from(store, inference, findings);
}

/// Sorts readings by the order of their test; a card file has them in alphabetical order.
void order_readings(CardTest& test) {
  const auto kinds = reading_kinds(test.test);
  std::ranges::stable_sort(test.readings, {}, [&](const CardReading& one) {
    return std::ranges::find(kinds, one.name, &ReadingKind::name) - kinds.begin();
  });
}

void take_card(Card card, Findings& findings) {
  for (CardTest& test : card.tests) order_readings(test);
  findings.study = study_of(card);
  findings.card = std::move(card);
}

}  // namespace

Inference inference_of(const Card& card, const TrainingData& evidence) {
  InferenceOptions options;
  options.seed = card.search.seed;
  Inference inference = infer(evidence, point_of(card), options);
  inference.recommended_because = reason_for(card.search.status == "confirmed", card.confirmation.packings.size());
  return inference;
}

Result<Findings> read_findings(const fs::path& folder) {
  std::error_code error;
  const fs::path card_file = folder / kCardFile, store_file = folder / kStore;
  if (!fs::is_directory(folder, error))
    return Fault{folder.string(), "is not a folder", "the folder of a calibration, as given to --out"};
  const bool has_card = fs::exists(card_file, error);
  if (!has_card && !fs::exists(store_file, error))
    return Fault{folder.string(), "holds neither " + kCardFile + " nor " + kStore,
                 "the folder of a calibration, as given to --out"};
  Findings findings;
  if (!has_card) {
    findings.missing.push_back("There is no " + kCardFile +
                               ": the calibration is still running, or was interrupted before it had a result.");
  } else if (auto card = read_card(card_file); card.ok()) {
    take_card(std::move(card).value(), findings);
  } else {
    findings.missing.push_back("The card cannot be read: " + in_words(card.faults()) + ".");
  }
  if (const auto kept = Store::read(store_file); kept.ok())
    take_evaluations(kept.value(), {}, findings);
  else
    findings.missing.push_back("The simulations of the search are not shown: " + in_words(kept.faults()) + ".");
  return findings;
}

Result<FittingMaterials> read_fitting_materials(const fs::path& folder) {
  const auto findings = read_findings(folder);
  if (!findings.ok()) return findings.faults();
  const Findings& read = findings.value();
  if (!read.card || !read.inference)
    return Fault{folder.string(),
                 "does not contain materials that fit: " +
                     (read.missing.empty() ? std::string("there is no inference") : one_line(read.missing.front())),
                 "give the folder of a calibration that found a material"};
  FittingMaterials found{*read.card, {}};
  for (const EquivalentMaterial& one : read.inference->family)
    found.values.push_back(values_at(*read.study, {one.point.data(), static_cast<std::size_t>(one.point.size())}));
  return found;
}

Findings findings_without_card(const Study& study, const Store& store) {
  Findings findings;
  findings.study = study;
  take_evaluations(store, {}, findings);
  return findings;
}

Findings findings_of(const Card& card, const Store& store, const std::optional<Inference>& inference) {
  Findings findings;
  take_card(card, findings);
  take_evaluations(store, inference, findings);
  return findings;
}

}  // namespace pastefit
