#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "calibrate/base/embedded_text.h"
#include "calibrate/base/machine.h"
#include "calibrate/base/text.h"
#include "calibrate/exports/elasto_plastic.h"
#include "calibrate/exports/export.h"
#include "calibrate/exports/lammps_deck.h"
#include "calibrate/exports/nearest_law.h"
#include "core/laws/constants.h"

namespace pastefit {

namespace fs = std::filesystem;

namespace {

/// LAMMPS of 2025 has this law, Debian's version does not; untested.
std::string note_of_granular(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  const double m = overlap_exponent(contact.normal), effective = 0.5 * scene.radius_m();
  const double kc = contact.adhesion_ratio * grain_pair(contact, scene.radius_m()).hertz * std::pow(effective, 2 - m);
  return "LAMMPS of 2025 and later has this law of its own, in pair_style granular. By its manual (we have not run "
         "it):\n    " +
         format("pair_coeff * * epa_nonlinear %.6g %.6g %.6g %.6g %.6g %.6g %.6g %.6g tangential mindlin NULL 1.0 %.6g",
                contact.youngs_modulus_pa, contact.restitution, contact.poissons_ratio, contact.plasticity_ratio,
                cohesion_n(contact, scene.mean_pair()), kc, m, m, contact.friction) +
         "\n  in the order E, restitution, nu, plasticity ratio, f0, kc, exponents; choose rolling and damping beside "
         "it. kc is that of two mean grains, in N/m^n: compare other sizes and walls (kc times the cohesion factor) "
         "with in.two_grains first. Its friction adds kc d^n to the force on the adhesion branch only, the card's "
         "everywhere, and its tangential spring feels the contact radius of the plastic overlap.";
}

/// Laws of the engine and their names; calibrate/CMakeLists.txt installs them beside the style.
constexpr std::array<std::array<std::string_view, 2>, 7> kLaws{{{"core/laws", ".h"},
                                                                {"core/laws", ".cpp"},
                                                                {"core", "/inline.h"},
                                                                {"core", "/target.h"},
                                                                {"core", "/vec3.h"},
                                                                {"calibrate/base", "/field.h"},
                                                                {"calibrate/laboratory", "/names.h"}}};

bool has_laws(const std::vector<ExportFile>& files) {
  return std::ranges::count(files, "core/laws/contact.h", &ExportFile::name) > 0;
}

/// Adds files with this ending in a folder and its subfolders, with paths relative to `root`.
void add_files(const fs::path& root, const fs::path& folder, std::string_view ending, std::vector<ExportFile>& files) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder, error)) {
    const std::string name = entry.path().lexically_relative(root).generic_string();
    if (!entry.is_regular_file() || !name.ends_with(ending)) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    files.push_back({name, std::string(std::istreambuf_iterator<char>(in), {})});
  }
}

}  // namespace

Result<std::vector<ExportFile>> lammps_style() {
  for (const fs::path& data : data_folders()) {
    std::vector<ExportFile> files;
    add_files(data / "lammps", "", "", files);
    // Installed folders contain the laws; in the source tree they are beside the data.
    if (!has_laws(files))
      for (const auto& [folder, ending] : kLaws)
        add_files(data.lexically_normal().parent_path(), folder, ending, files);
    std::ranges::sort(files, {}, &ExportFile::name);
    if (has_laws(files)) return files;
  }
  return Fault{"--to lammps", "the sources of its style were not found",
               "set PASTEFIT_DATA_DIR to the data folder of pastefit"};
}

std::string lammps_style_build(const std::string& program) {
  return "mpicxx -O3 -std=c++20 -I. -isystem /usr/include/lammps *.cpp core/laws/*.cpp -o " + program + " -llammps";
}

Result<Export> export_lammps(const ExportScene& scene) {
  const KnownLaws known{"pair style pastefit", kAllNormal, kAllRolling, kAllAttractions, true};
  if (Faults faults = unknown_laws(scene.contact(), known); !faults.empty()) return faults;
  auto style = lammps_style();
  if (!style.ok()) return style.faults();
  Export out;
  out.notes.push_back(
      "The laws are pastefit's own, memory and walls included. LAMMPS integrates them with steps of a tenth of the "
      "Rayleigh time, without pastefit's protection of grains that have many damped contacts: do not lengthen them.");
  if (yields(scene.contact().normal)) out.notes.push_back(note_of_granular(scene));
  if (const SlumpTest* test = scene.slump(); test && test->drop) {
    if (test->drop->motion == TableMotion::vertical)
      out.notes.push_back("The deck runs step 1, on a square table. A table that falls upright is not part of it.");
    else if (test->drop->drops > 1)
      out.notes.push_back(
          format("The deck drops the plate once: the heap of step 2. The card's test goes on to %d drops.",
                 test->drop->drops));
  }
  out.instructions = filled_in("exports/texts/lammps_build.txt", {{"build", lammps_style_build("../lmp_pastefit")}});
  out.files = lammps_deck(scene, out.notes);
  for (auto& file : style.value()) out.files.push_back({"style/" + file.name, std::move(file.content)});
  if (scene.slump()) out.heap = "heap.dump";
  return out;
}

}  // namespace pastefit
