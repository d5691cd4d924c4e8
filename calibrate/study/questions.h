#pragma once

#include <string>
#include <vector>

#include "calibrate/base/json_reader.h"

namespace pastefit {

/// What of a laboratory file can be read, but looks like a slip: a number in another unit, a misread repeat. It is a
/// fault until its place stands in the file's "confirmed", and a note from then on.
class Questions {
 public:
  /// Reads "confirmed" of the file.
  explicit Questions(ObjectReader& document);

  /// `what` is said of the place; `remedy`: what to do if it is a slip.
  void ask(const std::string& place, std::string what, std::string remedy);
  /// What a person should know, but need not confirm.
  void note(const std::string& place, std::string what) { notes_.push_back(place + " " + std::move(what)); }

  /// A sentence each, without a full stop.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  Faults& faults_;
  std::vector<std::string> confirmed_, notes_;
};

}  // namespace pastefit
