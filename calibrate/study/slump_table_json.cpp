#include "calibrate/study/slump_table_json.h"

#include "calibrate/study/json_reader.h"
#include "calibrate/study/names.h"

namespace pastefit {
namespace {

using nlohmann::json;

constexpr Range any;  // the test's own `validate` knows the ranges
constexpr Need required = Need::required;

/// Writes what an `ObjectReader` reads, with the same calls, so that one description serves both ways.
class ObjectWriter {
 public:
  explicit ObjectWriter(json& object) : object_(object) { object_ = json::object(); }

  void number(const char* key, double value, const Range&, Need) { object_[key] = value; }
  void nullable_number(const char* key, const std::optional<double>& value, const Range&, Need) {
    object_[key] = value ? json(*value) : json();
  }
  void integer(const char* key, std::uint64_t value, Need) { object_[key] = value; }
  void pairs(const char* key, const std::vector<std::array<double, 2>>& value, const Range&, const Range&, Need,
             std::size_t) {
    if (!value.empty()) object_[key] = value;
  }
  template <class T, std::size_t N>
  void choice(const char* key, T value, const std::array<Named<T>, N>& words, Need) {
    for (const Named<T>& word : words)
      if (word.value == value) object_[key] = word.name;
  }
  template <class Body>
  void object(const char* key, Need, Body body) {
    ObjectWriter writer(object_[key]);
    body(writer);
  }
  template <class T, class Body>
  void nullable_object(const char* key, const std::optional<T>& value, Need, Body body) {
    object_[key] = json();
    if (!value) return;
    ObjectWriter writer(object_[key]);
    body(writer, *value);
  }

 private:
  json& object_;
};

template <class Fields, class Grains>
void describe_grains(Fields& fields, Grains& grains) {
  fields.choice("distribution", grains.distribution, size_distributions, required);
  fields.number("radius_m", grains.radius_m, any, required);
  fields.number("standard_deviation_m", grains.standard_deviation_m, any, required);
  fields.number("smallest_m", grains.smallest_m, any, required);
  fields.number("largest_m", grains.largest_m, any, required);
}

template <class Fields, class Model>
void describe_bridge(Fields& fields, Model& bridge) {
  fields.choice("shape", bridge.shape, bridge_shapes, required);
  fields.choice("formation", bridge.formation, bridge_formations, required);
  fields.number("a_n_m2", bridge.a_n_m2, any, required);
  fields.number("b_n_m", bridge.b_n_m, any, required);
  fields.number("c_n", bridge.c_n, any, required);
  fields.number("d_c_m", bridge.d_c_m, any, required);
  fields.number("offset_m", bridge.offset_m, any, required);
  fields.number("liquid_volume_m3", bridge.liquid_volume_m3, any, required);
  fields.number("surface_tension_n_m", bridge.surface_tension_n_m, any, required);
  fields.number("contact_angle_rad", bridge.contact_angle_rad, any, required);
}

template <class Fields, class Model>
void describe_contact(Fields& fields, Model& contact) {
  fields.number("youngs_modulus_pa", contact.youngs_modulus_pa, any, required);
  fields.number("poissons_ratio", contact.poissons_ratio, any, required);
  fields.number("restitution", contact.restitution, any, required);
  fields.number("friction", contact.friction, any, required);
  fields.number("rolling_friction", contact.rolling_friction, any, required);
  fields.choice("rolling", contact.rolling, rolling_models, required);
  fields.choice("friction_basis", contact.friction_basis, friction_bases, required);
  fields.nullable_number("cohesion_n", contact.cohesion_n, any, required);
  fields.object("bridge", required, [&](auto& inner) { describe_bridge(inner, contact.bridge); });
}

template <class Fields, class Wall>
void describe_wall(Fields& fields, Wall& wall) {
  fields.number("youngs_modulus_pa", wall.youngs_modulus_pa, any, required);
  fields.number("poissons_ratio", wall.poissons_ratio, any, required);
  fields.number("restitution", wall.restitution, any, required);
  fields.number("friction", wall.friction, any, required);
  fields.number("rolling_friction", wall.rolling_friction, any, required);
  fields.number("cohesion_factor", wall.cohesion_factor, any, required);
}

template <class Fields, class Test>
void describe_test(Fields& fields, Test& test) {
  fields.object("mould", required, [&](auto& mould) {
    mould.number("base_radius_m", test.mould.base_radius_m, any, required);
    mould.number("top_radius_m", test.mould.top_radius_m, any, required);
    mould.number("height_m", test.mould.height_m, any, required);
  });
  fields.number("lift_velocity_m_s", test.lift_velocity_m_s, any, required);
  fields.number("table_length_m", test.table_length_m, any, required);
  fields.nullable_object("drop", test.drop, required, [](auto& drop, auto& plate) {
    drop.number("length_m", plate.length_m, any, required);
    drop.number("mass_kg", plate.mass_kg, any, required);
    drop.number("lift_height_m", plate.lift_height_m, any, required);
    drop.number("lift_duration_s", plate.lift_duration_s, any, required);
  });
  fields.object("reading", required, [&](auto& reading) {
    reading.choice("height", test.reading.height, height_readings, required);
    reading.number("probe_diameter_m", test.reading.probe_diameter_m, any, required);
    reading.number("sag_window_m", test.reading.sag_window_m, any, Need::optional);
    reading.pairs("outline_step1_m", test.reading.outline_step1, any, any, Need::optional, 0);
    reading.pairs("outline_step2_m", test.reading.outline_step2, any, any, Need::optional, 0);
  });
  fields.number("bulk_density_kg_m3", test.bulk_density_kg_m3, any, required);
  fields.object("grains", required, [&](auto& grains) { describe_grains(grains, test.grains); });
  fields.object("contact", required, [&](auto& contact) { describe_contact(contact, test.contact); });
  fields.object("mould_wall", required, [&](auto& wall) { describe_wall(wall, test.mould_wall); });
  fields.object("table_wall", required, [&](auto& wall) { describe_wall(wall, test.table_wall); });
  fields.integer("packing_seed", test.packing_seed, required);
}

}  // namespace

json to_json(const SlumpTable& test) {
  json document;
  ObjectWriter writer(document);
  describe_test(writer, test);
  return document;
}

json differing_part(const json& value, const json& usual) {
  if (!value.is_object() || !usual.is_object()) return value;
  json part = json::object();
  for (const auto& [key, member] : value.items()) {
    const auto known = usual.find(key);
    if (known == usual.end())
      part[key] = member;
    else if (member != *known)
      part[key] = differing_part(member, *known);
  }
  return part;
}

Result<SlumpTable> slump_table_from_json(const json& document) {
  if (!document.is_object()) return Fault{"", "a slump test must be an object", "write { ... }"};
  SlumpTable test;
  Faults faults;
  {
    ObjectReader reader(document, "", faults);
    describe_test(reader, test);
  }
  if (faults.empty()) faults = validate(test);
  if (!faults.empty()) return faults;
  return test;
}

}  // namespace pastefit
