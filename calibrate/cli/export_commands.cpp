#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/statistics.h"
#include "calibrate/base/text.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/options.h"
#include "calibrate/cli/progress.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/exports/export.h"
#include "calibrate/exports/heap_dump.h"
#include "calibrate/exports/key_figures.h"
#include "calibrate/report/findings.h"
#include "calibrate/store/output_folder.h"

namespace pastefit {

namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  std::string card, out, target, test, application;
  std::optional<std::uint64_t> packing;
  bool force = false, unconfirmed = false, materials = false;
};

Result<std::vector<ExportFile>> files_of(const Card& card, const Exporter& exporter, const ExportOptions& options) {
  auto written =
      export_card(card, exporter,
                  {options.card, options.test, options.packing, options.unconfirmed, shown_run(), options.application});
  if (!written.ok()) return written.faults();
  return std::move(written).value().files;
}

/// Every material that fits, each with its card in a folder of its own. All but the first are not confirmed.
Result<std::vector<ExportFile>> files_of_materials(const Exporter& exporter, ExportOptions options) {
  const auto found = read_fitting_materials(fs::path(options.card).parent_path());
  if (!found.ok()) return found.faults();
  const auto& [own, materials] = found.value();
  std::vector<ExportFile> all;
  for (std::size_t k = 0; k < materials.size(); ++k) {
    const std::string folder = format("material-%zu", k + 1);
    Card card = k == 0 ? own : with_other_material(own, materials[k]);
    card.title += format(", material %zu of %zu that fit", k + 1, materials.size());
    options.card = (fs::path(options.out) / folder / kCardFile).string();
    options.unconfirmed = options.unconfirmed || k > 0;
    const auto text = readable_text(card);
    auto files = files_of(card, exporter, options);
    if (!text.ok()) return text.faults();
    if (!files.ok()) return files.faults();
    all.push_back({folder + "/" + kCardFile, text.value()});
    for (ExportFile& one : files.value()) all.push_back({folder + "/" + one.name, std::move(one.content)});
  }
  return all;
}

int export_to_folder(const ExportOptions& options) {
  Faults faults;
  const auto exporter = value_or_append(exporter_named(options.target), faults);
  const auto card = value_or_append(read_card(options.card), faults);
  append(faults, output_folder_faults("--out", options.out));
  std::error_code error;
  if (!options.application.empty() &&
      fs::equivalent(options.out, fs::path(options.application).parent_path() / ".", error))
    faults.push_back({"--out " + options.out,
                      "is the folder of the application, whose surfaces the export would replace", "another folder"});
  if (!exporter || !card) refuse(faults);
  const auto written = value_or_append(options.materials ? files_of_materials(exporter.value(), options)
                                                         : files_of(card.value(), exporter.value(), options),
                                       faults);
  refuse(faults);
  const std::vector<ExportFile>& files = written.value();

  std::vector<std::string> names;
  for (const auto& file : files) names.push_back(file.name);
  const auto folder = value_or_throw(
      OutputFolder::open(options.out, names, options.force ? EarlierResult::replace : EarlierResult::refuse, kSpace));
  for (const auto& file : files) {
    std::error_code ignored;  // the error shows up on writing
    fs::create_directories(folder.file(file.name).parent_path(), ignored);
    refuse(write_atomically(folder.file(file.name), file.content), kFailed);
  }
  for (const auto& file : files) print("wrote %s\n", folder.file(file.name).c_str());
  print(files.back().content);
  return kDone;
}

/// Probability that any reading of a heap of the same material is called different.
constexpr double kReadFalseAlarm = 0.05;

/// The scatter of fewer heaps is too uncertain.
constexpr int kFewestPackings = 3;

struct ReadOptions {
  std::vector<std::string> dumps;
  std::string card, filled, test;
  std::optional<std::uint64_t> packing;
  bool json = false;
};

/// Reading of a dump, beside that of the card.
struct HeapReading {
  std::string name;
  double read = 0;
  const CardReading* of_card = nullptr;  ///< null: not on the card
  std::optional<double> band;            ///< of |read - simulated| by replicate scatter; may be unknown

  bool is_compared() const { return band.has_value(); }
  bool differs() const { return band && !lie_within(*band, read, of_card->simulated.mean); }
};

