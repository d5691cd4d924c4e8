#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/text.h"
#include "calibrate/card/card.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/inference/description.h"
#include "calibrate/inference/examination.h"
#include "calibrate/report/summary.h"
#include "calibrate/store/output_folder.h"
#include "calibrate/store/program.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

struct InferOptions {
  std::string study;
  std::string from;
  std::string out;
  bool force = false;
  bool json = false;
};

const std::vector<std::string> kResults{"card.json", "summary.txt"};

/// What keeps a card from being one of the study as it is.
Faults differences(const Card& card, const Study& study, const std::string& file) {
  Faults faults;
  const auto compare = [&](const std::string& name, const std::string& before, const std::string& now) {
    if (before != now)
      faults.push_back({file, "was made from another " + name + " (its hash is " + before + ", now " + now + ")",
                        "give the study as it was, or go on with pastefit calibrate --resume"});
  };
  compare("study", card.provenance.study_hash, study.hash);
  for (std::size_t i = 0; i < card.tests.size() && i < study.tests.size(); ++i) {
    const CardTest& test = card.tests[i];
    compare("laboratory file" + (test.name.empty() ? "" : " of test " + test.name), test.lab_hash,
            study.tests[i].lab.hash);
  }
  return faults;
}

int infer_again(const InferOptions& options) {
  const std::filesystem::path from = options.from;
  const std::string card_file = (from / kResults[0]).string(), store_file = (from / kStore).string();
  const auto study = read_study(options.study);
  if (!study.ok()) return report(study.faults());
  auto read = read_card(card_file);
  if (!read.ok()) return report(read.faults());
  Card& card = read.value();
  if (const auto faults = differences(card, study.value(), card_file); !faults.empty()) return report(faults);
  const auto store = Store::read(store_file);
  if (!store.ok()) return report(store.faults());
  for (const auto& remark : store.value().remarks()) note("pastefit: %s: %s\n", kStore.c_str(), remark.c_str());
  const std::string& simulated_by = store.value().identity().program;
  const auto record = everything_of(study.value(), store.value());
  const UnitPoint recommended = point_of(card);
  if (std::ranges::none_of(record, [](const StoredEvaluation& one) { return !one.failure && !one.run.ended_early; }))
    return report({{store_file, "has no finished simulation of this study's tests, made by '" + simulated_by + "'",
                    "the folder of a calibration of this study"}});
  if (card.search.status == "out_of_reach")
    return report({{card_file,
                    "the laboratory was out of reach, and readings that no material meets say nothing of "
                    "the parameters",
                    "other bounds, and pastefit calibrate --resume"}});
  std::optional<OutputFolder> folder;
  if (!options.out.empty()) {
    auto opened = OutputFolder::open(options.out, kResults,
                                     options.force ? EarlierResult::replace : EarlierResult::refuse, kSpace);
    if (!opened.ok()) return report(opened.faults());
    folder.emplace(std::move(opened).value());
  }

  InferenceOptions inference_options;
  inference_options.seed = card.search.seed;
  TrainingData evidence = training_data_of(study.value(), record);
  evidence.conditions = card.inference.conditions;
  Inference inference = pastefit::infer(evidence, recommended, inference_options);
  inference.recommended_because = reason_for(card.search.status == "confirmed", card.confirmation.packings.size());
  card.inference = card_inference(inference);
  std::string findings = describe(inference);
  if (simulated_by != program_identity()) {
    findings += "Simulated by " + simulated_by + "; inferred by " + program_identity() + ", without simulating.\n";
    card.inference.method += ", by " + program_identity();
  }
  const std::string summary = summary_of(card, findings);
  print("%s", options.json ? json_text(to_json(card)).c_str() : summary.c_str());
  if (!folder) return kDone;
  auto faults = write_card(folder->file(kResults[0]), card);
  if (faults.empty()) faults = write_atomically(folder->file(kResults[1]), summary);
  if (!faults.empty()) return report(faults, kFailed);
  note("wrote %s\nwrote %s\n", folder->file(kResults[0]).c_str(), folder->file(kResults[1]).c_str());
  return kDone;
}

}  // namespace

Command add_infer(CLI::App& verb) {
  const auto options = std::make_shared<InferOptions>();
  verb.add_option("STUDY", options->study, "study file")->required();
  verb.add_option("--from", options->from, "folder of its calibration; the simulations there may be another program's")
      ->required()
      ->type_name("DIR");
  verb.add_option("--out", options->out,
                  "folder for card.json and summary.txt, which may be the same; else they are "
                  "only shown")
      ->type_name("DIR");
  verb.add_flag("--force", options->force, "replace the card and the summary in --out");
  verb.add_flag("--json", options->json, "print the card instead of the summary");
  return [options] { return infer_again(*options); };
}

}  // namespace pastefit
