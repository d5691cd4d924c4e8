#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/text.h"
#include "calibrate/card/card.h"
#include "calibrate/check/check.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/lammps_run.h"
#include "calibrate/cli/options.h"
#include "calibrate/cli/process.h"
#include "calibrate/cli/progress.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/evaluate/cost.h"
#include "calibrate/report/summary.h"

namespace pastefit {

namespace {

namespace fs = std::filesystem;

struct RescaleOptions {
  std::string card, out;
  double radius_mm = 0;
  int packings = 4;
  bool force = false;
  bool json = false;
  CheckOptions check;
};

int rescale(const RescaleOptions& options) {
  const Card card = value_or_throw(read_card(options.card));
  if (!options.out.empty()) refuse(output_faults("--out", options.out, options.force));
  const double radius = options.radius_mm / 1e3;
  Card result = value_or_throw(rescaled(card, radius));
  if (options.packings > 0) {
    double effort_s = 0;
    for (const auto& test : result.tests) {
      refuse(validate_memory(test.test, options.check.threads));
      effort_s += options.packings * least_effort_s(test.test);
    }
    refuse(long_run_faults("--radius", format("%d simulations of each test", options.packings), effort_s,
                           options.check.threads, options.force, "larger grains, or fewer --packings"));
    const int simulations = options.packings * static_cast<int>(card.tests.size());
    // The number of grains scales with 1/R^3, that of steps with 1/R.
    note("measuring the bias: %d simulations of each size; the new size takes %.3g times the work\n", simulations,
         std::pow(card.material.grains.radius_m / radius, 4));
    WorkLine line("simulations", 2 * simulations);
    result = value_or_throw(with_measured_bias(card, std::move(result), options.packings, options.check,
                                               counted(CheckEngine::ours(), line)),
                            kFailed);
  }
  deliver_card(result, text_of(result), options.json, options.out);
  return kDone;
}

constexpr std::uint64_t kFirstConfirmPacking = 80'001;  // not used by searches or `rescale`

struct ConfirmOptions {
  std::string card, engine = "lammps", launch, program, runs, test, out;
  std::optional<double> radius_mm;
  int packings = 4;
  bool force = false;
  bool json = false;
};

/// Folder of decks, logs and heaps: the given one, or a new one readable only by this user.
fs::path folder_of_runs(const std::string& given) {
  std::error_code error;
  if (!given.empty()) return fs::absolute(given, error);
  std::string name = (fs::temp_directory_path(error) / "pastefit-confirm-XXXXXX").string();
  if (!::mkdtemp(name.data()))
    refuse({{"the temporary folder", std::string("cannot be made: ") + std::strerror(errno),
             "set TMPDIR to a folder that can be written, or name one with --runs"}},
           kFailed);
  return name;
}

/// The test with the grains to be simulated.
struct Asked {
  Card card;      ///< with these grains
  CardTest test;  ///< of that card
};

Asked asked_for(const Card& card, const ConfirmOptions& options) {
  Asked asked{card, {}};
  const double radius = options.radius_mm.value_or(0) / 1e3;
  if (options.radius_mm && radius != card.material.grains.radius_m) asked.card = value_or_throw(rescaled(card, radius));
  asked.test = value_or_throw(test_to_export(asked.card, options.test));
  if (!has_deck(asked.test.test))
    refuse({{asked.test.name.empty() ? "the card's test" : "test " + asked.test.name,
             "has no deck: another program cannot run it", "choose another test with --test"}});
  refuse(validate_memory(asked.test.test, 1));
  return asked;
}

/// Faults of the options, independent of the card.
Faults unusable_options(const ConfirmOptions& options) {
  Faults faults;
  if (options.engine != "lammps")
    faults.push_back({"--engine", one_line(options.engine) + " cannot confirm a card", "lammps"});
  std::string first;
  if (std::istringstream(options.launch) >> first; !first.empty() && !is_program(first))
    faults.push_back({"--launch", "there is no program " + one_line(first),
                      "install an MPI (Debian's openmpi-bin), or leave --launch out for one rank"});
  append(faults, options.out.empty() ? output_file_faults("CARD", options.card, true)
                                     : output_faults("--out", options.out, options.force));
  if (!options.runs.empty()) append(faults, output_folder_faults("--runs", options.runs));
  return faults;
}

/// Runs the packings one after the other until the first failure. `done` gets the engine and the cost.
Result<std::vector<Baseline::Run>> run_all(const Asked& asked, const LammpsLaunch& launch, const fs::path& folder,
                                           const ConfirmOptions& options, const std::atomic<bool>& stop,
                                           FurtherConfirmation& done) {
  std::vector<Baseline::Run> runs;
  done.engine = options.engine;
  for (int i = 0; i < options.packings; ++i) {
    const std::uint64_t packing = kFirstConfirmPacking + static_cast<std::uint64_t>(i);
    const Fault interrupted{"packing " + std::to_string(packing), "interrupted",
                            "the same command with --runs continues"};
    const auto scene = export_scene(asked.card, asked.test, packing, shown_run(&stop));
    if (stop) return interrupted;
    if (!scene.ok()) return scene.faults();
    note("packing %d of %d: %zu grains\n", i + 1, options.packings, scene.value().packing.centres.size());
    auto heap = run_in_lammps(scene.value(), launch, folder / ("packing-" + std::to_string(packing)), stop);
    if (stop) return interrupted;
    if (!heap.ok()) return in_file(heap.faults(), interrupted.where);
    const auto& [readings, log] = heap.value();
    note("  %.3g s, %.3g core s, ranks: %d\n", log.wall_s, log.core_s, log.ranks);
    done.program = log.program;
    done.ranks = std::max(done.ranks, log.ranks);
    done.wall_s += log.wall_s;
    done.core_s += log.core_s;
    runs.push_back({packing, readings});
  }
  return runs;
}

/// Reads the card again, since another confirmation may have been added. Refused if the material has changed.
Card card_now(const ConfirmOptions& options, const Card& confirmed) {
  Card now = value_or_throw(read_card(options.card), kFailed);
  const auto without_confirmations = [](Card card) {
    card.further_confirmations.clear();
    return to_json(card);
  };
  if (without_confirmations(now) != without_confirmations(confirmed))
    refuse({{options.card, "changed while it was simulated", "confirm that card"}}, kFailed);
  return now;
}

/// Adds the confirmation to the card and writes it, or prints it.
void deliver(const ConfirmOptions& options, const Card& confirmed, const FurtherConfirmation& further) {
  const std::shared_ptr<void> lock = locked(options.card);
  Card card = card_now(options, confirmed);
  card.further_confirmations.push_back(further);
  deliver_card(card, further_confirmation_text(further), options.json,
               options.out.empty() ? options.card : options.out);
}

int confirm(const ConfirmOptions& options) {
  Faults faults = unusable_options(options);
  const auto read = value_or_append(read_card(options.card), faults);
  refuse(faults);
  const Card& card = read.value();
  const Asked asked = asked_for(card, options);
  const std::atomic<bool>& stop = listen_for_stop();
  const auto program = value_or_throw(lammps_program(options.program, stop));

  const fs::path folder = folder_of_runs(options.runs);
  const double least_s = least_effort_s(asked.test.test);
  if (least_s > 10)
    note("%d packings, each of %s of a core or more\n", options.packings, range_of_time(least_s, least_s).c_str());
  FurtherConfirmation done;
  const auto runs = value_or_throw(run_all(asked, {options.launch, program}, folder, options, stop, done), kFailed);
  const CardTest of_card = value_or_throw(test_to_export(card, options.test));
  try {
    deliver(options, card, further_confirmation(card, of_card, asked.test.test, runs, done));
  } catch (const Refusal&) {
    std::fprintf(stderr, "pastefit: the runs are kept in %s; --runs continues from there\n", folder.c_str());
    throw;
  }
  std::error_code error;
  if (options.runs.empty()) fs::remove_all(folder, error);
  return kDone;
}

}  // namespace

Command add_rescale(CLI::App& verb) {
  const auto options = std::make_shared<RescaleOptions>();
  verb.add_option("CARD", options->card, "card file")->required();
  verb.add_option("--radius", options->radius_mm, "mean radius of the new grains in mm")
      ->required()
      ->check(number_from(0.01, 1000))
      ->type_name("MM");
  verb.add_option("--out", options->out, "file for the new card; -: standard output")->type_name("FILE");
  verb.add_flag("--force", options->force, "replace FILE; start even if it takes more than a day");
  verb.add_flag("--json", options->json, "print the new card itself");
  verb.add_option("--packings", options->packings,
                  "simulations of each size that measure the bias; 0: convert without measuring")
      ->check(whole_number(0, 0) | whole_number(2, 1000))
      ->capture_default_str();
  add_threads(verb, options->check.threads);
  return [options] { return rescale(*options); };
}

Command add_confirm(CLI::App& verb) {
  const auto options = std::make_shared<ConfirmOptions>();
  verb.add_option("CARD", options->card, "card file")->required();
  verb.add_option("--engine", options->engine, "the other program: lammps")->type_name("NAME")->capture_default_str();
  verb.add_option("--radius", options->radius_mm, "mean radius of the grains in mm; default: the card's")
      ->check(number_from(0.01, 1000))
      ->type_name("MM");
  verb.add_option("--launch", options->launch,
                  "command that starts LAMMPS on several ranks, e.g. \"mpirun -n 16\"; default: one rank")
      ->type_name("COMMAND");
  verb.add_option("--packings", options->packings, "simulations in fresh packings")
      ->check(whole_number(2, 1000))
      ->capture_default_str();
  verb.add_option("--program", options->program, "LAMMPS with the card's laws; default: one is built once and kept")
      ->type_name("FILE");
  verb.add_option(
          "--runs", options->runs,
          "folder for decks, logs and heaps, from which an interrupted command continues; default: a temporary one")
      ->type_name("DIR");
  verb.add_option("--test", options->test, "test of the card to simulate; default: as for export")->type_name("NAME");
  verb.add_option("--out", options->out, "file for the card; default: CARD is replaced; -: standard output")
      ->type_name("FILE");
  verb.add_flag("--force", options->force, "replace FILE");
  verb.add_flag("--json", options->json, "print the card itself");
  return [options] { return confirm(*options); };
}

}  // namespace pastefit
