#pragma once

#include <nlohmann/json.hpp>

#include "calibrate/laboratory/test.h"
#include "calibrate/study/study.h"
#include "tests/calibrate/files.h"

namespace pastefit::test {

/// A folder with the templates' lab.json and a study of one's own.
class Desk {
 public:
  /// The template's laboratory with equal grains, and the shift of the top measured, too.
  Desk() {
    auto lab = nlohmann::json::parse(template_text("lab").value(), nullptr, true, true);
    lab["grains"] = {{"distribution", "mono"}, {"radius_mm", 8}};
    lab["measurements"]["step1.lateral_shift_mm"] = {{"value", 0}, {"standard_deviation", 20}};
    folder_.write("lab.json", lab.dump(2));
  }

  static nlohmann::json study() {
    return nlohmann::json::parse(R"({"format": "pastefit-study-1", "title": "a study", "lab": "lab.json",
                           "parameters": {"strength_pa": {"free": [200, 60000]}, "friction": {"value": 0.4}}})");
  }
  Result<Study> read(const nlohmann::json& document) const {
    return read_study(folder_.write("study.json", document.dump()));
  }
  Faults faults(const nlohmann::json& document) const {
    const Result<Study> study = read(document);
    return study.ok() ? Faults{} : study.faults();
  }
  const Folder& folder() const { return folder_; }

 private:
  Folder folder_;
};

}  // namespace pastefit::test
