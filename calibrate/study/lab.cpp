#include "calibrate/study/lab.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "calibrate/base/content_hash.h"
#include "calibrate/base/json_reader.h"
#include "calibrate/study/measurements.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/rig.h"

namespace pastefit {

Result<Lab> lab_from_json(const nlohmann::json& document, const std::filesystem::path& folder) {
  Faults faults;
  if (!has_format(document, "pastefit-lab-1", faults)) return faults;
  Lab lab;
  std::optional<Rig> preset;
  {
    ObjectReader reader(document, "", faults);
    reader.known("format");
    reader.text("title", lab.title, Need::required);
    read_provenance(reader, lab.provenance);
    const std::size_t before = faults.size();
    read_kind(reader, lab.test);
    preset = read_apparatus(reader, lab.test, folder);
    read_material(reader, lab.test);
    read_grains(reader, lab.test, preset ? Need::optional : Need::required);
    lab.test = with_usual_contact(lab.test);
    // A test with a faulty section would only be judged by values nobody gave.
    if (values_are_good(faults, before))
      for (Fault& fault : validate_in_file_words(lab.test)) faults.push_back(std::move(fault));
    lab.measurements = read_measurements(reader, lab.test);
    if (values_are_good(faults, before))
      for (Fault& fault : doubts_about(lab.test, lab.measurements).faults) faults.push_back(std::move(fault));
  }
  if (!faults.empty()) return faults;
  if (preset) lab.note = note_on_preset(*preset);
  const std::string rig = preset ? preset->content : "";
  lab.content = nlohmann::json{{"laboratory", document}, {"preset", rig}}.dump();
  lab.hash = content_hash(document.dump() + rig);
  return lab;
}

Result<Lab> read_lab(const std::filesystem::path& file) {
  Faults faults;
  const std::optional<nlohmann::json> document = read_json(file, faults);
  if (!document) return faults;
  Result<Lab> lab = lab_from_json(*document, file.parent_path());
  if (lab.ok() && faults.empty()) return lab;
  if (!lab.ok())
    for (Fault& fault : in_file(lab.faults(), file)) faults.push_back(std::move(fault));
  return faults;
}

}  // namespace pastefit
