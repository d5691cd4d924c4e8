#include "calibrate/exports/export.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <span>
#include <vector>

#include "calibrate/base/text.h"
#include "calibrate/card/standing.h"
#include "calibrate/evaluate/cost.h"
#include "calibrate/study/tests.h"

namespace pastefit {

std::vector<ExportWall> ExportScene::walls() const {
  std::vector<ExportWall> out;
  if (application) {
    for (const MachinePart& part : application->parts) out.push_back({part.name, part.contact});
    return out;
  }
  return std::visit(
      [](const auto& one) -> std::vector<ExportWall> {
        if constexpr (requires { one.mould_wall; }) return {{"mould", one.mould_wall}, {"table", one.table_wall}};
        if constexpr (requires { one.tools; }) return {{"tools", one.tools}};
        return {};
      },
      test);
}

namespace {

/// Puts the machine of a file in place of the test. Its surfaces are like the table unless the file says otherwise.
/// Errors: no slump test; every fault of the file; it does not suit the grains.
Faults put_into_application(ExportScene& scene, const std::string& file) {
  if (!scene.slump())
    return {{"--application",
             "needs a slump test of the card, whose packing has the sizes and the density of the grains",
             "--test NAME, or a card with a slump test"}};
  auto read = read_application(file, scene.slump()->table_wall);
  if (!read.ok()) return read.faults();
  const double largest = std::max(std::ranges::max(scene.sizes.radii_m), scene.grains().largest_m);
  if (Faults faults = unsuitable_grains(read.value(), largest, scene.grain_density_kg_m3); !faults.empty())
    return in_file(std::move(faults), file);
  scene.application = std::move(read).value();
  return {};
}

}  // namespace

std::string grain_density_in_words(const ExportScene& scene) {
  std::string own = format("%.9g kg/m^3", scene.grain_density_kg_m3);
  if (!scene.card_density_kg_m3 || *scene.card_density_kg_m3 == scene.grain_density_kg_m3) return own;
  return own + format(" in this packing (%.9g on the card, the mean of its packings)", *scene.card_density_kg_m3);
}

std::span<const Exporter> exporters() {
  static constexpr std::array kExporters{
      Exporter{"lammps", "deck for LAMMPS, and the engine's laws as a style for it: slump test, or two grains",
               export_lammps},
      Exporter{"liggghts", "deck for LIGGGHTS, with its nearest law: slump test (step 1), or two grains",
               export_liggghts, true},
      Exporter{"yade", "Python module and scripts for Yade: slump test (step 1), or two grains", export_yade},
      Exporter{"mercurydpm", "parameters, force table and instructions for MercuryDPM", export_mercurydpm},
      Exporter{"csv", "parameters, force table and grains as CSV files", export_csv},
      Exporter{"edem-notes", "parameters, force table and instructions for EDEM", export_edem_notes}};
  return kExporters;
}

Result<Exporter> exporter_named(const std::string& name) {
  const auto known = exporters();
  if (const auto found = std::ranges::find(known, name, &Exporter::name); found != known.end()) return *found;
  const Names names = names_of(known, &Exporter::name);
  const std::string small = small_letters(name);
  auto near = nearest(small, names);
  for (const std::string& one : names)
    if (!small.empty() && one.starts_with(small) && (!near || *near != small)) near = one;
  return Fault{"--to " + printable(name), "is not an export target",
               near ? "did you mean '" + *near + "'?" : "one of " + listed(known, &Exporter::name)};
}

Result<CardTest> test_to_export(const Card& card, const std::string& name) {
  if (!name.empty()) {
    const auto place = place_of_test(card.tests, name);
    if (!place.ok()) return place.faults();
    return card.tests[place.value()];
  }
  const auto found = std::ranges::find_if(card.tests, has_deck, &CardTest::test);
  return found != card.tests.end() ? *found : card.tests.front();
}

bool has_deck(const Test& test) {
  return std::holds_alternative<SlumpTest>(test);
}

Result<ExportScene> export_scene(const Card& card, const CardTest& test, std::optional<std::uint64_t> packing,
                                 const RunOptions& fill) {
  if (Faults faults = validate_memory(test.test, 1); !faults.empty()) return faults;
  ExportScene scene;
  scene.title = title_of(card) + (test.name.empty() ? "" : ", test " + test.name);
  scene.test = test.test;
  scene.card_density_kg_m3 = card.material.grain_density_kg_m3;
  scene.grain_density_kg_m3 = card.material.grain_density_kg_m3.value_or(specimen_of(test.test).bulk_density_kg_m3);
  scene.sizes.radii_m = {scene.radius_m()};
  auto* const slump = std::get_if<SlumpTest>(&scene.test);
  if (!slump) return scene;
  slump->packing_seed = packing.value_or(slump->packing_seed);
  const auto filled = fill_mould(*slump, fill);
  scene.packing = filled->failure ? *filled : full_mould(*slump, *filled, fill);
  if (const auto& failure = scene.packing.failure)
    return Fault{"packing " + std::to_string(slump->packing_seed), "the mould could not be filled: " + failure->message,
                 "take another seed with --packing, or finer grains with pastefit rescale"};
  scene.grain_density_kg_m3 = grain_density(*slump, scene.packing);
  scene.sizes = size_classes(scene.packing.radii);
  return scene;
}

SizeClasses size_classes(std::span<const double> radii, int most) {
  SizeClasses out;
  if (radii.empty()) return out;
  const auto [smallest, largest] = std::ranges::minmax(radii);
  const double width = (largest - smallest) / most;
  std::vector<double> cubes(static_cast<std::size_t>(most));
  std::vector<int> counts(cubes.size()), places(cubes.size());
  for (const double radius : radii) {
    const int bin = width > 0 ? std::min(static_cast<int>((radius - smallest) / width), most - 1) : 0;
    out.class_of.push_back(bin);
    cubes[bin] += radius * radius * radius;
    ++counts[bin];
  }
  for (std::size_t bin = 0; bin < cubes.size(); ++bin) {
    places[bin] = static_cast<int>(out.radii_m.size());
    if (counts[bin] > 0) out.radii_m.push_back(width > 0 ? std::cbrt(cubes[bin] / counts[bin]) : smallest);
  }
  for (int& place : out.class_of) place = places[place];
  return out;
}

namespace {

const std::string kStyleFolder = "style/";  // LAMMPS sources, identical for every card

/// Inserts a comment line, into the first line where the target's format requires it.
std::string marked(const ExportFile& file, const std::string& line) {
  if (file.name.ends_with(".txt")) return line + "\n\n" + file.content;
  const std::string comment = deck_comment(line);
  if (file.name.ends_with(".stl"))  // "solid NAME" is what its reader expects
    return std::string(file.content).insert(file.content.find('\n'), "; " + comment.substr(2, comment.size() - 3));
  if (file.name.ends_with(".data")) return comment.substr(0, comment.size() - 1) + "; " + file.content;
  return comment + file.content;
}

/// Names the exported test if the card has several.
std::string choice_text(const Card& card, const CardTest& chosen) {
  std::string others;
  for (const auto& test : card.tests)
    if (test.name != chosen.name) others += (others.empty() ? "" : ", ") + test.name;
  if (others.empty()) return {};
  return "This is the card's test " + chosen.name + ". The card has others: " + others +
         " (pastefit export --test NAME).\n\n";
}

/// Expected heap, and the command that compares the other program's heap with it.
std::string comparison_text(const ExportRequest& request, const Card& card, const CardTest& test,
                            const std::string& heap, bool other_law) {
  std::string out;
  if (const auto packings = packings_in_words(card, test); !packings.empty() && !test.readings.empty()) {
    const std::string heap_of = other_law ? "The card's heap, which this law does not reproduce" : "The heap to expect";
    out += "\n" + heap_of + " (" + packings + "):\n";
    for (const CardReading& reading : test.readings)
      out += format("    %-28s %10.5g", reading.name, reading.simulated.mean) +
             (reading.simulated.count == 1 ? "\n" : format(" +- %.2g\n", reading.simulated.standard_deviation));
  }
  out += "\nTo compare the heap of the deck with the card's, in this folder:\n    pastefit read " + heap + " --card " +
         shell_word_if_needed(std::filesystem::absolute(request.card_file).string());
  if (!request.test.empty()) out += " --test " + shell_word_if_needed(request.test);
  if (request.packing) out += " --packing " + std::to_string(*request.packing);
  return out + "\n";
}

/// Effect of a substitute law on the heap, and how to avoid it.
std::string bias_text(const Export& written) {
  if (written.own_law.empty()) return {};
  std::string out = "\nThe law differs from the card's, so expect another result.\n";
  if (!written.heap.empty())
    out +=
        "To measure by how much: run the deck in three or more packings (pastefit export with --packing 1, 2, 3)\n"
        "and compare each heap by the command at the end; the mean difference is the bias of the law.\n";
  return out + "To avoid the bias: calibrate with a law that this program has, in the study\n    " + written.own_law +
         "\n";
}

/// Content of `kExportNotes` below the title.
std::string export_notes(const Export& written, const Exporter& exporter, const Card& card, const CardTest& test,
                         const ExportRequest& request) {
  const std::string meaning = request.application.empty() ? std::string(exporter.meaning)
                                                          : "deck of a machine for " + std::string(exporter.name);
  std::string out = meaning + "\n\n" + lines_of(choice_text(card, test));
  out += written.notes.empty() ? "All of the card's contact laws are exported.\n" : "What is lost or changed:\n";
  for (const auto& note : written.notes) out += "- " + note + "\n";
  if (!written.instructions.empty()) out += "\nTo run it:\n" + written.instructions;
  out += lines_of(bias_text(written));
  if (!written.heap.empty())
    out += lines_of(comparison_text(request, card, test, written.heap, !written.own_law.empty()));
  return out;
}

}  // namespace

Result<Export> export_card(const Card& card, const Exporter& exporter, const ExportRequest& request) {
  Faults faults;
  if (const std::string cause = cause_unconfirmed(card); !cause.empty() && !request.unconfirmed)
    faults.push_back(
        {"--unconfirmed", "the card is not confirmed: " + cause,
         "calibrate until it is confirmed, or give --unconfirmed: every file then begins with this warning"});
  const auto test = test_to_export(card, request.test);
  auto scene = test.ok() ? export_scene(card, test.value(), request.packing, request.fill) : test.faults();
  if (!request.application.empty() && scene.ok())
    if (Faults unsuited = put_into_application(scene.value(), request.application); !unsuited.empty()) scene = unsuited;
  if (!request.application.empty() && !exporter.takes_applications)
    faults.push_back({"--application", "has no deck for " + std::string(exporter.name), "--to liggghts"});
  auto answer = value_or_append(scene.ok() ? exporter.write(scene.value()) : scene.faults(), faults);
  if (!faults.empty()) return faults;
  Export written = std::move(answer).value();
  if (const SlumpTest* slump = scene.value().slump();
      slump && slump->tilt && !scene.value().application && exporter.name != "lammps")
    written.notes.push_back("The tilt of the table (tilt.slide_angle_deg) is not part of the deck.");
  written.files.push_back({kExportNotes, one_line(scene.value().title) + "\n" +
                                             export_notes(written, exporter, card, test.value(), request)});
  if (const std::string line = one_line(unconfirmed_line(card)); !line.empty())
    for (ExportFile& file : written.files)
      if (!file.name.starts_with(kStyleFolder)) file.content = marked(file, line);
  return written;
}

}  // namespace pastefit
