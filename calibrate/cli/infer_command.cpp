#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "calibrate/base/text.h"
#include "calibrate/card/card.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/inference/description.h"
#include "calibrate/report/findings.h"
#include "calibrate/report/page.h"
#include "calibrate/report/summary.h"
#include "calibrate/store/output_folder.h"
#include "calibrate/store/program.h"
#include "calibrate/study/study.h"
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

/// Reasons why a card does not belong to the present study.
Faults differences(const Card& card, const Study& study, const std::string& file) {
  Faults faults;
  const auto compare = [&](const std::string& name, const std::string& before, const std::string& now) {
    if (before != now)
      faults.push_back({file, "was made from another " + name + " (its hash is " + before + ", now " + now + ")",
                        "give the study as it was, or continue with pastefit calibrate --resume"});
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
  const std::string card_file = (from / kCardFile).string(), store_file = (from / kStore).string();
  auto read = read_card(card_file);
  const auto settings = read.ok() ? read.value().provenance.settings : std::vector<std::string>();
  const Study study = value_or_throw(read_study_with(options.study, settings));
  Card card = value_or_throw(std::move(read));
  refuse(differences(card, study, card_file));
  const Store store = value_or_throw(Store::read(store_file));
  for (const auto& remark : store.remarks()) note("pastefit: %s: %s\n", kStore.c_str(), remark.c_str());
  const std::string& simulated_by = store.identity().program;
  const auto record = everything_of(study, store);
  if (std::ranges::none_of(record, [](const StoredEvaluation& one) { return !one.failure && !one.run.ended_early; }))
    refuse({{store_file, "has no finished simulation of this study's tests, made by '" + simulated_by + "'",
             "the folder of a calibration of this study"}});
  if (card.search.status == "out_of_reach")
    refuse({{card_file,
             "a measured reading was out of reach; readings that no material reproduces do not determine parameters",
             "other bounds, and pastefit calibrate --resume"}});
  std::optional<OutputFolder> folder;
  const auto earlier = options.force ? EarlierResult::replace : EarlierResult::refuse;
  if (!options.out.empty())
    folder = value_or_throw(OutputFolder::open(options.out, {kCardFile, kSummary}, earlier, kSpace));

  TrainingData evidence = training_data_of(study, record);
  evidence.conditions = card.inference.conditions;
  const Inference inference = inference_of(card, evidence);
  card.inference = card_inference(inference);
  std::string findings = describe(inference);
  if (simulated_by != program_identity()) {
    findings += "Simulated by " + simulated_by + "; inferred by " + program_identity() + ", without simulating.\n";
    card.inference.method += ", by " + program_identity();
  }
  const std::string summary = summary_of(card, findings);
  print(options.json ? json_text(to_json(card)) : summary);
  if (!folder) return kDone;
  refuse(write_card(*folder, card, summary), kFailed);
  note("wrote %s\nwrote %s\n", folder->file(kCardFile).c_str(), folder->file(kSummary).c_str());
  return kDone;
}

}  // namespace

Command add_infer(CLI::App& verb) {
  const auto options = std::make_shared<InferOptions>();
  verb.add_option("STUDY", options->study, "study file")->required();
  verb.add_option("--from", options->from,
                  "folder of its calibration; another version of the program may have made its simulations")
      ->required()
      ->type_name("DIR");
  verb.add_option("--out", options->out,
                  "folder for card.json and summary.txt, possibly the same; default: the summary is only printed")
      ->type_name("DIR");
  verb.add_flag("--force", options->force, "replace the card and the summary in --out");
  verb.add_flag("--json", options->json, "print the card instead of the summary");
  return [options] { return infer_again(*options); };
}

}  // namespace pastefit
