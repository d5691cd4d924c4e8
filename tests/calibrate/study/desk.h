#pragma once

#include <nlohmann/json.hpp>

#include "calibrate/laboratory/test.h"
#include "calibrate/study/study.h"
#include "tests/calibrate/files.h"

namespace pastefit::test {

/// A folder with the templates' lab.json and a study of one's own.
class Desk {
 public:
  Desk() { folder_.write("lab.json", template_text("lab").value()); }

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
