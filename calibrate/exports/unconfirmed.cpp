#include "calibrate/exports/unconfirmed.h"

#include <string_view>

#include "calibrate/base/foreign_text.h"
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

}  // namespace

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
