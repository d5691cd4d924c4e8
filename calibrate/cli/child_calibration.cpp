#include "calibrate/cli/child_calibration.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "calibrate/base/text.h"
#include "calibrate/card/standing.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/process.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/report/comparison.h"
#include "calibrate/report/page.h"
#include "calibrate/store/output_folder.h"

namespace pastefit {

namespace {

namespace fs = std::filesystem;

constexpr int kMostDeaths = 3;  // of one calibration's process; as for a worker

/// Reason for a missing card from the end of the process; nothing if there is a card.
std::optional<BatchFailure> failure_after(const BatchStudy& one, const ChildEnd& end) {
  if (end.signal != 0)
    return BatchFailure{"failed", format("its process was killed by signal %d, ", end.signal) +
                                      format("%d times; the same command goes on with it", kMostDeaths)};
  if (end.status != kDone && end.status != kFailed)
    return BatchFailure{"failed", format("ended with status %d; to see why: ", end.status) + "pastefit calibrate " +
                                      shell_word(one.file.string()) + " --resume --out " +
                                      shell_word(one.folder.string())};
  const auto answer = nlohmann::json::parse(end.output, nullptr, false);
  if (answer.is_object() && answer.contains("format")) return std::nullopt;
  if (!answer.is_object() || !answer.contains("reason"))
    return BatchFailure{"failed", "it could not write its result to " + one.folder.string()};
  return BatchFailure{answer.value("status", "failed"), answer.value("reason", "")};
}

/// One study for each seed, in folders of their own that are free or may be continued.
std::vector<BatchStudy> studies_of(const Study& study, const std::string& file, const std::string& out,
                                   const Seeds& seeds) {
  std::vector<BatchStudy> all;
  for (int i = 0; i < seeds.count; ++i) {
    BatchStudy one{"", file, "", study};
    one.study.search.seed = study.search.seed + static_cast<std::uint64_t>(i);
    one.name = "seed-" + std::to_string(one.study.search.seed);
    one.folder = fs::path(out) / one.name;
    (void)value_or_throw(open_calibration_folder(one.folder, one.study, seeds.resume, seeds.force));
    all.push_back(std::move(one));
  }
  return all;
}

/// True if the search has confirmed a material, or used the present budget.
bool needs_nothing(const BatchStudy& one) {
  if (!is_finished(one)) return false;
  const Card card = *card_of_batch(one);
  return cause_unconfirmed(card).empty() || card.search.budget >= one.study.search.budget_simulations;
}

struct SeedCards {
  std::vector<CardFile> cards;
  std::vector<std::string> without;  ///< searches without a card, with the reason
};

SeedCards cards_of(const std::vector<BatchStudy>& all) {
  SeedCards out;
  for (const BatchStudy& one : all)
    if (auto card = card_of_batch(one))
      out.cards.push_back({one.name, std::move(*card)});
    else if (const auto failure = read_failure(one))
      out.without.push_back(one.name + ": " + failure->reason);
    else
      out.without.push_back(one.name + ": not finished; the same command with --resume goes on");
  return out;
}

void print_seeds(const SeedCards& found, bool json) {
  if (json) {
    auto out = comparison_json(found.cards);
    out["without_card"] = found.without;
    print("%s", json_text(out).c_str());
    return;
  }
  if (found.cards.size() > 1) print("%s", comparison_lines(found.cards).c_str());
  for (const std::string& one : found.without) print("%s", wrapped("No card of " + one_line(one) + "\n").c_str());
}

}  // namespace

Faults calibrate_in_child(const BatchStudy& one, const std::vector<std::string>& options,
                          const std::atomic<bool>& stop) {
  std::vector<std::string> words{"calibrate", one.file.string(), "--out", one.folder.string(), "--resume", "--json"};
  words.insert(words.end(), options.begin(), options.end());
  if (is_quiet()) words.push_back("--quiet");
  std::error_code error;
  fs::remove(one.folder / kFailureFile, error);
  ChildEnd end;
  try {
    for (int deaths = 0; deaths < kMostDeaths; ++deaths) {
      end = run_this_program(words, stop);
      if (end.signal == 0 || stop) break;
      note("pastefit: %s: the process was killed by signal %d\n", one.name.c_str(), end.signal);
    }
  } catch (const std::system_error& failed) {
    return write_failure(one, {"failed", std::string("no process could be started: ") + failed.what()});
  }
  if (end.signal != 0 && stop) return {};  // can be continued
  if (const auto failure = failure_after(one, end)) return write_failure(one, *failure);
  fs::remove(one.folder / kFailureFile, error);  // written by a concurrent batch
  return {};
}

int calibrate_with_seeds(const Study& study, const std::string& file, const std::string& out, const Seeds& seeds,
                         const std::atomic<bool>& stop) {
  const std::vector<BatchStudy> all = studies_of(study, file, out, seeds);
  Faults faults;
  for (std::size_t i = 0; i < all.size() && !stop; ++i) {
    const bool finished = needs_nothing(all[i]);
    note("%zu of %zu: %s%s\n", i + 1, all.size(), all[i].name.c_str(), finished ? ": finished before" : "");
    if (finished) continue;
    std::vector<std::string> options = seeds.options;
    options.insert(options.end(), {"--seed", std::to_string(all[i].study.search.seed)});
    append(faults, calibrate_in_child(all[i], options, stop));
  }
  const SeedCards found = cards_of(all);
  print_seeds(found, seeds.json);
  refuse(faults, kFailed);
  const auto confirmed =
      std::ranges::count_if(found.cards, [](const CardFile& one) { return cause_unconfirmed(one.card).empty(); });
  if (!seeds.json) print("%td of %zu searches confirmed a material.\n", confirmed, all.size());
  return confirmed == std::ssize(all) ? kDone : kFailed;
}

}  // namespace pastefit
