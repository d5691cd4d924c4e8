#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calibrate/study/study.h"
#include "calibrate/study/target_laws.h"
#include "core/result.h"

namespace pastefit {

/// What the sheet of a slump test says, as its user types it.
struct Sheet {
  using Named = std::vector<std::pair<std::string, std::string>>;  ///< "slump" and "180, 175, 190 mm"

  std::string title = "my paste";
  std::string source;   ///< who measured it where, or where that stands; empty: to be filled in
  std::string mould;    ///< a preset, or "BASE/TOP/HEIGHT" with a unit if it is not mm
  std::string density;  ///< of the fresh material: "2350", "145 lb/ft3"
  int drops = 0;        ///< of the preset's plate or table; 0: as the preset says
  Named readings;       ///< by short name or key
  Named deviations;     ///< of readings, in their unit; without one as published for the mould
  std::string grains;   ///< their radius: "8", or the smallest and the largest, "6, 10 mm"; empty: by the mould
  std::vector<std::pair<std::string, double>> mix;  ///< "water_kg_m3" and 180
  std::string yield_stress;            ///< of a vane or another rheometer: "520, 490 Pa"; empty: not measured
  std::string target = "lammps";       ///< the program that the material is for
  std::string law;                     ///< word of the starting laws; empty: those that the program starts from
  Named fixed, priors;                 ///< of parameters: "friction" and "0.2", or "0.2 +- 0.05"
  std::vector<std::string> confirmed;  ///< places that look like a slip and are right
};

/// A laboratory file and a study for it, as text.
struct StartingFiles {
  std::string lab, study;
};

/// A short name of a reading for people, and its key.
struct ShortReading {
  std::string_view name, key, meaning;
};
std::span<const ShortReading> short_readings();

/// The apparatus that the sheet names, with its default grains. `folder` is where the laboratory file will lie.
Result<Test> apparatus_of(const std::string& mould, const std::filesystem::path& folder);

/// Both files. A yield stress is written to be compared; where it is all that was measured, so is the reading that it
/// predicts (`readings_of_fluid`), to be fitted, and the provenance says that it was not measured. Grains and
/// deviations come from the mould, the free parameters from what the readings tell of, the laws from the target.
/// Errors: every fault of the sheet, or of the laboratory file that it makes.
Result<StartingFiles> starting_files(const Sheet& sheet, const std::filesystem::path& folder);

/// A study for the laboratory file of a sheet, and why its laws are these.
struct StartingStudy {
  nlohmann::ordered_json document;
  std::string why;
};

/// The laws by what the sheet names or measured, the free parameters by what its readings tell of. `named`: the laws of
/// the sheet's target. Faults: what the sheet knows of parameters is no number. Requirement: `lab` is a laboratory file
/// without faults, `measured` its measurements.
StartingStudy starting_study(const Sheet& sheet, const TargetLaws& named, const SlumpTest& test,
                             const nlohmann::ordered_json& lab, std::span<const Measurement> measured, Faults& faults);

/// The commented laboratory file of a slump test on this preset's apparatus, fit to be read as it is: its mould, speed,
/// table and grains, and the readings that are customary with it, each with its usual value and deviation. Of a preset
/// that names none, a height and a spread.
/// Errors: there is no such preset, it is faulty, or it is an apparatus for another test.
Result<std::string> slump_lab_template(const std::string& preset, const std::filesystem::path& folder);

}  // namespace pastefit
