#include "calibrate/exports/export_notes.h"

#include <filesystem>
#include <string_view>

#include "calibrate/base/text.h"
#include "calibrate/card/standing.h"

namespace pastefit {

namespace {

const std::string kStyleFolder = "style/";  // sources of LAMMPS: the same for every card

/// Where a target's reader would take the line for something else, it becomes part of the first line.
std::string marked(const ExportFile& file, const std::string& line) {
  if (file.name.ends_with(".txt")) return line + "\n\n" + file.content;
  const std::string comment = deck_comment(line);
  if (file.name.ends_with(".data")) return comment.substr(0, comment.size() - 1) + "; " + file.content;
  return comment + file.content;
}

/// Which of the card's tests was written, where there are several.
std::string choice_text(const Card& card, const CardTest& chosen) {
  std::string others;
  for (const auto& test : card.tests)
    if (test.name != chosen.name) others += (others.empty() ? "" : ", ") + test.name;
  if (others.empty()) return {};
  return "This is the card's test " + chosen.name + ". The card has others: " + others +
         " (pastefit export --test NAME).\n\n";
}

/// The heap to expect, and the command that compares that of the other program with it.
std::string comparison_text(const ExportRequest& request, const Card& card, const CardTest& test,
                            const std::string& heap, bool other_law) {
  std::string out;
  const auto packings = card.confirmation.packings.size();
  if (packings >= 1 && !test.readings.empty()) {
    const std::string heap_of = other_law ? "The card's heap, which this law does not leave" : "The heap to expect";
    out += packings == 1
               ? "\n" + heap_of + " (one packing, error unknown):\n"
               : "\n" + heap_of + format(" (mean +- standard deviation of the card's %zu packings):\n", packings);
    for (const CardReading& reading : test.readings)
      out += format("    %-28s %10.5g", reading.name.c_str(), reading.simulated) +
             (reading.packings == 1 ? "\n" : format(" +- %.2g\n", reading.simulated_standard_deviation));
  }
  out += "\nTo compare the heap of the deck with the card's, in this folder:\n    pastefit read " + heap + " --card " +
         shell_word_if_needed(std::filesystem::absolute(request.card_file).string());
  if (!request.test.empty()) out += " --test " + shell_word_if_needed(request.test);
  if (request.packing) out += " --packing " + std::to_string(*request.packing);
  return out + "\n";
}

/// What another law in place of the card's does to the heap, and how to do without it.
std::string bias_text(const Export& written) {
  if (written.own_law.empty()) return {};
  std::string out = "\nAnother law than the card's is written, so expect another heap.\n";
  if (!written.heap.empty())
    out +=
        "To measure by how much: run the deck in three or more packings (pastefit export with --packing 1, 2, 3)\n"
        "and compare each heap by the command at the end; the mean difference is the bias of the law.\n";
  return out + "To have none: calibrate with a law that this program has, in the study\n    " + written.own_law + "\n";
}

}  // namespace

std::string export_notes(const Export& written, const Exporter& exporter, const Card& card, const CardTest& test,
                         const ExportRequest& request) {
  std::string out = one_line(title_of(card, test)) + "\n" + std::string(exporter.meaning) + "\n\n" +
                    lines_of(choice_text(card, test));
  out += written.notes.empty() ? "Nothing of the card's contact laws is lost.\n" : "What is lost or changed:\n";
  for (const auto& note : written.notes) out += "- " + note + "\n";
  if (!written.instructions.empty()) out += "\nTo run it:\n" + written.instructions;
  out += lines_of(bias_text(written));
  if (!written.heap.empty())
    out += lines_of(comparison_text(request, card, test, written.heap, !written.own_law.empty()));
  return out;
}

Faults unconfirmed_faults(const Card& card, bool accepted) {
  const std::string cause = cause_unconfirmed(card);
  if (cause.empty() || accepted) return {};
  return {{"--unconfirmed", "the card is not confirmed: " + cause,
           "calibrate until it is confirmed, or give --unconfirmed: every file then begins with this"}};
}

void mark_unconfirmed(const Card& card, Export& written) {
  const std::string line = one_line(unconfirmed_line(card));
  if (line.empty()) return;
  for (ExportFile& file : written.files) {
    const bool mesh = file.name.ends_with(".stl");
    if (!mesh && !file.name.starts_with(kStyleFolder)) file.content = marked(file, line);
  }
}

}  // namespace pastefit
