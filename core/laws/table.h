#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>

#include "core/laws/attraction.h"
#include "core/laws/dmt.h"
#include "core/laws/epa.h"
#include "core/laws/jkr.h"
#include "core/laws/normal.h"
#include "core/laws/rolling.h"
#include "core/laws/sjkr.h"

namespace pastefit {

template <class... Laws>
struct TypeList {
  static constexpr std::size_t size = sizeof...(Laws);
};

/// All laws, in the order of their names in materials.h. Kernels, names in files and constants of pairs follow from
/// these rows.
using NormalLaws = TypeList<Hertz, Jkr, Dmt, Sjkr, Epa, Luding>;
using Attractions =
    TypeList<NoAttraction, PolynomialAttraction, LinearAttraction, ExponentialAttraction, CapillaryAttraction>;
using RollingLaws = TypeList<NoRolling, SpringDashpotRolling, ConstantTorqueRolling>;

template <class List, std::size_t row>
struct LawOf;
template <class... Laws, std::size_t row>
struct LawOf<TypeList<Laws...>, row> {
  using type = std::tuple_element_t<row, std::tuple<Laws...>>;
};
template <class List, std::size_t row>
using Law = typename LawOf<List, row>::type;

/// Row of a law.
template <class Choice>
constexpr std::size_t row_of(Choice choice) {
  return static_cast<std::size_t>(choice);
}

/// Calls `visit(Law{})` with the law of this name, an empty type, and returns the result.
template <class... Laws, class Choice, class Visitor>
auto with_law(TypeList<Laws...>, Choice choice, const Visitor& visit) {
  using Result = std::common_type_t<decltype(visit(Laws{}))...>;
  if constexpr (std::is_void_v<Result>) {
    (void)((Laws::choice == choice && (visit(Laws{}), true)) || ...);
  } else {
    Result result{};
    (void)((Laws::choice == choice && (result = visit(Laws{}), true)) || ...);
    return result;
  }
}

/// The normal law of a pair: adhesive laws reduce to Hertz without adhesion.
inline NormalLaw acting(NormalLaw law, const PairConstants& pair) {
  const bool adheres = with_law(NormalLaws{}, law, [](auto normal) { return normal.adheres; });
  return adheres && pair.adhesion == 0 ? NormalLaw::hertz : law;
}

/// True if the two can be combined. Kernels of other combinations are not compiled, and scenes must not use them.
template <class Normal, class Attraction>
constexpr bool go_together(Normal, Attraction) {
  return Normal::beside_bridges || !Attraction::present;
}
inline bool go_together(NormalLaw normal, BridgeShape attraction) {
  return with_law(NormalLaws{}, normal, [&](auto of_overlap) {
    return with_law(Attractions{}, attraction, [&](auto across_gap) { return go_together(of_overlap, across_gap); });
  });
}

namespace detail {

/// Every name has a row at its place, and there are no other rows.
template <class Choice, class... Laws>
constexpr bool is_complete(TypeList<Laws...>) {
  std::size_t row = 0;
  return ((row_of(Laws::choice) == row++) && ...) && row == row_of(Choice::last) + 1;
}
static_assert(is_complete<NormalLaw>(NormalLaws{}), "NormalLaw and NormalLaws differ");
static_assert(is_complete<BridgeShape>(Attractions{}), "BridgeShape and Attractions differ");
static_assert(is_complete<RollingModel>(RollingLaws{}), "RollingModel and RollingLaws differ");

}  // namespace detail

}  // namespace pastefit
