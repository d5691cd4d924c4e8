#pragma once

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/base/json_reader.h"
#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/laboratory/names.h"
#include "core/apparatus/dimension.h"
#include "core/apparatus/specimen.h"
#include "core/laws/materials.h"

namespace pastefit {

// Common JSON of all kinds of tests, in SI, for an `ObjectReader`, an `ObjectWriter` and an `ObjectSchema`. The test's
// `validate` checks ranges that depend on other numbers.

void describe_grains(auto& fields, auto& grains) {
  fields.shared("grains");
  fields.choice({"distribution", "distribution of the radii, as in laboratory files"}, grains.distribution,
                size_distributions, required);
  fields.number({"radius_m", "mean radius"}, grains.radius_m, above_zero, required);
  fields.number(
      {"standard_deviation_m", "standard deviation of the radius; 0 for a distribution without this parameter"},
      grains.standard_deviation_m, not_below_zero, required);
  fields.number({"smallest_m", "smallest radius"}, grains.smallest_m, not_below_zero, required);
  fields.number({"largest_m", "largest radius"}, grains.largest_m, not_below_zero, required);
}

/// Properties shared by tests of one material.
void describe_material(auto& fields, auto& material) {
  fields.number({"bulk_density_kg_m3", "bulk density, as in the laboratory file"}, material.bulk_density_kg_m3,
                above_zero, required);
  fields.object({"grains", "grain sizes for which the numbers in `contact` are valid"}, required,
                [&](auto& grains) { describe_grains(grains, material.grains); });
  fields.object({"contact", "contact laws in SI units, for input into another program"}, required,
                [&](auto& contact) { describe_contact(contact, material.contact); });
}
inline constexpr std::array of_material{"bulk_density_kg_m3", "grains", "contact"};

/// Everything in a `Specimen`.
void describe_specimen(auto& fields, auto& specimen) {
  describe_material(fields, specimen);
  fields.integer({"packing_seed", "seed of the default packing"}, specimen.packing_seed, required);
}

/// Surface of the apparatus in contact with grains. Its parameters are `<name>_friction`, `<name>_rolling_friction` and
/// `<name>_cohesion_factor`.
struct Surface {
  std::string_view name;
  WallContact& contact;
};

// Dimensions of an apparatus (core/apparatus/dimension.h) in JSON, in SI, and in user files, in their units.

/// Key of a field in user files, and the value of one SI unit in the key's unit: "base_radius_m" is "base_diameter_mm",
/// with 2000.
struct FileKey {
  std::string name;
  double per_si = 1;
};
inline FileKey file_key(std::string_view field) {
  struct Ending {
    std::string_view in_si, in_files;
    double per_si;
  };
  static constexpr std::array<Ending, 4> endings{
      {{"_radius_m", "_diameter_mm", 2 * mm}, {"_m_s", "_mm_s", mm}, {"_m", "_mm", mm}, {"_rad", "_deg", degrees}}};
  for (const Ending& end : endings)
    if (field.ends_with(end.in_si))
      return {std::string(field.substr(0, field.size() - end.in_si.size())) + std::string(end.in_files), end.per_si};
  return {std::string(field)};
}

/// Field of a test: path in JSON, "mould.base_radius_m", and place in laboratory files,
/// "apparatus.mould.base_diameter_mm". The other members are set for dimensions only, not for objects that contain
/// them.
struct FilePlace {
  std::string field, place;
  Range range = {};  ///< in the unit of the key
  std::string_view meaning = {};
  bool has_default = false, often_unstated = false;
};

/// Pointer to a field or place in a document, e.g. "apparatus.mould.height_mm".
inline nlohmann::json::json_pointer pointer_to(std::string place) {
  std::ranges::replace(place, '.', '/');
  return nlohmann::json::json_pointer("/" + place);
}

template <class Owner>
Range range_in_files(const Dimension<Owner>& dimension) {
  const double per_si = file_key(dimension.field).per_si;
  return {rounded(dimension.smallest * per_si, 12), rounded(dimension.largest * per_si, 12)};
}

/// Adds the places of an object's dimensions; `field` and `place` are those of the object (empty `field`: the test
/// itself).
template <class Owner, std::size_t count>
void add_places(std::vector<FilePlace>& out, const std::array<Dimension<Owner>, count>& dimensions,
                const std::string& field = "", const std::string& place = "apparatus") {
  const std::string prefix = field.empty() ? "" : field + ".";
  for (const Dimension<Owner>& one : dimensions)
    out.push_back({prefix + std::string(one.field), place + "." + file_key(one.field).name, range_in_files(one),
                   one.meaning, one.has_default, one.often_unstated});
  if (!field.empty()) out.push_back({field, place});
}

/// Describes all dimensions in SI to an `ObjectReader`, `ObjectWriter` or `ObjectSchema`.
template <class Fields, class Object, class Owner, std::size_t count>
void describe_dimensions(Fields& fields, Object& object, const std::array<Dimension<Owner>, count>& dimensions) {
  for (const Dimension<Owner>& one : dimensions)
    fields.number({one.field, one.meaning.substr(0, one.meaning.find("; default"))}, object.*one.value,
                  {one.smallest, one.largest, false, true}, required);
}

/// True if a number is negative, or 0, where the range excludes it.
inline bool is_below_nothing(const nlohmann::json* number, const Range& range) {
  if (!number || !number->is_number()) return false;
  const double value = number->get<double>();
  return value < 0 ? range.smallest >= 0 : value == 0 && range.smallest > 0;
}

/// Describes dimensions in a user file to an `ObjectReader` or `ObjectSchema`. `need`: for those without a default.
/// Numbers with a wrong sign are faults at once; other ranges are checked by the test's `validate`, together, after all
/// numbers have been read.
template <class Fields, class Owner, std::size_t count>
void read_dimensions(Fields& fields, Owner& owner, const std::array<Dimension<Owner>, count>& dimensions, Need need) {
  for (const Dimension<Owner>& one : dimensions) {
    const FileKey key = file_key(one.field);
    Range range = range_in_files(one);
    if constexpr (Fields::reads) range.judged_later = !is_below_nothing(fields.content(key.name), range);
    fields.number({key.name, one.meaning}, owner.*one.value, range, one.has_default ? Need::optional : need,
                  key.per_si);
  }
}

}  // namespace pastefit
