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

/// Description of a slump test as typed by the user.
struct Sheet {
  using Named = std::vector<std::pair<std::string, std::string>>;  ///< "slump" and "180, 175, 190 mm"

  std::string title = "my paste";
  std::string source;   ///< who measured it, or where it is published; empty: to be filled in
  std::string mould;    ///< a preset, or "BASE/TOP/HEIGHT" in mm or with a unit
  std::string density;  ///< of the fresh material: "2350", "145 lb/ft3"
  int drops = 0;        ///< of the preset's plate or table; 0: as in the preset
  Named readings;       ///< by short name or key
  Named deviations;     ///< of readings, in their unit; default: as published for the mould
  std::string grains;   ///< radius "8", or smallest and largest "6, 10 mm"; empty: chosen by the mould
  std::vector<std::pair<std::string, double>> mix;  ///< "water_kg_m3" and 180
  std::string yield_stress;            ///< from a vane or another rheometer: "520, 490 Pa"; empty: not measured
  std::string target = "lammps";       ///< program that the material is for
  std::string law;                     ///< word of the starting laws; empty: default of the target
  Named fixed, priors;                 ///< of parameters: "friction" and "0.2", or "0.2 +- 0.05"
  std::vector<std::string> confirmed;  ///< places of suspicious values that are correct
};

struct StartingFiles {
  std::string lab, study;
};

struct ShortReading {
  std::string_view name, key, meaning;
};
std::span<const ShortReading> short_readings();

/// Apparatus named in the sheet, with its default grains. `folder`: where the laboratory file will be written.
Result<Test> apparatus_of(const std::string& mould, const std::filesystem::path& folder);

/// Generates both files. A yield stress is written for comparison. If it is the only measurement, the reading that it
/// predicts (`readings_of_fluid`) is written as well, to be fitted, and the provenance states that it was not measured.
/// The mould determines grains and deviations, the readings the free parameters, the target the laws. Errors: every
/// fault of the sheet, or of the generated laboratory file.
Result<StartingFiles> starting_files(const Sheet& sheet, const std::filesystem::path& folder);

/// Study for the laboratory file of a sheet, and the reason for its laws.
struct StartingStudy {
  nlohmann::ordered_json document;
  std::string why;
};

/// Chooses laws by the sheet and its measurements, and free parameters by its readings. `named`: laws of the sheet's
/// target. Requirement: `lab` is a laboratory file without faults, `measured` its measurements. Faults: parameter
/// values of the sheet that are not numbers.
StartingStudy starting_study(const Sheet& sheet, const TargetLaws& named, const SlumpTest& test,
                             const nlohmann::ordered_json& lab, std::span<const Measurement> measured, Faults& faults);

/// Commented laboratory file of a slump test with this preset, valid as it is: mould, speed, table, grains and the
/// customary readings, each with default value and deviation; a height and a spread if the preset has none. Errors: no
/// such preset, a faulty one, or one for another test.
Result<std::string> slump_lab_template(const std::string& preset, const std::filesystem::path& folder);

}  // namespace pastefit