/// The false alarms are shared among the readings that scatter.
std::vector<HeapReading> beside_card(const Readings& readings, const CardTest& test) {
  const auto scatters = [](const CardReading& one) {
    return one.simulated.count >= kFewestPackings && one.simulated.standard_deviation > 0;
  };
  const auto number = std::max<std::ptrdiff_t>(1, std::ranges::count_if(test.readings, scatters));
  const double false_alarm = kReadFalseAlarm / static_cast<double>(number);
  std::vector<HeapReading> out;
  for (const Reading& reading : readings.all()) {
    HeapReading one{reading.name, reading.value, nullptr, std::nullopt};
    const auto of_card = std::ranges::find(test.readings, reading.name, &CardReading::name);
    if (of_card != test.readings.end()) {
      one.of_card = &*of_card;
      if (of_card->simulated.count >= kFewestPackings)
        one.band = band_of(of_card->simulated, {1, reading.value, 0}, false_alarm);
    }
    out.push_back(std::move(one));
  }
  return out;
}

std::string reading_table(const std::vector<HeapReading>& readings, const std::string& packings) {
  std::string out = format("%-27s %10s %17s %17s %10s %8s\n", "Reading", "dump", "card +- scatter", "laboratory +- sd",
                           "difference", "noise");
  for (const HeapReading& one : readings) {
    const CardReading* const card = one.of_card;
    out += format("%-27s %10.5g", one.name, one.read);
    if (!card) {
      out += format(" %17s\n", "not on the card");
      continue;
    }
    const std::string scatter = card->simulated.count > 1 ? format(" +- %.2g", card->simulated.standard_deviation) : "";
    out += format(" %17s", format("%.5g", card->simulated.mean) + scatter);
    out += format(" %17s",
                  card->measured ? format("%.5g +- %.2g", *card->measured, card->standard_deviation) : "not measured");
    const std::string noise = !one.band ? "unknown" : *one.band > 0 ? format("%.3g", *one.band) : "none";
    out += format(" %+10.3g %8s", one.read - card->simulated.mean, noise) + (one.differs() ? "  differs\n" : "\n");
  }
  if (!packings.empty()) out += "Card: " + packings + ".\n";
  if (std::ranges::any_of(readings, &HeapReading::is_compared))
    out += "Noise: of 95 in 100 packings of the card's material all readings differ by less.\n";
  return out;
}

/// "agrees" is null without anything to compare with.
nlohmann::ordered_json json_of(const std::vector<HeapReading>& readings, std::size_t packings,
                               std::optional<bool> agrees) {
  nlohmann::ordered_json out{
      {"packings", packings}, {"agrees", nullptr}, {"readings", nlohmann::ordered_json::object()}};
  if (agrees) out["agrees"] = *agrees;
  for (const HeapReading& one : readings) {
    nlohmann::ordered_json& row = out["readings"][one.name];
    row["read"] = one.read;
    if (!one.of_card) continue;
    row["simulated"] = one.of_card->simulated.mean;
    row["simulated_standard_deviation"] = one.of_card->simulated.standard_deviation;
    if (one.of_card->measured) {
      row["measured"] = *one.of_card->measured;
      row["standard_deviation"] = one.of_card->standard_deviation;
    }
    row["difference"] = one.read - one.of_card->simulated.mean;
    if (!one.band) continue;
    row["noise"] = *one.band;
    row["agrees"] = !one.differs();
  }
  return out;
}

int read_heap_of(const ReadOptions& options) {
  Faults faults;
  const auto card = value_or_append(read_card(options.card), faults);
  std::vector<Particles> heaps;
  for (const std::string& file : options.dumps)
    if (auto heap = value_or_append(read_dump(file), faults)) heaps.push_back(std::move(*heap));
  const auto beside = fs::path(options.dumps[0]).parent_path() / "filled.dump";
  auto filled = read_dump(options.filled.empty() ? beside.string() : options.filled);
  if (!filled.ok() && options.filled.empty())
    for (Fault fault : filled.faults())
      faults.push_back(
          {std::move(fault.where), std::move(fault.what), "the deck writes it beside the heap; give it with --filled"});
  else if (!filled.ok())
    append(faults, filled.faults());
  refuse(faults);

  const CardTest test = value_or_throw(test_to_export(card.value(), options.test));
  const Readings read = value_or_throw(read_heaps(test.test, options.packing, filled.value(), heaps, shown_run()));

  const std::size_t packings = card.value().confirmation.packings.size();
  const auto readings = beside_card(read, test);
  const bool rejected = is_rejected(test.test, read);
  const bool differs = rejected || std::ranges::any_of(readings, &HeapReading::differs);
  const bool compared = differs || std::ranges::any_of(readings, &HeapReading::is_compared);
  if (options.json) {
    print(json_text(json_of(readings, packings, compared ? std::optional(!differs) : std::nullopt)));
  } else {
    print(reading_table(readings, packings_in_words(card.value(), test)));
    if (rejected) print("%s.\n", remarks_on(test.test, {&read, 1}).c_str());
    print(rejected
              ? "The heap sheared off, so it is not compared: the card's readings are means of heaps that did not.\n"
          : differs   ? "The heap differs from the card's by more than the noise.\n"
          : !compared ? "Not compared: the card has no readings of three packings or more.\n"
                      : "The heap agrees with the card.\n");
  }
  return compared && !differs ? kDone : kFailed;
}

