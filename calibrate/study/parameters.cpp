#include "calibrate/study/parameters.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/laws/table.h"

namespace pastefit {
namespace {

constexpr Scale linear = Scale::linear;
constexpr Scale logarithmic = Scale::logarithmic;

// Files and stored evaluations know a parameter by its name; the order is that of tables for people.
constexpr std::array<ParameterKind, 23> kinds{{
    {"strength_pa", 1, 1e7, 5000, logarithmic, "attraction at touch, divided by the squared mean grain radius: c/R^2"},
    {"rupture_force_ratio", 0, 1, 0, linear,
     "attraction at rupture of the bridge, divided by the attraction at touch: F(d_c)/c"},
    {"curvature", -1, 1, 0, linear,
     "shape of the attraction as a function of the gap; -1: flat at touch; 0: straight; 1: flat at rupture"},
    {"rupture_gap_ratio", 1e-3, 1, 0.3, linear, "rupture gap of the bridge, divided by the mean grain radius: -d_c/R"},
    {"formation_ratio", 0, 1, 1, linear, "gap at which a bridge forms, divided by its rupture gap: 2 offset/-d_c"},
    {"friction", 0, 2, 0.5, linear, "sliding friction between grains"},
    {"rolling_friction", 0, 1, 0.1, linear, "rolling friction between grains"},
    {"restitution", 0.01, 1, 0.3, linear, "rebound speed divided by impact speed of two grains, without attraction"},
    {"youngs_modulus_pa", 1e5, 1e11, 2e6, logarithmic, "Young's modulus of the grains"},
    {"poissons_ratio", 0, 0.49, 0.3, linear, "Poisson's ratio of the grains"},
    {"cohesion_ratio", 0, 10, 1, linear,
     "constant attraction of overlapping grains, divided by the attraction at touch: F_coh/c"},
    {"mould_friction", 0, 2, 0.1, linear, "sliding friction between grains and mould"},
    {"table_friction", 0, 2, 0.5, linear, "sliding friction between grains and table"},
    {"mould_rolling_friction", 0, 1, 0, linear, "rolling friction between grains and mould"},
    {"table_rolling_friction", 0, 1, 0.1, linear, "rolling friction between grains and table"},
    {"table_cohesion_factor", 0, 2, 0, linear, "share of the grains' attraction that acts on the table"},
    {"mould_cohesion_factor", 0, 2, 0, linear, "share of the grains' attraction that acts on the mould"},
    {"adhesion_pa", 1, 1e6, 1000, logarithmic,
     "surface energy of the grains, divided by the mean grain radius: gamma/R"},
    {"cohesion_energy_density_pa", 1, 1e9, 50000, logarithmic,
     "attraction of two grains, divided by their contact area"},
    {"plasticity_ratio", 0, 0.98, 0.85, linear, "share of the largest overlap that remains without load: 1 - k1/k2"},
    {"adhesion_ratio", 0.001, 20, 1, logarithmic,
     "stiffness of the adhesion branch, divided by the stiffness of loading: kc/k1"},
    {"pull_off_pa", 0, 1e7, 0, linear,
     "constant attraction of touching grains, divided by the squared mean grain radius: f0/R^2"},
    {"viscosity_pa_s", 0, 1000, 0, linear, "viscosity of the liquid between the grains"},
}};

constexpr std::array<PlausibleRange, 2> plausible{{
    {"friction", 0.05, 1, "grains that slide like wet ice", "grains as rough as few are"},
    {"rolling_friction", 0, 0.5, "",
     "these grains hardly roll; it stands in for something that the model lacks, their shape for instance"},
}};

/// The place of a parameter in a list of values. Throws for a name that there is not, which is a bug in this file.
std::size_t parameter_at(std::string_view name) {
  const auto kind = std::ranges::find(kinds, name, &ParameterKind::name);
  if (kind == kinds.end()) throw std::logic_error("no parameter " + std::string(name));
  return static_cast<std::size_t>(kind - kinds.begin());
}

/// Of a surface's parameter a law names what follows the surface's name.
template <class Law>
bool names(Law, std::string_view parameter) {
  return std::ranges::any_of(Law::parameters, [&](std::string_view own) { return parameter.ends_with(own); });
}

/// A choice of a study, the laws it is made from, and which of them have a parameter.
struct Choice {
  std::string_view key;     ///< in "contact"
  std::string_view chosen;  ///< its word
  std::vector<std::string_view> having;
  bool had() const { return std::ranges::count(having, chosen) > 0; }
};

template <class... Laws, class Name>
Choice choice_of(std::string_view key, TypeList<Laws...> laws, Name chosen, std::string_view parameter) {
  Choice choice{key, with_law(laws, chosen, [](auto law) { return law.word; }), {}};
  const auto look = [&](auto law) {
    if (names(law, parameter)) choice.having.push_back(law.word);
  };
  (look(Laws{}), ...);
  return choice;
}

std::array<Choice, 3> choices_of(const ContactModel& laws, std::string_view parameter) {
  return {choice_of("attraction", Attractions{}, laws.bridge.shape, parameter),
          choice_of("normal", NormalLaws{}, laws.normal, parameter),
          choice_of("rolling_model", RollingLaws{}, laws.rolling, parameter)};
}

/// Bridges that form by touch ask nothing of a film.
bool lacks_film(const ContactModel& laws, std::string_view parameter) {
  return parameter == AcrossGap::film_parameter && laws.bridge.formation == BridgeFormation::touch;
}

/// The surface whose parameter it is; empty if it is none's. A parameter of the grains has no surface before it.
std::string_view surface_in(std::string_view parameter) {
  for (const std::string_view word : kinds_of_tests()) {
    Test test = *test_of_kind(word);
    for (const Surface& surface : surfaces_of(test)) {
      const bool of_it = parameter.starts_with(surface.name) && parameter.substr(surface.name.size()).starts_with('_');
      if (of_it) return parameter.substr(0, surface.name.size());
    }
  }
  return {};
}

}  // namespace

std::span<const ParameterKind> parameter_kinds() {
  return kinds;
}

std::span<const PlausibleRange> plausible_ranges() {
  return plausible;
}

std::vector<double> default_values() {
  std::vector<double> values;
  for (const ParameterKind& kind : kinds) values.push_back(kind.default_value);
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

std::vector<double> values_at(const Study& study, std::span<const double> unit_point) {
  assert(std::ssize(unit_point) == free_count(study));
  std::vector<double> values;
  std::size_t coordinate = 0;
  for (const Parameter& parameter : study.parameters)
    values.push_back(parameter.free ? value_between(parameter, unit_point[coordinate++]) : parameter.value);
  return values;
}

bool has_parameter(const ContactModel& laws, std::string_view name) {
  if (lacks_film(laws, name)) return false;
  const auto choices = choices_of(laws, name);
  return std::ranges::any_of(choices, &Choice::had) ||
         std::ranges::all_of(choices, [](const Choice& choice) { return choice.having.empty(); });
}

bool acts_in(const Test& test, std::string_view name) {
  const std::string_view surface = surface_in(name);
  if (surface.empty()) return true;
  Test copy = test;
  return std::ranges::any_of(surfaces_of(copy), [&](const Surface& own) { return own.name == surface; });
}

Fault surface_of_no_test(std::string place, std::string_view name) {
  return {std::move(place), "acts on the " + std::string(surface_in(name)) + ", which the test's apparatus has not",
          "leave it out"};
}

Fault foreign_parameter(const ContactModel& laws, std::string place, std::string_view name) {
  if (lacks_film(laws, name))
    return {std::move(place), "belongs to formation \"film\"; chosen is formation \"touch\"",
            "leave it out, or choose \"contact\": {\"formation\": \"film\"}"};
  std::string owners, chosen, remedy;
  for (const Choice& choice : choices_of(laws, name)) {
    if (choice.having.empty()) continue;
    owners += (owners.empty() ? "" : ", or to ") + std::string(choice.key) + " " + listed(choice.having, in_quotes);
    chosen += (chosen.empty() ? "" : ", ") + std::string(choice.key) + " " + in_quotes(choice.chosen);
    if (remedy.empty())
      remedy =
          "leave it out, or choose \"contact\": {" + in_quotes(choice.key) + ": " + in_quotes(choice.having[0]) + "}";
  }
  return {std::move(place), "belongs to " + owners + "; chosen is " + chosen, std::move(remedy)};
}

Test with_contact_of(Test test, std::span<const double> values) {
  assert(values.size() == kinds.size());
  ContactModel& contact = specimen_of(test).contact;
  ContactModel chosen;
  chosen.normal = contact.normal;
  chosen.rolling = contact.rolling;
  chosen.friction_basis = contact.friction_basis;
  chosen.rolling_friction = contact.rolling_friction;  // older cards name it without a law that has it
  chosen.bridge.shape = contact.bridge.shape;
  chosen.bridge.formation = contact.bridge.formation;
  contact = chosen;
  const auto make = [&, radius = specimen_of(test).grains.radius_m](auto law) {
    law.make(contact, radius, [&](std::string_view name) {
      assert(names(law, name));
      return values[parameter_at(name)];
    });
  };
  with_law(Attractions{}, contact.bridge.shape, make);
  with_law(NormalLaws{}, contact.normal, make);
  with_law(RollingLaws{}, contact.rolling, make);
  contact.friction = values[parameter_at("friction")];
  contact.restitution = values[parameter_at("restitution")];
  contact.youngs_modulus_pa = values[parameter_at("youngs_modulus_pa")];
  contact.poissons_ratio = values[parameter_at("poissons_ratio")];
  for (const Surface& surface : surfaces_of(test)) {
    surface.contact.friction = values[parameter_at(std::string(surface.name) + "_friction")];
    surface.contact.rolling_friction = values[parameter_at(std::string(surface.name) + "_rolling_friction")];
    surface.contact.cohesion_factor = values[parameter_at(std::string(surface.name) + "_cohesion_factor")];
  }
  return test;
}

Test with_default_contact(Test test) {
  ContactModel& contact = specimen_of(test).contact;
  contact.normal = NormalLaw::hertz;
  contact.bridge.shape = BridgeShape::polynomial;
  return with_contact_of(std::move(test), default_values());
}

Test test_with(Test test, std::span<const double> values, std::uint64_t packing_seed) {
  test = with_contact_of(std::move(test), values);
  specimen_of(test).packing_seed = packing_seed;
  return test;
}

}  // namespace pastefit
