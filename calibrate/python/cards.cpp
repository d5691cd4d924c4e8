#include <pybind11/stl.h>

#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/base/statistics.h"
#include "calibrate/card/card.h"
#include "calibrate/check/check.h"
#include "calibrate/exports/export.h"
#include "calibrate/python/module.h"
#include "calibrate/report/summary.h"
#include "calibrate/verify/verify.h"

namespace pastefit::python {

namespace py = pybind11;
using nlohmann::ordered_json;

namespace {

Card card_in(const std::string& text) {
  return value_or_throw(card_from_json(nlohmann::json::parse(text)));
}

/// {"files": {name: content}, "notes": [...], "instructions"}; the notes are also one of the files.
std::string export_json(const std::string& card_text, const std::string& target, const ExportRequest& request) {
  Faults faults;
  const auto exporter = value_or_append(exporter_named(target), faults);
  const auto card = value_or_append(card_from_json(nlohmann::json::parse(card_text)), faults);
  refuse(std::move(faults));
  const Export written = value_or_throw(export_card(card.value(), exporter.value(), request));
  ordered_json out{{"files", ordered_json::object()}, {"notes", written.notes}, {"instructions", written.instructions}};
  for (const ExportFile& file : written.files) out["files"][file.name] = file.content;
  return out.dump();
}

/// Engine whose runs poll the stop flag.
CheckEngine stoppable(std::shared_ptr<Stop> stop) {
  CheckEngine engine = CheckEngine::ours();
  engine.run = [stop = std::move(stop)](const Test& test, const RunOptions& options) {
    RunOptions watched = options;
    watched.pulse = [stop](const Snapshot&) { return !stop->asked; };
    return simulate(test, watched);
  };
  return engine;
}

std::string check_json(const std::string& card_text, const CheckOptions& options, const std::string& against,
                       std::shared_ptr<Stop> stop) {
  const Card card = card_in(card_text);
  const CheckEngine engine = stoppable(std::move(stop));
  const CardCheck answer = against.empty() ? check(card, options, engine)
                                           : check_against(card, value_or_throw(read_lab(against)), options, engine);
  return to_json(std::vector<CheckedFile>{{"", answer}}).at("cards").at(0).dump();
}

/// The card with other values of these material parameters (`with_other_material`).
std::string card_with_parameters(const std::string& card_text, const std::map<std::string, double>& parameters) {
  Card card = card_in(card_text);
  std::vector<double> values = values_of(card.material);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (const auto other = parameters.find(card.material.parameters[i].name); other != parameters.end())
      values[i] = other->second;
  return to_json(with_other_material(std::move(card), values)).dump();
}

}  // namespace

void add_cards(py::module_& module) {
  const py::call_guard<py::gil_scoped_release> unlocked;
  module.def("read_card", [](const std::string& file) { return to_json(value_or_throw(read_card(file))).dump(); });
  module.def("card_from_json", [](const std::string& text) { return to_json(card_in(text)).dump(); });
  module.def("card_summary", [](const std::string& text) { return summary_of(card_in(text)); });
  module.def("card_verdict", [](const std::string& text) { return verdict_of(card_in(text)); });
  module.def("card_with_parameters", card_with_parameters);
  module.def("widening", widening);
  module.def(
      "export",
      [](const std::string& card, const std::string& target, const std::string& card_file, const std::string& test,
         std::optional<std::uint64_t> packing, bool unconfirmed) {
        return export_json(card, target, {card_file, test, packing, unconfirmed});
      },
      unlocked);
  module.def("export_targets", [] {
    std::vector<std::pair<std::string, std::string>> targets;
    for (const Exporter& one : exporters()) targets.emplace_back(one.name, one.meaning);
    return targets;
  });
  module.def(
      "check",
      [](const std::string& card, bool quick, double false_alarm, bool bits, int threads, const std::string& against,
         std::shared_ptr<Stop> stop) {
        return check_json(card, {quick, false_alarm, bits, threads}, against, std::move(stop));
      },
      unlocked);
  module.def(
      "verify",
      [](const std::vector<std::string>& names) { return to_json(value_or_throw(verify_cases(names))).dump(); },
      unlocked);
}

}  // namespace pastefit::python
