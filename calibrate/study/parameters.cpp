#include "calibrate/study/parameters.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace pastefit {
namespace {

constexpr Scale linear = Scale::linear;
constexpr Scale logarithmic = Scale::logarithmic;

// Files and stored evaluations know a parameter by its name; the order is that of tables for people.
constexpr std::array<ParameterKind, 15> kinds{{
    {"strength_pa", 1, 1e7, 5000, logarithmic, "attraction at touch over the squared mean grain radius, c/R^2"},
    {"rupture_force_ratio", 0, 1, 0, linear, "share of the attraction left when the bridge ruptures, F(d_c)/c"},
    {"curvature", -1, 1, 0, linear, "shape of the decay: -1 flat at touch, 0 straight, 1 flat at rupture"},
    {"rupture_gap_ratio", 1e-3, 1, 0.3, linear, "gap at which the bridge ruptures over the mean grain radius, -d_c/R"},
    {"offset_ratio", 0, 1, 0.15, linear, "thickness of the liquid shell over the mean grain radius"},
    {"friction", 0, 2, 0.5, linear, "sliding friction between grains"},
    {"rolling_friction", 0, 1, 0.1, linear, "rolling friction between grains"},
    {"restitution", 0.01, 1, 0.3, linear, "rebound speed over impact speed between grains, without attraction"},
    {"youngs_modulus_pa", 1e5, 1e11, 2e6, logarithmic, "Young's modulus of the grains"},
    {"poissons_ratio", 0, 0.49, 0.3, linear, "Poisson's ratio of the grains"},
    {"cohesion_ratio", 0, 10, 1, linear, "constant attraction of overlapping grains over the one at touch, F_coh/c"},
    {"mould_friction", 0, 2, 0.1, linear, "sliding friction between grains and mould"},
    {"table_friction", 0, 2, 0.5, linear, "sliding friction between grains and table"},
    {"table_cohesion_factor", 0, 2, 0, linear, "share of the grains' attraction that acts on the table"},
    {"mould_cohesion_factor", 0, 2, 0, linear, "share of the grains' attraction that acts on the mould"},
}};

/// The place of a parameter in a list of values. A name that there is not does not compile.
consteval std::size_t at(std::string_view name) {
  for (std::size_t i = 0; i < kinds.size(); ++i)
    if (kinds[i].name == name) return i;
  throw "no such parameter";
}

}  // namespace

std::span<const ParameterKind> parameter_kinds() {
  return kinds;
}

std::vector<double> usual_values() {
  std::vector<double> values;
  for (const ParameterKind& kind : kinds) values.push_back(kind.usual);
  return values;
}

int free_count(const Study& study) {
  return static_cast<int>(std::ranges::count_if(study.parameters, &Parameter::free));
}

double value_between(const Parameter& parameter, double unit) {
  if (unit <= 0) return parameter.lower;
  if (unit >= 1) return parameter.upper;
  if (parameter.scale == Scale::linear) return std::lerp(parameter.lower, parameter.upper, unit);
  const double value = std::exp(std::lerp(std::log(parameter.lower), std::log(parameter.upper), unit));
  return std::clamp(value, parameter.lower, parameter.upper);
}

double unit_of(const Parameter& parameter, double value) {
  if (parameter.scale == Scale::linear) return (value - parameter.lower) / (parameter.upper - parameter.lower);
  return std::log(value / parameter.lower) / std::log(parameter.upper / parameter.lower);
}

UnitPrior unit_prior(const Parameter& parameter) {
  const Prior& prior = parameter.prior.value();
  const double deviation = parameter.scale == Scale::linear
                               ? prior.standard_deviation / (parameter.upper - parameter.lower)
                               : prior.standard_deviation / prior.value / std::log(parameter.upper / parameter.lower);
  return {unit_of(parameter, prior.value), deviation};
}

std::vector<double> values_at(const Study& study, const Eigen::VectorXd& unit_point) {
  assert(unit_point.size() == free_count(study));
  std::vector<double> values;
  Eigen::Index coordinate = 0;
  for (const Parameter& parameter : study.parameters)
    values.push_back(parameter.free ? value_between(parameter, unit_point[coordinate++]) : parameter.value);
  return values;
}

namespace {

/// The place of a surface's parameter; every surface of every kind of test has its own.
std::size_t place_of(std::string_view surface, std::string_view parameter) {
  const std::string name = std::string(surface) + std::string(parameter);
  const auto kind = std::ranges::find(kinds, std::string_view(name), &ParameterKind::name);
  assert(kind != kinds.end());
  return static_cast<std::size_t>(kind - kinds.begin());
}

}  // namespace

Test with_contact_of(Test test, std::span<const double> values) {
  assert(values.size() == kinds.size());
  ContactModel& contact = specimen_of(test).contact;
  const double radius = specimen_of(test).grains.radius_m;

  Bridge& bridge = contact.bridge;
  const double c = values[at("strength_pa")] * radius * radius;
  const double k = values[at("curvature")];
  // Share of the attraction that is gone when the bridge ruptures.
  const double lost = 1 - values[at("rupture_force_ratio")];
  double gap = values[at("rupture_gap_ratio")];
  if (bridge.formation == BridgeFormation::touch) gap = std::min(gap, 2 * values[at("offset_ratio")]);
  const double d_c = -gap * radius;
  bridge.shape = BridgeShape::polynomial;
  bridge.a_n_m2 = k * lost * c / (d_c * d_c);
  bridge.b_n_m = lost * (1 + k) * c / -d_c;
  bridge.c_n = c;
  bridge.d_c_m = d_c;
  bridge.offset_m = values[at("offset_ratio")] * radius;

  contact.friction = values[at("friction")];
  contact.rolling_friction = values[at("rolling_friction")];
  contact.restitution = values[at("restitution")];
  contact.youngs_modulus_pa = values[at("youngs_modulus_pa")];
  contact.poissons_ratio = values[at("poissons_ratio")];
  contact.cohesion_n = values[at("cohesion_ratio")] * c;
  for (const Surface& surface : surfaces_of(test)) {
    surface.contact.friction = values[place_of(surface.name, "_friction")];
    surface.contact.cohesion_factor = values[place_of(surface.name, "_cohesion_factor")];
  }
  return test;
}

Test test_with(Test test, std::span<const double> values, std::uint64_t packing_seed) {
  test = with_contact_of(std::move(test), values);
  specimen_of(test).packing_seed = packing_seed;
  return test;
}

}  // namespace pastefit