struct KpiOptions {
  std::string folder;
  bool json = false;
};

std::string figure_table(const KeyFigures& found) {
  std::string out = format("%-30s %9s %20s  %s\n", "Key figure", "mean", "90 % of materials", "each");
  for (const KeyFigure& one : found.figures) {
    const auto band = one.band();
    const std::string range = band ? plain(band->first) + " to " + plain(band->second) : "";
    out += format("%-30s %9s %20s  ", one.name, plain(one.mean()), range) +
           listed(
               one.of_runs, [](double value) { return plain(value); }, " ") +
           "\n";
  }
  return out + format("%zu runs: ", found.runs.size()) + one_line(listed(found.runs)) + "\n";
}

nlohmann::ordered_json figures_json(const KeyFigures& found) {
  nlohmann::ordered_json out{{"runs", found.runs}, {"figures", nlohmann::ordered_json::object()}};
  for (const KeyFigure& one : found.figures) {
    nlohmann::ordered_json& row = out["figures"][one.name];
    row = {{"mean", one.mean()}, {"of_runs", one.of_runs}};
    if (const auto band = one.band()) row["band_90_percent"] = {band->first, band->second};
  }
  return out;
}

}  // namespace

Command add_export(CLI::App& verb) {
  const auto options = std::make_shared<ExportOptions>();
  verb.add_option("CARD", options->card, "card file")->required();
  const std::string targets = "target: " + listed(exporters(), &Exporter::name);
  verb.add_option("--to", options->target, targets)->required()->type_name("TARGET");
  verb.add_option("--out", options->out, "folder for the files")->required()->type_name("DIR");
  verb.add_option("--test", options->test,
                  "test of the card to write; default: the first that has a deck, or else the first")
      ->type_name("NAME");
  verb.add_option("--packing", options->packing, "seed of the random packing; default: that of the test")
      ->check(whole_number());
  verb.add_option("--application", options->application,
                  "machine in which to simulate the material, in place of the test: chute, hopper, mixer, or a file of "
                  "your own")
      ->type_name("FILE")
      ->check(CLI::Validator(
          [](const std::string& text) { return text.empty() ? "is empty: give a name or a file" : ""; }, ""));
  verb.add_flag("--unconfirmed", options->unconfirmed, "export an unconfirmed card, marked in every file");
  verb.add_flag("--materials", options->materials,
                "every material that fits the readings, each in a folder of its own; CARD in the folder of its "
                "calibration");
  verb.add_flag("--force", options->force, "replace an earlier export in DIR");
  return [options] { return export_to_folder(*options); };
}

Command add_kpi(CLI::App& verb) {
  const auto options = std::make_shared<KpiOptions>();
  verb.add_option("DIR", options->folder, "folder of an application that has been run, or of several materials in it")
      ->required();
  verb.add_flag("--json", options->json, "print the figures as JSON");
  return [options] {
    const KeyFigures found = value_or_throw(read_key_figures(options->folder));
    print(options->json ? json_text(figures_json(found)) : figure_table(found));
    return kDone;
  };
}

Command add_read(CLI::App& verb) {
  const auto options = std::make_shared<ReadOptions>();
  verb.add_option("DUMP", options->dumps, "the heap after step 1 (and after step 2), a text dump of the exported deck")
      ->required()
      ->expected(1, 2);
  verb.add_option("--card", options->card, "card from which the deck was exported")->required()->type_name("CARD");
  verb.add_option("--filled", options->filled, "dump of the filled vessel; default: filled.dump beside the heap")
      ->type_name("FILE");
  verb.add_option("--test", options->test, "exported test of the card; default: as for export")->type_name("NAME");
  verb.add_option("--packing", options->packing, "seed of the exported packing; default: that of the test")
      ->check(whole_number());
  verb.add_flag("--json", options->json, "print the readings as JSON");
  return [options] { return read_heap_of(*options); };
}

}  // namespace pastefit
